#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>

#include "shape/shape_contact.hpp"
#include "surehit/shape_hit.hpp"
#include "surehit/swept_sphere.hpp"
#include "surehit/triangle.hpp"
#include "walk/swept_walk.hpp"

namespace surehit::detail {

/// A contact of a moving ball with a triangle. It holds what decides which of two hits is first.
struct SphereContact {
  double t_lower = 0;               ///< The exact t is at least this.
  double t_upper = 0;               ///< The exact t is at most this.
  Feature feature = Feature::face;  ///< The part of the triangle that has the touched point.
  /// The part whose equation has t as a root. It differs from `feature` where the ball touches an edge or a corner in
  /// the moment when it also touches the plane.
  Feature timed_by = Feature::face;
  bool at_start = false;  ///< True if they touch at t = 0. Then the equation is not used.
};

/// What is certain about the parts of a triangle, if it does not decide whether a ball touches it. Each stage adds to
/// it, and asks only about what is left.
struct SphereFindings {
  using Parts = std::bitset<feature_count>;  ///< A bit for each `Feature`.

  Parts never_entered;          ///< The ball does not come to them later, or they are not the nearest part then.
  Parts never_nearest;          ///< They are not the nearest part at the start.
  bool begins_outside = false;  ///< True if the ball does not touch the triangle at the start.
};

template <typename AnyScalar>
struct ShapeTypes<SweptSphere<AnyScalar>> {
  using Scalar = AnyScalar;
  using Contact = SphereContact;
  using Findings = SphereFindings;
};

template <typename Scalar>
inline constexpr bool has_simple_contacts<SweptSphere<Scalar>> = true;

/// Returns true if a ball can touch something: all numbers are finite, and the radius is not negative.
template <typename Scalar>
[[nodiscard]] bool is_valid(const SweptSphere<Scalar>& sphere);
/// Returns the box around a ball, and its way.
template <typename Scalar>
[[nodiscard]] SweptExtents swept_extents(const SweptSphere<Scalar>& sphere);
/// Returns true if two triangles share the corner or the edge whose equation has t as a root. Neighbours often do. Then
/// the ball comes to both at the same time.
template <typename Scalar>
[[nodiscard]] bool are_timed_alike(const Triangle<Scalar>& x_triangle, const SphereContact& x,
                                   const Triangle<Scalar>& y_triangle, const SphereContact& y);

}  // namespace surehit::detail
