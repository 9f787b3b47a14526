#include "cgal_sphere_oracle.hpp"

#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Sqrt_extension.h>
#include <CGAL/intersections.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <variant>

namespace surehit::test {
namespace {

using Rational = CGAL::Exact_rational;
using Kernel = CGAL::Simple_cartesian<Rational>;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;
using OneRoot = CGAL::Sqrt_extension<Rational, Rational, CGAL::Tag_true>;

// CGAL asks its arguments to be what their names say: none of its segments is a point.
using Way = std::variant<Point, Kernel::Segment_3>;
using Hull = std::variant<Point, Kernel::Segment_3, Kernel::Triangle_3>;

template <typename Scalar>
Point to_point(const Vector3<Scalar>& x) {
  return {Rational(double{x[0]}), Rational(double{x[1]}), Rational(double{x[2]})};
}

Way way_between(const Point& start, const Point& end) {
  if (start == end) return start;
  return Kernel::Segment_3(start, end);
}

struct ExactSphere {
  Point start;
  Vector step;
  Rational rr;
  std::array<Point, 3> corners;

  template <typename Scalar>
  ExactSphere(const SweptSphere<Scalar>& sphere, const Triangle<Scalar>& triangle)
      : start(to_point(sphere.start)),
        step(to_point(sphere.end) - start),
        rr(Rational(double{sphere.radius}) * Rational(double{sphere.radius})),
        corners{to_point(triangle.a), to_point(triangle.b), to_point(triangle.c)} {}

  [[nodiscard]] bool has_area() const { return !CGAL::collinear(corners[0], corners[1], corners[2]); }

  /// A triangle without area is the segment between its extreme corners, or a point.
  [[nodiscard]] Hull hull() const {
    if (has_area()) return Kernel::Triangle_3(corners[0], corners[1], corners[2]);
    const auto [low, high] = std::minmax_element(corners.begin(), corners.end());
    if (*low == *high) return *low;
    return Kernel::Segment_3(*low, *high);
  }

  [[nodiscard]] Rational squared_distance_until(const Rational& t) const {
    const Point end = start + t * step;
    const Way way = way_between(start, end);
    const auto distance = [](const auto& x, const auto& y) -> Rational { return CGAL::squared_distance(x, y); };
    const Hull shape = hull();
    const auto* const triangle = std::get_if<Kernel::Triangle_3>(&shape);
    if (triangle == nullptr) {
      const auto to_hull = [&](const auto& part) {
        if (const auto* const point = std::get_if<Point>(&shape)) return distance(part, *point);
        return distance(part, std::get<Kernel::Segment_3>(shape));
      };
      return std::visit(to_hull, way);
    }
    const auto* const segment = std::get_if<Kernel::Segment_3>(&way);
    if (segment == nullptr) return distance(start, *triangle);
    if (CGAL::do_intersect(*segment, *triangle)) return 0;
    Rational best = std::min(distance(start, *triangle), distance(end, *triangle));
    for (std::size_t i = 0; i < 3; ++i) {
      best = std::min(best, distance(*segment, Kernel::Segment_3(corners[i], corners[(i + 1) % 3])));
    }
    return best;
  }
  [[nodiscard]] bool touches_until(const Rational& t) const { return squared_distance_until(t) <= rr; }
};

template <typename Scalar>
Rational middle(Scalar x, Scalar y) {
  return (Rational(double{x}) + Rational(double{y})) / 2;
}

template <typename Scalar>
bool rounds_to(const OneRoot& exact, Scalar x) {
  if (!(x >= 0 && x <= 1) || std::signbit(x)) return false;
  using Bits = std::conditional_t<sizeof(Scalar) == 4, std::uint32_t, std::uint64_t>;
  const bool is_even = (std::bit_cast<Bits>(x) & 1) == 0;
  const auto over = CGAL::compare(exact, OneRoot(middle(x, std::nextafter(x, Scalar{2}))));
  if (over == CGAL::LARGER || (over == CGAL::EQUAL && !is_even)) return false;
  if (x == 0) return CGAL::sign(exact) != CGAL::NEGATIVE;
  const auto under = CGAL::compare(exact, OneRoot(middle(x, std::nextafter(x, Scalar{0}))));
  return under == CGAL::LARGER || (under == CGAL::EQUAL && is_even);
}

/// A quantity that is linear in t.
struct Linear {
  Rational constant = 0;
  Rational rate = 0;

