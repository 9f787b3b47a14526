#pragma once

#include "support/box_families.hpp"
#include "support/capsule_families.hpp"
#include "support/random.hpp"
#include "support/sphere_families.hpp"

namespace surehit::test {

/// All families of one kind of shape.
template <typename Family>
inline constexpr const auto& all_families = all_sphere_families;
template <>
inline constexpr const auto& all_families<BoxFamily> = all_box_families;
template <>
inline constexpr const auto& all_families<CapsuleFamily> = all_capsule_families;

/// Draws the next shape and triangle of a family. The shape is the first member of the result.
template <typename Scalar>
[[nodiscard]] auto draw_shape_pair(SphereFamily family, Random& random) {
  return draw_sphere_pair<Scalar>(family, random);
}
template <typename Scalar>
[[nodiscard]] auto draw_shape_pair(BoxFamily family, Random& random) {
  return draw_box_pair<Scalar>(family, random);
}
template <typename Scalar>
[[nodiscard]] auto draw_shape_pair(CapsuleFamily family, Random& random) {
  return draw_capsule_pair<Scalar>(family, random);
}

}  // namespace surehit::test
