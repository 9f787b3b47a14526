#include "support/sphere_oracle.hpp"

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "support/nearest_points.hpp"

namespace surehit::test {
namespace {

using namespace oracle;

template <typename Scalar>
RationalPair rational(const SweptSphere<Scalar>& sphere, const Triangle<Scalar>& triangle) {
  const mpq_class r(double{sphere.radius});
  const auto start = vector_of<mpq_class>(sphere.start);
  return {start,
          vector_of<mpq_class>(sphere.end) - start,
          vector_of<mpq_class>(triangle.a),
          vector_of<mpq_class>(triangle.b),
          vector_of<mpq_class>(triangle.c),
          mpq_class(r * r)};
}

/// The squared distance between two segments.
mpq_class distance_of_segments(const Vec<mpq_class>& p, const Vec<mpq_class>& q, const Vec<mpq_class>& a,
                               const Vec<mpq_class>& b) {
  const auto from_point = [](const auto& x, const auto& y, const auto& z) {
    const auto gap = x - along(y, nearest_on_segment(x, y, z), Vec<mpq_class>(z - y));
    return dot(gap, gap);
  };
  mpq_class best = std::min({from_point(p, a, b), from_point(q, a, b), from_point(a, p, q), from_point(b, p, q)});
  const auto d = q - p;
  const auto e = b - a;
  const auto w = p - a;
  const mpq_class dd = dot(d, d);
  const mpq_class de = dot(d, e);
  const mpq_class ee = dot(e, e);
  const mpq_class det = dd * ee - de * de;
  if (det == 0) return best;
  const mpq_class dw = dot(d, w);
  const mpq_class ew = dot(e, w);
  const mpq_class s = (de * ew - ee * dw) / det;
  const mpq_class t = (dd * ew - de * dw) / det;
  if (s < 0 || s > 1 || t < 0 || t > 1) return best;
  const auto gap = along(p, s, d) - along(a, t, e);
  return std::min(best, dot(gap, gap));
}

/// The squared distance between the first part of the way, up to t, and the triangle.
mpq_class distance_until(const RationalPair& pair, const mpq_class& t) {
  const auto end = along(pair.start, t, pair.step);
  const auto n = cross(pair.b - pair.a, pair.c - pair.a);
  const mpq_class rate = dot(n, end - pair.start);
  if (rate != 0) {
    const mpq_class s = -dot(n, pair.start - pair.a) / rate;
    if (s >= 0 && s <= 1) {
      const auto nearest = nearest_on_triangle(along(pair.start, s, Vec<mpq_class>(end - pair.start)), pair);
      if (nearest.distance == 0) return 0;
    }
  }
  return std::min({nearest_on_triangle(pair.start, pair).distance, nearest_on_triangle(end, pair).distance,
                   distance_of_segments(pair.start, end, pair.a, pair.b),
                   distance_of_segments(pair.start, end, pair.b, pair.c),
                   distance_of_segments(pair.start, end, pair.c, pair.a)});
}

bool touches_before(const RationalPair& pair, const mpq_class& t) {
  mpz_class fine = 1;
  fine <<= 400;
  return distance_until(pair, t * (1 - mpq_class(mpz_class(1), fine))) <= pair.rr;
}

/// What is known of t: it is in the interval that rounds to `t`, with ties to even.
template <typename Scalar>
std::optional<std::string> find_error_of_t(const RationalPair& pair, Scalar t) {
  const bool is_even =
      (std::bit_cast<std::conditional_t<sizeof(Scalar) == 4, std::uint32_t, std::uint64_t>>(t) & 1) == 0;
  const mpq_class exact(double{t});
  const mpq_class above = (exact + mpq_class(double{std::nextafter(t, Scalar{2})})) / 2;
  if (t < 1) {
    if (distance_until(pair, above) > pair.rr) return "t is too low";
    if (!is_even && !touches_before(pair, above)) return "t is the lower one of a tie, and odd";
  }
  if (t > 0) {
    const mpq_class below = (exact + mpq_class(double{std::nextafter(t, Scalar{0})})) / 2;
    if (distance_until(pair, below) <= pair.rr && (!is_even || touches_before(pair, below))) return "t is too high";
  }
  return std::nullopt;
}

/// All t at which the centre comes to a distance of the radius from the plane, the line of an edge, or a corner.
std::vector<Float> roots(const PairOf<Float>& pair, const Float& tiny) {
  std::vector<Float> all;
  const auto add = [&](const Float& a, const Float& b, const Float& c) {
    if (const auto root = lower_root(a, b, c, tiny)) all.push_back(*root);
  };
  const std::array corners = {pair.a, pair.b, pair.c, pair.a};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto w = pair.start - corners[i];
    add(dot(pair.step, pair.step), dot(pair.step, w), Float(dot(w, w) - pair.rr));
    // The parts of w and of the step across the edge.
    const auto e = corners[i + 1] - corners[i];
    const Float ee = dot(e, e);
    if (ee == 0) continue;
    const auto w_across = along(w, Float(-dot(w, e) / ee), e);
    const auto d_across = along(pair.step, Float(-dot(pair.step, e) / ee), e);
    if (dot(d_across, d_across) <= tiny * dot(pair.step, pair.step)) continue;
    add(dot(d_across, d_across), dot(d_across, w_across), Float(dot(w_across, w_across) - pair.rr));
  }
  const auto n = cross(pair.b - pair.a, pair.c - pair.a);
  const Float nn = dot(n, n);
  if (nn != 0) {
    const Float h = dot(n, pair.start - pair.a);
    const Float rate = dot(n, pair.step);
    if (rate != 0) {
      const Float reach = sqrt(Float(pair.rr * nn));
      all.push_back(Float(-(h + (h > 0 ? -reach : reach)) / rate));
    }
  }
  return all;
}

/// Bits of the floats, which hold all that a tie does not decide.
template <typename Scalar>
constexpr mp_bitcnt_t precision = sizeof(Scalar) == 4 ? 6000 : 30000;

template <typename Scalar>
Float tiny_number() {
  mpf_set_default_prec(precision<Scalar>);
  Float tiny(1);
  mpf_div_2exp(tiny.get_mpf_t(), tiny.get_mpf_t(), precision<Scalar> / 4);
  return tiny;
}

/// Floats of the default precision. They hold all numbers of a pair.
Vec<Float> to_floats(const Vec<mpq_class>& x) { return {Float(x[0]), Float(x[1]), Float(x[2])}; }
PairOf<Float> to_floats(const RationalPair& pair) {
  return {to_floats(pair.start), to_floats(pair.step), to_floats(pair.a),
          to_floats(pair.b),     to_floats(pair.c),    Float(pair.rr)};
}

/// The t of the first contact, if the ball does not begin with it.
std::optional<Float> first_time(const PairOf<Float>& pair, const Float& tiny) {
  std::optional<Float> first;
  const Float slack = tiny * (pair.rr + tiny * dot(pair.step, pair.step));
  for (const Float& root : roots(pair, tiny)) {
    if (root < 0 || root > 1 + tiny || (first && *first < root)) continue;
    const Float distance = nearest_on_triangle(along(pair.start, root, pair.step), pair).distance;
    if (distance <= pair.rr + slack) first = root;
  }
  return first;
}

/// The weights and the feature at the exact t.
template <typename Scalar>
std::optional<std::string> find_error_of_point(const RationalPair& exact, const ShapeHit<Scalar>& hit) {
  const Float tiny = tiny_number<Scalar>();
  const PairOf<Float> pair = to_floats(exact);
  Float t(0);
  if (!hit.started_touching) {
    const std::optional<Float> first = first_time(pair, tiny);
    if (!first) return "the judge finds no t";
    t = *first;
    if (!rounds_to(t, hit.t, tiny)) return "t is wrong";
  }
  const auto nearest = nearest_on_triangle(along(pair.start, t, pair.step), pair);
  if (!rounds_to(nearest.u, hit.u, tiny)) return "u is wrong";
  if (!rounds_to(nearest.v, hit.v, tiny)) return "v is wrong";
  const auto e = cross(pair.b - pair.a, pair.c - pair.a);
  if (dot(e, e) == 0) return std::nullopt;  // Names of the parts are tested by named cases.
  if (hit.feature != feature_at(nearest.u, nearest.v, tiny)) return "the feature is wrong";
  return std::nullopt;
}

template <typename Scalar>
mpf_class first_time(const RationalPair& pair) {
  const Float tiny = tiny_number<Scalar>();
  return first_time(to_floats(pair), tiny).value();
}

template <typename Scalar>
bool is_before(const mpf_class& x, const mpf_class& y) {
  return x < y - tiny_number<Scalar>() * x;
}

}  // namespace

