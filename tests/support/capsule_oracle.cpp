#include "support/capsule_oracle.hpp"

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <type_traits>
#include <vector>

#include "support/nearest_points.hpp"

namespace surehit::test {
namespace {

using namespace oracle;
using Whole = mpz_class;
using Point = Vec<Whole>;

/// A capsule and a triangle in numbers of one kind.
template <typename Number>
struct Pair {
  Vec<Number> start, step, axis, a, b, c;
  Number radius;
};

/// The exponents of all bits that are not zero.
struct Exponents {
  int low = std::numeric_limits<int>::max();
  int high = std::numeric_limits<int>::min();

  void include(double x) {
    if (x == 0) return;
    int exponent = 0;
    std::frexp(x, &exponent);
    high = std::max(high, exponent);
    low = std::min(low, exponent - 53);
  }
};

/// Calls `visit` with all numbers of a capsule and a triangle.
template <typename Scalar, typename Visit>
void visit_numbers(const SweptCapsule<Scalar>& capsule, const Triangle<Scalar>& triangle, const Visit& visit) {
  for (const Vector3<Scalar>* x :
       {&capsule.start, &capsule.end, &capsule.half_axis, &triangle.a, &triangle.b, &triangle.c}) {
    for (Eigen::Index i = 0; i < 3; ++i) visit(double{(*x)[i]});
  }
  visit(double{capsule.radius});
}

template <typename Scalar>
Exponents exponents_of(const SweptCapsule<Scalar>& capsule, const Triangle<Scalar>& triangle) {
  Exponents exponents;
  visit_numbers(capsule, triangle, [&](double x) { exponents.include(x); });
  return exponents;
}

/// x / 2^exponent, which must be a whole number.
Whole whole(double x, int exponent) {
  if (x == 0) return 0;
  int of_x = 0;
  Whole result(std::ldexp(std::frexp(x, &of_x), 53));
  const int shift = of_x - 53 - exponent;
  if (shift >= 0) {
    result <<= static_cast<unsigned>(shift);
  } else {
    result >>= static_cast<unsigned>(-shift);
  }
  return result;
}

template <typename Scalar>
Pair<Whole> to_whole(const SweptCapsule<Scalar>& capsule, const Triangle<Scalar>& triangle) {
  const Exponents exponents = exponents_of(capsule, triangle);
  const auto convert_point = [&](const Vector3<Scalar>& x) -> Point {
    return {whole(double{x[0]}, exponents.low), whole(double{x[1]}, exponents.low), whole(double{x[2]}, exponents.low)};
  };
  const Point start = convert_point(capsule.start);
  return {start,
          convert_point(capsule.end) - start,
          convert_point(capsule.half_axis),
          convert_point(triangle.a),
          convert_point(triangle.b),
          convert_point(triangle.c),
          whole(double{capsule.radius}, exponents.low)};
}

Point sum(const Point& x, const Point& y, int factor = 1) { return along(x, Whole(factor), y); }

/// Whether two sets of points are at most the root of `rr` apart.
class Nearness {
 public:
  explicit Nearness(const Whole& rr) : rr_(rr) {}

  [[nodiscard]] bool of_polygons(const std::vector<Point>& x, const std::vector<Point>& y) const {
    return of_corners(x, y) || of_corners(y, x) || of_edges(x, y) || crosses_edge(x, y) || crosses_edge(y, x);
  }

