#include "cgal_sphere_oracle.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <variant>

#include "cgal_shapes.hpp"

namespace surehit::test {
namespace {

using namespace cgal;

// CGAL asks its arguments to be what their names say: none of its segments is a point.
using Way = std::variant<Point, Kernel::Segment_3>;
using Hull = std::variant<Point, Kernel::Segment_3, Kernel::Triangle_3>;

Way way_between(const Point& start, const Point& end) {
  if (start == end) return start;
  return Kernel::Segment_3(start, end);
}

struct ExactSphere {
  Point start;
  Vector step;
  Rational rr;
  Corners corners;

  template <typename Scalar>
  ExactSphere(const SweptSphere<Scalar>& sphere, const Triangle<Scalar>& triangle)
      : start(to_point(sphere.start)),
        step(to_point(sphere.end) - start),
        rr(Rational(double{sphere.radius}) * Rational(double{sphere.radius})),
        corners(to_corners(triangle)) {}

  /// A triangle without area is the segment between its extreme corners, or a point.
  [[nodiscard]] Hull hull() const {
    if (has_area(corners)) return Kernel::Triangle_3(corners[0], corners[1], corners[2]);
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
  const auto parts = meet(exact.start, exact.step, exact.rr, exact.corners, answer->feature);
  if (!parts) return "CGAL: there is no such part";
  OneRoot t(0);
  if (!starts) {
    const auto touches_until = [&](const Rational& end) { return exact.touches_until(end); };
    if (const auto error = error_of_t(answer->t, touches_until)) return error;
    const std::optional<OneRoot> time = parts->time();
    if (!time) return "CGAL: the part is never at a distance of the radius";
    t = *time;
  }
  if (!rounds_to(t, answer->t)) return "CGAL: t is wrong";
  std::array<OneRoot, 3> weights;
  for (std::size_t i = 0; i < 3; ++i) weights[i] = parts->weights[i].at(t);
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
