#include "shape/box_contact.hpp"

#include <algorithm>

#include "path_range.hpp"

namespace surehit::detail {
namespace {

template <typename Scalar>
const Vector3<Scalar>& corner(const Triangle<Scalar>& triangle, std::size_t index) {
  return index == 0 ? triangle.a : index == 1 ? triangle.b : triangle.c;
}

/// Returns where a triangle begins or ends on an axis of coordinates.
template <typename Scalar>
Scalar bound(const Triangle<Scalar>& triangle, std::size_t coordinate, bool is_above) {
  const auto axis = static_cast<Eigen::Index>(coordinate);
  const auto [low, high] = std::minmax({triangle.a[axis], triangle.b[axis], triangle.c[axis]});
  return is_above ? high : low;
}

}  // namespace

template <typename Scalar>
bool is_valid(const SweptBox<Scalar>& box) {
  return is_finite(box.start) && is_finite(box.end) && is_finite(box.half_extents) && box.half_extents[0] >= 0 &&
         box.half_extents[1] >= 0 && box.half_extents[2] >= 0;
}

template <typename Scalar>
SweptExtents swept_extents(const SweptBox<Scalar>& box) {
  SweptExtents swept;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    swept.start[i] = box.start[axis];
    swept.end[i] = box.end[axis];
    swept.half_extents[i] = box.half_extents[axis];
  }
  return swept;
}

template <typename Scalar>
bool are_timed_alike(const Triangle<Scalar>& x_triangle, const BoxContact& x, const Triangle<Scalar>& y_triangle,
                     const BoxContact& y) {
  if (x.timed_by == normal_axis || y.timed_by == normal_axis) return false;
  if (x.timed_by == axis_count || y.timed_by == axis_count) return false;
  if (x.timed_by < normal_axis || y.timed_by < normal_axis) {
    return x.timed_by == y.timed_by && x.is_above == y.is_above &&
           bound(x_triangle, x.timed_by, x.is_above) == bound(y_triangle, y.timed_by, y.is_above);
  }
  if (coordinate_of(x.timed_by) != coordinate_of(y.timed_by)) return false;
  const auto& x_first = corner(x_triangle, edge_of(x.timed_by));
  const auto& y_first = corner(y_triangle, edge_of(y.timed_by));
  const auto& x_last = corner(x_triangle, next(edge_of(x.timed_by)));
  const auto& y_last = corner(y_triangle, next(edge_of(y.timed_by)));
  return (x_first == y_first && x_last == y_last) || (x_first == y_last && x_last == y_first);
}

#define SUREHIT_INSTANTIATE(Scalar)                             \
  template bool is_valid(const SweptBox<Scalar>&);              \
  template SweptExtents swept_extents(const SweptBox<Scalar>&); \
  template bool are_timed_alike(const Triangle<Scalar>&, const BoxContact&, const Triangle<Scalar>&, const BoxContact&);
SUREHIT_INSTANTIATE(float)
SUREHIT_INSTANTIATE(double)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit::detail
