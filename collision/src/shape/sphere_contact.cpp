#include "shape/sphere_contact.hpp"

#include <cmath>

#include "path_range.hpp"

namespace surehit::detail {
namespace {

/// Returns corner `index` of a triangle, where corner 3 is the first one again.
template <typename Scalar>
const Vector3<Scalar>& corner(const Triangle<Scalar>& triangle, std::size_t index) {
  return index == 1 ? triangle.b : index == 2 ? triangle.c : triangle.a;
}

}  // namespace

template <typename Scalar>
bool is_valid(const SweptSphere<Scalar>& sphere) {
  return is_finite(sphere.start) && is_finite(sphere.end) && std::isfinite(sphere.radius) && sphere.radius >= 0;
}

template <typename Scalar>
SweptExtents swept_extents(const SweptSphere<Scalar>& sphere) {
  SweptExtents swept;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    swept.start[i] = sphere.start[axis];
    swept.end[i] = sphere.end[axis];
    swept.half_extents[i] = sphere.radius;
  }
  return swept;
}

template <typename Scalar>
bool are_timed_alike(const Triangle<Scalar>& x_triangle, const SphereContact& x, const Triangle<Scalar>& y_triangle,
                     const SphereContact& y) {
  if (x.timed_by == Feature::face || y.timed_by == Feature::face || is_corner(x.timed_by) != is_corner(y.timed_by)) {
    return false;
  }
  const auto& x_first = corner(x_triangle, index_of(x.timed_by));
  const auto& y_first = corner(y_triangle, index_of(y.timed_by));
  if (is_corner(x.timed_by)) return x_first == y_first;
  const auto& x_last = corner(x_triangle, index_of(x.timed_by) + 1);
  const auto& y_last = corner(y_triangle, index_of(y.timed_by) + 1);
  return (x_first == y_first && x_last == y_last) || (x_first == y_last && x_last == y_first);
}

#define SUREHIT_INSTANTIATE(Scalar)                                                                     \
  template bool is_valid(const SweptSphere<Scalar>&);                                                   \
  template SweptExtents swept_extents(const SweptSphere<Scalar>&);                                      \
  template bool are_timed_alike(const Triangle<Scalar>&, const SphereContact&, const Triangle<Scalar>&, \
                                const SphereContact&);
SUREHIT_INSTANTIATE(float)
SUREHIT_INSTANTIATE(double)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit::detail