template <typename Scalar>
std::optional<std::string> find_error(const SweptSphere<Scalar>& sphere, const Triangle<Scalar>& triangle,
                                      const std::optional<ShapeHit<Scalar>>& answer) {
  const RationalPair pair = rational(sphere, triangle);
  if (distance_until(pair, 1) > pair.rr) {
    return answer ? std::optional<std::string>("a hit, but they do not touch") : std::nullopt;
  }
  if (!answer) return "a miss, but they touch";
  const bool starts = distance_until(pair, 0) <= pair.rr;
  if (answer->started_touching != starts) return "started_touching is wrong";
  if (starts && answer->t != 0) return "t is not 0";
  if (!starts) {
    if (!(answer->t >= 0 && answer->t <= 1)) return "t is not in [0, 1]";
    if (const auto error = find_error_of_t(pair, answer->t)) return error;
  }
  return find_error_of_point(pair, *answer);
}

template <typename Scalar>
std::optional<std::string> find_error_of_normal(const RationalPair& exact, const ShapeHit<Scalar>& hit,
                                                const Vector3<Scalar>& normal, double allowed) {
  const Float tiny = tiny_number<Scalar>();
  const PairOf<Float> pair = to_floats(exact);
  const Float t = hit.started_touching ? Float(0) : first_time(pair, tiny).value();
  const auto centre = along(pair.start, t, pair.step);
  const auto nearest = nearest_on_triangle(centre, pair);
  const auto point =
      along(along(pair.a, nearest.u, Vec<Float>(pair.b - pair.a)), nearest.v, Vec<Float>(pair.c - pair.a));
  return find_error_of_unit(point, centre, normal, allowed, tiny);
}

