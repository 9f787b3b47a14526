#include "cgal_oracle.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <array>
#include <cstddef>
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

/// A path with its end, if it has one.
struct ExactPath {
  PathKind kind;
  Point start;
  Kernel::Vector_3 direction;
  Point end;  ///< The end of a segment.

  [[nodiscard]] bool has_start() const { return kind != PathKind::line; }
  [[nodiscard]] bool has_end() const { return kind == PathKind::segment; }
};

using ExactTriangle = std::array<Point, 3>;

/// The ends as they were given need no construction, which spares the slow path of lazy numbers.
template <typename Scalar>
ExactPath exact_path(const Path<Scalar>& path) {
  const Point start = to_point(path.start);
  const Point toward = to_point(path.toward);
  return {path.kind, start, toward - (path.has_end() ? start : Point(0, 0, 0)), toward};
}

/// What is left of the path between the limits, if anything.
template <typename Scalar>
std::optional<CutPath> cut(const ExactPath& path, const QueryOptions<Scalar>& options) {
  constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
  if (!(options.min_t <= options.max_t)) return std::nullopt;
  const Scalar low = path.has_start() ? std::max(Scalar{0}, options.min_t) : options.min_t;
  const Scalar high = path.has_end() ? std::min(Scalar{1}, options.max_t) : options.max_t;
  if (low > high || low == infinity || high == -infinity) return std::nullopt;

  const auto& [kind, start, direction, end] = path;
  if (direction == CGAL::NULL_VECTOR) return low <= 0 && 0 <= high ? std::optional<CutPath>(start) : std::nullopt;

  const auto at = [&path](Scalar t) {
    if (t == 0) return path.start;
    if (t == 1 && path.has_end()) return path.end;
    return Point(path.start + double{t} * path.direction);
  };
  if (low == high) return at(low);
  if (low > -infinity && high < infinity) return Kernel::Segment_3(at(low), at(high));
  if (low > -infinity) return Kernel::Ray_3(at(low), direction);
  if (high < infinity) return Kernel::Ray_3(at(high), -direction);
  return Kernel::Line_3(start, direction);
}

Hull hull_of(const ExactTriangle& triangle) {
  const auto& [a, b, c] = triangle;
  if (!CGAL::collinear(a, b, c)) return Kernel::Triangle_3(a, b, c);
  const auto [least, greatest] = std::minmax({a, b, c});
  if (least == greatest) return least;
  return Kernel::Segment_3(least, greatest);
}

bool contains(const Hull& hull, const Point& point) {
  return std::visit([&](const auto& shape) { return CGAL::do_intersect(point, shape); }, hull);
}

bool is_culled(const ExactPath& path, const ExactTriangle& triangle, Culling culling) {
  if (culling == Culling::none) return false;
  const auto& [a, b, c] = triangle;
  const Kernel::Vector_3 normal = CGAL::cross_product(b - a, c - a);
  const CGAL::Sign along_normal = CGAL::sign(path.direction * normal);
  return along_normal != (culling == Culling::back ? CGAL::NEGATIVE : CGAL::POSITIVE);
}

template <typename Scalar>
bool meets(const ExactPath& path, const ExactTriangle& triangle, const QueryOptions<Scalar>& options) {
  const std::optional<CutPath> left = cut(path, options);
  if (!left) return false;
  const Hull hull = hull_of(triangle);
  const auto meet = [](const auto& part, const auto& shape) { return CGAL::do_intersect(part, shape); };
  return std::visit(meet, *left, hull) && !is_culled(path, triangle, options.culling) &&
         !(options.ignore_start_contact && path.has_start() && contains(hull, path.start)) &&
         !(options.ignore_end_contact && path.has_end() && contains(hull, path.end));
}

template <typename Scalar>
Point image(const Pose<Scalar>& pose, const Vector3<double>& corner) {
  std::array<Kernel::FT, 3> x;
  for (int row = 0; row < 3; ++row) {
    Kernel::FT& coordinate = x[static_cast<std::size_t>(row)];
    coordinate = double{pose.translation[row]};
    for (int column = 0; column < 3; ++column) {
      coordinate += Kernel::FT(double{pose.linear(row, column)}) * Kernel::FT(corner[column]);
    }
  }
  return {x[0], x[1], x[2]};
}

}  // namespace

template <typename Scalar>
bool cgal_meets(const Path<Scalar>& path, const Triangle<Scalar>& triangle, const QueryOptions<Scalar>& options) {
  return meets(exact_path(path), {to_point(triangle.a), to_point(triangle.b), to_point(triangle.c)}, options);
}

template <typename Scalar>
bool cgal_meets_placed(const Path<Scalar>& path, const Triangle<double>& triangle, const Pose<Scalar>& pose,
                       const Vector3<Scalar>& motion, const QueryOptions<Scalar>& options) {
  ExactPath seen = exact_path(path);
  if (path.has_end()) {
    // A path past an instance that moves is a path with another end past one that does not.
    seen.end = seen.end - (to_point(motion) - CGAL::ORIGIN);
    seen.direction = seen.end - seen.start;
  }
  return meets(seen, {image(pose, triangle.a), image(pose, triangle.b), image(pose, triangle.c)}, options);
}

template bool cgal_meets(const Path<float>&, const Triangle<float>&, const QueryOptions<float>&);
template bool cgal_meets(const Path<double>&, const Triangle<double>&, const QueryOptions<double>&);
template bool cgal_meets_placed(const Path<float>&, const Triangle<double>&, const Pose<float>&, const Vector3<float>&,
                                const QueryOptions<float>&);
template bool cgal_meets_placed(const Path<double>&, const Triangle<double>&, const Pose<double>&,
                                const Vector3<double>&, const QueryOptions<double>&);

}  // namespace surehit::test