 private:
  [[nodiscard]] bool of_points(const Point& x, const Point& y) const {
    const Point gap = x - y;
    return dot(gap, gap) <= rr_;
  }
  [[nodiscard]] bool of_point_and_segment(const Point& x, const Point& a, const Point& b) const {
    const Point e = b - a;
    const Whole ee = dot(e, e);
    const Whole s = dot(Point(x - a), e);
    if (s <= 0) return of_points(x, a);
    if (s >= ee) return of_points(x, b);
    const Point moment = cross(Point(x - a), e);
    return dot(moment, moment) <= rr_ * ee;
  }
  [[nodiscard]] bool of_segments(const Point& p, const Point& q, const Point& a, const Point& b) const {
    const Point d = q - p;
    const Point e = b - a;
    const Point w = p - a;
    const Point f = cross(d, e);
    const Whole ff = dot(f, f);
    if (ff == 0) return false;  // The ends decide it.
    const Whole s = dot(cross(e, w), f);
    const Whole t = dot(cross(d, w), f);
    if (s < 0 || s > ff || t < 0 || t > ff) return false;
    const Whole height = dot(w, f);
    return height * height <= rr_ * ff;
  }
  [[nodiscard]] static Point normal(const std::vector<Point>& x) {
    return cross(Point(x[1] - x[0]), Point(x[2] - x[1]));
  }
  static bool is_null(const Point& x) { return x[0] == 0 && x[1] == 0 && x[2] == 0; }

  /// Whether a corner of x is near to y.
  [[nodiscard]] bool of_corners(const std::vector<Point>& x, const std::vector<Point>& y) const {
    const Point n = normal(y);
    const Whole nn = dot(n, n);
    for (const Point& corner : x) {
      for (std::size_t i = 0; i < y.size(); ++i) {
        if (of_point_and_segment(corner, y[i], y[(i + 1) % y.size()])) return true;
      }
      if (nn == 0) continue;
      bool is_over = true;
      for (std::size_t i = 0; i < y.size(); ++i) {
        is_over &= dot(n, cross(Point(y[(i + 1) % y.size()] - y[i]), Point(corner - y[i]))) >= 0;
      }
      const Whole height = dot(n, Point(corner - y[0]));
      if (is_over && height * height <= rr_ * nn) return true;
    }
    return false;
  }
  [[nodiscard]] bool of_edges(const std::vector<Point>& x, const std::vector<Point>& y) const {
    for (std::size_t i = 0; i < x.size(); ++i) {
      for (std::size_t k = 0; k < y.size(); ++k) {
        if (of_segments(x[i], x[(i + 1) % x.size()], y[k], y[(k + 1) % y.size()])) return true;
      }
    }
    return false;
  }
  /// Whether an edge of x crosses y from one side to the other.
  [[nodiscard]] static bool crosses_edge(const std::vector<Point>& x, const std::vector<Point>& y) {
    const Point n = normal(y);
    if (is_null(n)) return false;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Point& p = x[i];
      const Point d = x[(i + 1) % x.size()] - p;
      const Whole from = dot(n, Point(p - y[0]));
      const Whole to = from + dot(n, d);
      if (sgn(from) * sgn(to) > 0 || (from == 0 && to == 0)) continue;
      bool has_left = false;
      bool has_right = false;
      for (std::size_t k = 0; k < y.size(); ++k) {
        const int side = sgn(dot(d, cross(Point(y[k] - p), Point(y[(k + 1) % y.size()] - p))));
        has_left |= side > 0;
        has_right |= side < 0;
      }
      if (!has_left || !has_right) return true;
    }
    return false;
  }

  const Whole& rr_;
};

/// Whether they touch before or at t = numerator / 2^shift.
bool touches_until(const Pair<Whole>& pair, const Whole& numerator, unsigned shift) {
  const auto scaled = [&](const Point& x) -> Point {
    return {Whole(x[0] << shift), Whole(x[1] << shift), Whole(x[2] << shift)};
  };
  const Point start = scaled(pair.start);
  const Point axis = scaled(pair.axis);
  const Point way = along(Point{}, numerator, pair.step);
  const Whole radius = pair.radius << shift;
  const Whole rr = radius * radius;
  const Point low = sum(start, axis, -1);
  const Point high = sum(start, axis);
  return Nearness(rr).of_polygons({low, high, sum(high, way), sum(low, way)},
                                  {scaled(pair.a), scaled(pair.b), scaled(pair.c)});
}

/// A number of [0, 2) as a fraction.
struct Fraction {
  Whole numerator;
  unsigned shift;

