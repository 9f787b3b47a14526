#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "exact/exact_scale.hpp"
#include "placement.hpp"
#include "shape/sphere_terms.hpp"
#include "support/inlining.hpp"
#include "surehit/triangle.hpp"

namespace surehit::detail {

// The differences of a moving shape and a triangle as integers in one unit. `AnyTriangle` is `Triangle` or
// `PlacedTriangle`. A shape is seen from an instance that moves, so its end and its step are less by its share of the
// motion. Each difference is then a sum of coordinates, and of products with the pose's matrix and the share.

/// The number of bits of a difference.
template <typename AnyTriangle>
struct DifferenceBits;
template <typename Scalar>
struct DifferenceBits<Triangle<Scalar>> {
  static constexpr int value = AnySize<Scalar>::coordinate + 1;
};
/// A difference of placed corners is a sum of three products of an entry of the pose and a difference of coordinates. A
/// sum with the start or the end, the translation and the motion is not larger, because its corner is no difference. A
/// share is between `min_share` and 1, as an entry may be, so a product with it has no finer unit.
template <typename Scalar>
struct DifferenceBits<PlacedTriangle<Scalar>> {
  static constexpr int entry = 128 + std::numeric_limits<Scalar>::digits;
  static constexpr int value = entry + AnySize<Scalar>::coordinate + 1 + 1;
};

/// Lets a unit include a shape's way and a triangle.
template <typename Shape, typename Scalar>
void include(BinaryUnit& unit, const Shape& shape, const Triangle<Scalar>& triangle) {
  unit.include(shape.start);
  unit.include(shape.end);
  unit.include(triangle);
}
template <typename Shape, typename Scalar>
void include(BinaryUnit& unit, const Shape& shape, const PlacedTriangle<Scalar>& triangle) {
  const PlacedUnits<Scalar> units(triangle);
  unit.include(shape.start);
  unit.include(shape.end);
  unit.include(triangle.placement.pose.translation);
  unit.include_products(units.motion, units.share, 1);
  unit.include_products(units.linear, units.corners, 3);
}

/// Sets the differences of a shape's terms.
template <typename Terms, typename Shape, typename Scalar>
SUREHIT_NOINLINE void set_differences(Terms& terms, const Shape& shape, const Triangle<Scalar>& triangle,
                                      const BinaryUnit& unit) {
  const std::array<const Vector3<Scalar>*, 3> corners = {&triangle.a, &triangle.b, &triangle.c};
  for (std::size_t k = 0; k < 3; ++k) {
    set_difference(terms.from_corner[k], shape.start, *corners[k], unit);
    if constexpr (requires { terms.to_end; }) set_difference(terms.to_end[k], shape.end, *corners[k], unit);
    set_difference(terms.edge[k], *corners[k == 2 ? 0 : k + 1], *corners[k], unit);
  }
  set_difference(terms.step, shape.end, shape.start, unit);
}

/// Subtracts the share of the motion.
template <typename Int, typename Scalar>
SUREHIT_NOINLINE void subtract_motion(IntVector<Int>& out, const PlacedTriangle<Scalar>& triangle,
                                      const PlacedUnits<Scalar>& units, const BinaryUnit& unit) {
  using Factor = PlacedFactor<Int, Scalar>;
  const int exponent = units.motion.exponent + units.share.exponent - unit.exponent;
  const auto share = Factor::entry(triangle.share, units.share);
  for (std::size_t i = 0; i < 3; ++i) {
    const Scalar motion = triangle.placement.motion[static_cast<Eigen::Index>(i)];
    if (motion != 0) add_product(out[i], share, Factor::coordinate(motion, 0, units.motion), exponent, true);
  }
}

template <typename Terms, typename Shape, typename Scalar>
SUREHIT_NOINLINE void set_differences(Terms& terms, const Shape& shape, const PlacedTriangle<Scalar>& triangle,
                                      const BinaryUnit& unit) {
  const PlacedUnits<Scalar> units(triangle);
  const auto& [pose, motion, moves] = triangle.placement;
  const std::array<const Vector3<Scalar>*, 3> corners = {&triangle.local.a, &triangle.local.b, &triangle.local.c};
  const Vector3<Scalar> zero = Vector3<Scalar>::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    set_difference(terms.from_corner[k], shape.start, pose.translation, unit);
    add_image(terms.from_corner[k], triangle, units, *corners[k], zero, unit, true);
    if constexpr (requires { terms.to_end; }) {
      set_difference(terms.to_end[k], shape.end, pose.translation, unit);
      add_image(terms.to_end[k], triangle, units, *corners[k], zero, unit, true);
      if (moves) subtract_motion(terms.to_end[k], triangle, units, unit);
    }
    for (auto& x : terms.edge[k]) x = {};
    add_image(terms.edge[k], triangle, units, *corners[k == 2 ? 0 : k + 1], *corners[k], unit, false);
  }
  set_difference(terms.step, shape.end, shape.start, unit);
  if (moves) subtract_motion(terms.step, triangle, units, unit);
}

}  // namespace surehit::detail
