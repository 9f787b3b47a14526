#include "cgal_oracle.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>
#include <variant>

namespace surehit::test {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Kernel::Point_3;

// CGAL asks its arguments to be what their names say: not one of its segments is a point, not one of its triangles a
// segment.
using CutPath = std::variant<Point, Kernel::Segment_3, Kernel::Ray_3, Kernel::Line_3>;
using Hull = std::variant<Point, Kernel::Segment_3, Kernel::Triangle_3>;

template <typename Scalar>
Point to_point(const Vector3<Scalar>& x) {
  return {double{x[0]}, double{x[1]}, double{x[2]}};
}

template <typename Scalar>
Kernel::Vector_3 direction_of(const Path<Scalar>& path) {
  return to_point(path.toward) - (path.has_end() ? to_point(path.start) : Point(0, 0, 0));
}

/// What is left of the path between the limits, if anything.
template <typename Scalar>
std::optional<CutPath> cut(const Path<Scalar>& path, const QueryOptions<Scalar>& options) {
  constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
  if (!(options.min_t <= options.max_t)) return std::nullopt;
  const Scalar low = path.has_start() ? std::max(Scalar{0}, options.min_t) : options.min_t;
  const Scalar high = path.has_end() ? std::min(Scalar{1}, options.max_t) : options.max_t;
  if (low > high || low == infinity || high == -infinity) return std::nullopt;

  const Point start = to_point(path.start);
  const Kernel::Vector_3 direction = direction_of(path);
  if (direction == CGAL::NULL_VECTOR) return low <= 0 && 0 <= high ? std::optional<CutPath>(start) : std::nullopt;

  // The ends as they were given need no construction, which spares the slow path of lazy numbers.
  const auto at = [&](Scalar t) {
    if (t == 0) return start;
    if (t == 1 && path.has_end()) return to_point(path.toward);
    return Point(start + double{t} * direction);
  };
  if (low == high) return at(low);
  if (low > -infinity && high < infinity) return Kernel::Segment_3(at(low), at(high));
  if (low > -infinity) return Kernel::Ray_3(at(low), direction);
  if (high < infinity) return Kernel::Ray_3(at(high), -direction);
  return Kernel::Line_3(start, direction);
}

template <typename Scalar>
Hull hull_of(const Triangle<Scalar>& triangle) {
  const Point a = to_point(triangle.a);
  const Point b = to_point(triangle.b);
  const Point c = to_point(triangle.c);
  if (!CGAL::collinear(a, b, c)) return Kernel::Triangle_3(a, b, c);
  const auto [least, greatest] = std::minmax({a, b, c});
  if (least == greatest) return least;
  return Kernel::Segment_3(least, greatest);
}

bool contains(const Hull& hull, const Point& point) {
  return std::visit([&](const auto& shape) { return CGAL::do_intersect(point, shape); }, hull);
}

template <typename Scalar>
bool is_culled(const Path<Scalar>& path, const Triangle<Scalar>& triangle, Culling culling) {
  if (culling == Culling::none) return false;
  const Point a = to_point(triangle.a);
  const Kernel::Vector_3 normal = CGAL::cross_product(to_point(triangle.b) - a, to_point(triangle.c) - a);
  const CGAL::Sign along_normal = CGAL::sign(direction_of(path) * normal);
  return along_normal != (culling == Culling::back ? CGAL::NEGATIVE : CGAL::POSITIVE);
}

}  // namespace

template <typename Scalar>
bool cgal_meets(const Path<Scalar>& path, const Triangle<Scalar>& triangle, const QueryOptions<Scalar>& options) {
  const std::optional<CutPath> left = cut(path, options);
  if (!left) return false;
  const Hull hull = hull_of(triangle);
  const auto meet = [](const auto& part, const auto& shape) { return CGAL::do_intersect(part, shape); };
  return std::visit(meet, *left, hull) && !is_culled(path, triangle, options.culling) &&
         !(options.ignore_start_contact && path.has_start() && contains(hull, to_point(path.start))) &&
         !(options.ignore_end_contact && path.has_end() && contains(hull, to_point(path.toward)));
}

template bool cgal_meets(const Path<float>&, const Triangle<float>&, const QueryOptions<float>&);
template bool cgal_meets(const Path<double>&, const Triangle<double>&, const QueryOptions<double>&);

}  // namespace surehit::test