  /// The middle of two doubles.
  static Fraction between(double x, double y) {
    constexpr int exponent = -1074;
    return {whole(x, exponent) + whole(y, exponent), 1075};
  }
  [[nodiscard]] Fraction simple() const {
    Fraction result = *this;
    if (numerator == 0) return {0, 0};
    const auto zeros = std::min<mp_bitcnt_t>(mpz_scan1(numerator.get_mpz_t(), 0), shift);
    result.numerator >>= zeros;
    result.shift -= static_cast<unsigned>(zeros);
    return result;
  }
};

bool touches_until(const Pair<Whole>& pair, const Fraction& t) {
  const Fraction simple = t.simple();
  return touches_until(pair, simple.numerator, simple.shift);
}
/// Whether they touch a little before t, and not only at t.
bool touches_before(const Pair<Whole>& pair, const Fraction& t) {
  constexpr unsigned fine = 400;
  const Fraction simple = t.simple();
  return touches_until(pair, Fraction{(simple.numerator << fine) - simple.numerator, simple.shift + fine});
}

/// What is known of t: it is in the interval that rounds to `t`, with ties to even.
template <typename Scalar>
std::optional<std::string> find_error_of_t(const Pair<Whole>& pair, Scalar t) {
  const bool is_even =
      (std::bit_cast<std::conditional_t<sizeof(Scalar) == 4, std::uint32_t, std::uint64_t>>(t) & 1) == 0;
  if (t < 1) {
    const Fraction above = Fraction::between(double{t}, double{std::nextafter(t, Scalar{2})});
    if (!touches_until(pair, above)) return "t is too low";
    if (!is_even && !touches_before(pair, above)) return "t is the lower one of a tie, and odd";
  }
  if (t > 0) {
    const Fraction below = Fraction::between(double{t}, double{std::nextafter(t, Scalar{0})});
    if (touches_until(pair, below) && (!is_even || touches_before(pair, below))) return "t is too high";
  }
  return std::nullopt;
}

/// A capsule and a triangle in long floats, and a number that is far below all that can differ.
struct FloatPair : Pair<Float> {
  Float rr, tiny;
  Float area;  ///< Four times the square of the triangle's area.
};

template <typename Scalar>
FloatPair to_float(const SweptCapsule<Scalar>& capsule, const Triangle<Scalar>& triangle) {
  const Exponents exponents = exponents_of(capsule, triangle);
  const int bits = 32 * (std::max(0, exponents.high - exponents.low) + 16);
  mpf_set_default_prec(static_cast<mp_bitcnt_t>(bits));
  FloatPair pair;
  pair.start = vector_of<Float>(capsule.start);
  pair.step = vector_of<Float>(capsule.end) - pair.start;
  pair.axis = vector_of<Float>(capsule.half_axis);
  pair.a = vector_of<Float>(triangle.a);
  pair.b = vector_of<Float>(triangle.b);
  pair.c = vector_of<Float>(triangle.c);
  pair.radius = double{capsule.radius};
  pair.rr = pair.radius * pair.radius;
  pair.tiny = 1;
  mpf_div_2exp(pair.tiny.get_mpf_t(), pair.tiny.get_mpf_t(), static_cast<mp_bitcnt_t>(bits / 4));
  const auto n = cross(pair.b - pair.a, pair.c - pair.a);
  pair.area = dot(n, n);
  return pair;
}

/// Two points of a triangle and of a core, with the place of the latter on it, in [-1, 1].
struct NearestPair {
  Float u, v, distance, place;
};

/// Finds the nearest points of the triangle and of the core with a centre. Of several, it is the pair whose point of
/// the core is nearest to the centre.
NearestPair nearest_to_core(const FloatPair& pair, const Vec<Float>& centre) {
  std::vector<NearestPair> all;
  const auto take_place = [&](const Float& place) {
    if (abs(place) > 1) return;
    const auto nearest = nearest_on_triangle(along(centre, place, pair.axis), pair);
    all.push_back({nearest.u, nearest.v, nearest.distance, place});
  };
  for (const int place : {-1, 0, 1}) take_place(Float(place));
  const Float length = dot(pair.axis, pair.axis);
  if (length != 0) {
    const std::array corners = {pair.a, pair.b, pair.c, pair.a};
    for (std::size_t i = 0; i < 3; ++i) {
      // The points of the core that are nearest to a corner and to the line of an edge.
      const auto w = centre - corners[i];
      take_place(Float(-dot(w, pair.axis) / length));
      const auto m = cross(corners[i + 1] - corners[i], pair.axis);
      const Float square = dot(m, m);
      if (square != 0) take_place(Float(dot(m, cross(w, corners[i + 1] - corners[i])) / square));
    }
    const auto n = cross(pair.b - pair.a, pair.c - pair.a);
    const Float tilt = dot(n, pair.axis);
    if (tilt != 0) take_place(Float(-dot(n, centre - pair.a) / tilt));
  }
  const auto best =
      std::min_element(all.begin(), all.end(), [](const auto& x, const auto& y) { return x.distance < y.distance; });
  // Distances that are equal differ by roundings of squares of coordinates.
  const auto gap = centre - pair.a;
  const Float size =
      Float(dot(gap, gap) + length + dot(pair.b - pair.a, pair.b - pair.a) + dot(pair.c - pair.a, pair.c - pair.a));
  const Float limit = best->distance + pair.tiny * size;
  NearestPair result = *best;
  for (const NearestPair& other : all) {
    if (other.distance <= limit && abs(other.place) < abs(result.place)) result = other;
  }
  return result;
}

/// All t at which the centre comes within the radius of a plane, a line or a corner of the triangle that is swept along
/// the core.
std::vector<Float> roots(const FloatPair& pair) {
  std::vector<Float> all;
  const auto add = [&](const Float& a, const Float& b, const Float& c) {
    if (const auto root = lower_root(a, b, c, pair.tiny)) all.push_back(*root);
  };
  const auto to_point = [&](const Vec<Float>& w) {
    add(dot(pair.step, pair.step), dot(pair.step, w), Float(dot(w, w) - pair.rr));
  };
  const auto to_line = [&](const Vec<Float>& w, const Vec<Float>& e) {
    const Float ee = dot(e, e);
    if (ee == 0) return;
    const auto w_across = along(w, Float(-dot(w, e) / ee), e);
    const auto d_across = along(pair.step, Float(-dot(pair.step, e) / ee), e);
    if (dot(d_across, d_across) <= pair.tiny * dot(pair.step, pair.step)) return;
    add(dot(d_across, d_across), dot(d_across, w_across), Float(dot(w_across, w_across) - pair.rr));
  };
  const auto to_plane = [&](const Vec<Float>& w, const Vec<Float>& n) {
    const Float nn = dot(n, n);
    const Float rate = dot(n, pair.step);
    if (nn == 0 || rate == 0) return;
    const Float h = dot(n, w);
    const Float reach = pair.radius * sqrt(nn);
    all.push_back(Float(-(h + (h > 0 ? -reach : reach)) / rate));
  };
  const std::array corners = {pair.a, pair.b, pair.c, pair.a};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto w = pair.start - corners[i];
    const auto e = corners[i + 1] - corners[i];
    to_line(w, pair.axis);
    to_plane(w, cross(e, pair.axis));
    for (const int end : {-1, 1}) {
      const auto of_end = along(w, Float(end), pair.axis);
      to_point(of_end);
      to_line(of_end, e);
      if (i == 0) to_plane(of_end, cross(pair.b - pair.a, pair.c - pair.a));
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// The t of the first contact among roots that `may_be` accepts.
template <typename MayBe>
std::optional<Float> first_time(const FloatPair& pair, const MayBe& may_be) {
  const Float slack = pair.tiny * (pair.rr + pair.tiny * dot(pair.step, pair.step));
  for (const Float& root : roots(pair)) {
    if (root < 0 || root > 1 + pair.tiny || !may_be(root)) continue;
    if (nearest_to_core(pair, along(pair.start, root, pair.step)).distance <= pair.rr + slack) return root;
  }
  return std::nullopt;
}

/// The exact t of a hit.
template <typename Scalar>
std::optional<Float> first_time_of(const FloatPair& pair, const ShapeHit<Scalar>& hit) {
  return first_time(pair, [&](const Float& root) { return rounds_to(root, hit.t, pair.tiny); });
}

/// The weights and the feature at the exact t, which rounds to that of the hit.
template <typename Scalar>
std::optional<std::string> find_error_of_point(const FloatPair& pair, const ShapeHit<Scalar>& hit) {
  Float t(0);
  if (!hit.started_touching) {
    const auto first = first_time_of(pair, hit);
    if (!first) return "the judge finds no t";
    t = *first;
  }
  const NearestPair nearest = nearest_to_core(pair, along(pair.start, t, pair.step));
  if (!rounds_to(nearest.u, hit.u, pair.tiny)) return "u is wrong";
  if (!rounds_to(nearest.v, hit.v, pair.tiny)) return "v is wrong";
  if (pair.area == 0) return std::nullopt;  // Names of the parts are tested by named cases.
  if (hit.feature != feature_at(nearest.u, nearest.v, pair.tiny)) return "the feature is wrong";
  return std::nullopt;
}

}  // namespace

template <typename Scalar>
std::optional<std::string> find_error(const SweptCapsule<Scalar>& capsule, const Triangle<Scalar>& triangle,
                                      const std::optional<ShapeHit<Scalar>>& answer) {
  const Pair<Whole> pair = to_whole(capsule, triangle);
  if (!touches_until(pair, 1, 0)) {
    return answer ? std::optional<std::string>("a hit, but they do not touch") : std::nullopt;
  }
  if (!answer) return "a miss, but they touch";
  const bool starts = touches_until(pair, 0, 0);
  if (answer->started_touching != starts) return "started_touching is wrong";
  if (starts && answer->t != 0) return "t is not 0";
  if (!starts) {
    if (!(answer->t >= 0 && answer->t <= 1)) return "t is not in [0, 1]";
    if (const auto error = find_error_of_t(pair, answer->t)) return error;
  }
  return find_error_of_point(to_float(capsule, triangle), *answer);
}

template <typename Scalar>
std::optional<std::string> find_error_of_normal(const SweptCapsule<Scalar>& capsule, const Triangle<Scalar>& triangle,
                                                const ShapeHit<Scalar>& hit, const Vector3<Scalar>& normal,
                                                double allowed) {
  const FloatPair pair = to_float(capsule, triangle);
  const Float t = hit.started_touching ? Float(0) : first_time_of(pair, hit).value();
  const auto centre = along(pair.start, t, pair.step);
  const NearestPair nearest = nearest_to_core(pair, centre);
  const auto point =
      along(along(pair.a, nearest.u, Vec<Float>(pair.b - pair.a)), nearest.v, Vec<Float>(pair.c - pair.a));
  return find_error_of_unit(point, along(centre, nearest.place, pair.axis), normal, allowed, pair.tiny);
}

template <typename Scalar>
bool comes_before(const SweptCapsule<Scalar>& capsule, const Triangle<Scalar>& x, const Triangle<Scalar>& y) {
  const FloatPair of_x = to_float(capsule, x);
  const FloatPair of_y = to_float(capsule, y);
  const auto is_any = [](const Float&) { return true; };
  const Float x_time = first_time(of_x, is_any).value();
  const Float y_time = first_time(of_y, is_any).value();
  return x_time < y_time - std::max(of_x.tiny, of_y.tiny) * y_time;
}

#define SUREHIT_INSTANTIATE(Scalar)                                                                                  \
  template std::optional<std::string> find_error(const SweptCapsule<Scalar>&, const Triangle<Scalar>&,               \
                                                 const std::optional<ShapeHit<Scalar>>&);                            \
  template std::optional<std::string> find_error_of_normal(const SweptCapsule<Scalar>&, const Triangle<Scalar>&,     \
                                                           const ShapeHit<Scalar>&, const Vector3<Scalar>&, double); \
  template bool comes_before(const SweptCapsule<Scalar>&, const Triangle<Scalar>&, const Triangle<Scalar>&);
SUREHIT_INSTANTIATE(float)
SUREHIT_INSTANTIATE(double)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit::test