template <typename Scalar>
std::optional<std::string> find_error_of_normal(const SweptSphere<Scalar>& sphere, const Triangle<Scalar>& triangle,
                                                const ShapeHit<Scalar>& hit, const Vector3<Scalar>& normal,
                                                double allowed) {
  return find_error_of_normal(rational(sphere, triangle), hit, normal, allowed);
}

template <typename Scalar>
bool comes_before(const SweptSphere<Scalar>& sphere, const Triangle<Scalar>& x, const Triangle<Scalar>& y) {
  return is_before<Scalar>(first_time<Scalar>(rational(sphere, x)), first_time<Scalar>(rational(sphere, y)));
}

#define SUREHIT_INSTANTIATE(Scalar)                                                                                  \
  template std::optional<std::string> find_error(const SweptSphere<Scalar>&, const Triangle<Scalar>&,                \
                                                 const std::optional<ShapeHit<Scalar>>&);                            \
  template std::optional<std::string> find_error_of_normal(const RationalPair&, const ShapeHit<Scalar>&,             \
                                                           const Vector3<Scalar>&, double);                          \
  template std::optional<std::string> find_error_of_normal(const SweptSphere<Scalar>&, const Triangle<Scalar>&,      \
                                                           const ShapeHit<Scalar>&, const Vector3<Scalar>&, double); \
  template bool comes_before(const SweptSphere<Scalar>&, const Triangle<Scalar>&, const Triangle<Scalar>&);
SUREHIT_INSTANTIATE(float)
SUREHIT_INSTANTIATE(double)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit::test