  [[nodiscard]] OneRoot at(const OneRoot& t) const { return OneRoot(constant) + OneRoot(rate) * t; }
};

/// The answered part: the equation of its time, and the weights of the three corners.
struct AnsweredPart {
  Rational a, b, c;
  std::array<Linear, 3> weights;
};

AnsweredPart corner_part(const ExactSphere& sphere, std::size_t corner) {
  const Vector w = sphere.start - sphere.corners[corner];
  AnsweredPart part{sphere.step * sphere.step, sphere.step * w, w * w - sphere.rr, {}};
  part.weights[corner].constant = 1;
  return part;
}

AnsweredPart edge_part(const ExactSphere& sphere, std::size_t from, std::size_t to) {
  const Vector e = sphere.corners[to] - sphere.corners[from];
  const Vector w = sphere.start - sphere.corners[from];
  // The parts of both across the edge.
  const Vector step = sphere.step - (sphere.step * e) / (e * e) * e;
  const Vector across = w - (w * e) / (e * e) * e;
  AnsweredPart part{step * step, step * across, across * across - sphere.rr, {}};
  part.weights[to] = {(w * e) / (e * e), (sphere.step * e) / (e * e)};
  part.weights[from] = {1 - part.weights[to].constant, -part.weights[to].rate};
  return part;
}

AnsweredPart face_part(const ExactSphere& sphere) {
  const Vector to_b = sphere.corners[1] - sphere.corners[0];
  const Vector to_c = sphere.corners[2] - sphere.corners[0];
  const Vector n = CGAL::cross_product(to_b, to_c);
  const Rational nn = n * n;
  const Vector w = sphere.start - sphere.corners[0];
  const Rational rate = (n * sphere.step);
  const Rational height = (n * w);
  AnsweredPart part{rate * rate / nn, rate * height / nn, height * height / nn - sphere.rr, {}};
  part.weights[1] = {n * CGAL::cross_product(w, to_c) / nn, n * CGAL::cross_product(sphere.step, to_c) / nn};
  part.weights[2] = {n * CGAL::cross_product(to_b, w) / nn, n * CGAL::cross_product(to_b, sphere.step) / nn};
  part.weights[0] = {1 - part.weights[1].constant - part.weights[2].constant,
                     -part.weights[1].rate - part.weights[2].rate};
  return part;
}

AnsweredPart part_of(const ExactSphere& sphere, Feature feature) {
  const auto number = static_cast<std::size_t>(feature);
  if (feature == Feature::face) return face_part(sphere);
  if (feature < Feature::corner_a) return edge_part(sphere, number - 1, number % 3);
  return corner_part(sphere, number - 4);
}

/// Each corner of the part has a weight above 0, and no other corner has one.
bool is_inside(const std::array<OneRoot, 3>& weights, Feature feature) {
  constexpr std::array<std::array<bool, 3>, 7> has = {{{true, true, true},
                                                       {true, true, false},
                                                       {false, true, true},
                                                       {true, false, true},
                                                       {true, false, false},
                                                       {false, true, false},
                                                       {false, false, true}}};
  for (std::size_t i = 0; i < 3; ++i) {
    const bool is_positive = CGAL::sign(weights[i]) == CGAL::POSITIVE;
    if (is_positive != has[static_cast<std::size_t>(feature)][i]) return false;
  }
  return true;
}

template <typename Scalar>
std::optional<std::string> error_of_t(const ExactSphere& sphere, Scalar t) {
  if (!(t >= 0 && t <= 1)) return "CGAL: t is not in [0, 1]";
  if (t < 1 && !sphere.touches_until(middle(t, std::nextafter(t, Scalar{2})))) return "CGAL: t is too low";
  if (t == 0) return std::nullopt;
  // A little less than the middle, for the contact may be at the middle itself.
  const Rational below = middle(t, std::nextafter(t, Scalar{0}));
  if (sphere.touches_until(below - below / Rational(std::ldexp(1.0, 200)))) return "CGAL: t is too high";
  return std::nullopt;
}

}  // namespace

template <typename Scalar>
std::optional<std::string> cgal_error(const SweptSphere<Scalar>& sphere, const Triangle<Scalar>& triangle,
                                      const std::optional<ShapeHit<Scalar>>& answer) {
  const ExactSphere exact(sphere, triangle);
  if (exact.touches_until(1) != answer.has_value()) {
    return answer ? "CGAL: a hit, but they do not touch" : "CGAL: a miss, but they touch";
  }
  if (!answer) return std::nullopt;
  const bool starts = exact.touches_until(0);
  if (answer->started_touching != starts) return "CGAL: started_touching is wrong";
  if (answer->feature == Feature::face && !exact.has_area()) return "CGAL: a triangle without area has no face";
  const AnsweredPart part = part_of(exact, answer->feature);
  OneRoot t(0);
  if (!starts) {
    if (const auto error = error_of_t(exact, answer->t)) return error;
    const Rational discriminant = part.b * part.b - part.a * part.c;
    if (part.a == 0 || discriminant < 0) return "CGAL: the part is never at a distance of the radius";
    t = OneRoot(-part.b / part.a, -1 / part.a, discriminant);
  }
  if (!rounds_to(t, answer->t)) return "CGAL: t is wrong";
  std::array<OneRoot, 3> weights;
  for (std::size_t i = 0; i < 3; ++i) weights[i] = part.weights[i].at(t);
  if (!is_inside(weights, answer->feature)) return "CGAL: the feature is wrong";
  if (!rounds_to(weights[1], answer->u)) return "CGAL: u is wrong";
  if (!rounds_to(weights[2], answer->v)) return "CGAL: v is wrong";
  return std::nullopt;
}

#define SUREHIT_INSTANTIATE(Scalar)                                                                   \
  template std::optional<std::string> cgal_error(const SweptSphere<Scalar>&, const Triangle<Scalar>&, \
                                                 const std::optional<ShapeHit<Scalar>>&);
SUREHIT_INSTANTIATE(float)
SUREHIT_INSTANTIATE(double)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit::test
