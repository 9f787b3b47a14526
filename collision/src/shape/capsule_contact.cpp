#include "shape/capsule_contact.hpp"

#include <cmath>

#include "path_range.hpp"
#include "shape/sphere_contact.hpp"

namespace surehit::detail {

template <typename Scalar>
bool is_valid(const SweptCapsule<Scalar>& capsule) {
  return is_finite(capsule.start) && is_finite(capsule.end) && is_finite(capsule.half_axis) &&
         std::isfinite(capsule.radius) && capsule.radius >= 0;
}

template <typename Scalar>
SweptExtents swept_extents(const SweptCapsule<Scalar>& capsule) {
  SweptExtents swept;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    swept.start[i] = capsule.start[axis];
    swept.end[i] = capsule.end[axis];
    swept.half_extents[i] = double{capsule.radius} + std::fabs(double{capsule.half_axis[axis]});
  }
  return swept;
}

template <typename Scalar>
bool are_timed_alike(const Triangle<Scalar>& x_triangle, const CapsuleContact& x, const Triangle<Scalar>& y_triangle,
                     const CapsuleContact& y) {
  const auto timed_as_ball = [](const CapsuleContact& contact) {
    return SphereContact{contact.t_lower, contact.t_upper, contact.feature, contact.feature};
  };
  return are_timed_alike(x_triangle, timed_as_ball(x), y_triangle, timed_as_ball(y));
}

#define SUREHIT_INSTANTIATE(Scalar)                                                                      \
  template bool is_valid(const SweptCapsule<Scalar>&);                                                   \
  template SweptExtents swept_extents(const SweptCapsule<Scalar>&);                                      \
  template bool are_timed_alike(const Triangle<Scalar>&, const CapsuleContact&, const Triangle<Scalar>&, \
                                const CapsuleContact&);
SUREHIT_INSTANTIATE(float)
SUREHIT_INSTANTIATE(double)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit::detail
