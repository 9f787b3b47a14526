#pragma once

#include <optional>

#include "shape/capsule_contact.hpp"
#include "shape/capsule_terms.hpp"
#include "shape/exact_direction.hpp"
#include "surehit/swept_capsule.hpp"
#include "surehit/triangle.hpp"

namespace surehit::detail {

// Decides moving capsules and triangles with integers. The input must be finite, and radii must not be negative. Any
// such input is allowed: triangles without area, capsules that rest or have no length, radius 0, and numbers of all
// sizes.

/// Returns the contact of a capsule with a triangle, or nothing if they do not touch. Does not ask again about what is
/// in `findings`.
template <typename Scalar, typename AnyTriangle>
[[nodiscard]] std::optional<CapsuleContact> exact_contact(const SweptCapsule<Scalar>& capsule,
                                                          const AnyTriangle& triangle, CapsuleFindings findings = {});

/// Returns how the core lies to the parts of a triangle.
template <typename Scalar, typename AnyTriangle>
[[nodiscard]] CoreTilt exact_tilt(const SweptCapsule<Scalar>& capsule, const AnyTriangle& triangle);

/// Returns the sign of t of x less t of y.
template <typename Scalar, typename AnyTriangle>
[[nodiscard]] int compare_times(const SweptCapsule<Scalar>& capsule, const AnyTriangle& x_triangle,
                                const CapsuleContact& x, const AnyTriangle& y_triangle, const CapsuleContact& y);

/// Returns the sign of t less a Scalar in [0, 1].
template <typename Scalar, typename AnyTriangle>
[[nodiscard]] int compare_time(const SweptCapsule<Scalar>& capsule, const AnyTriangle& triangle,
                               const CapsuleContact& contact, Scalar limit);

/// Returns the sign of the step times the triangle's normal. It is 0 for a triangle without area.
template <typename Scalar, typename AnyTriangle>
[[nodiscard]] int sign_along(const SweptCapsule<Scalar>& capsule, const AnyTriangle& triangle);

/// Sets t, u and v of a hit to those of a contact, each rounded once.
template <typename Scalar, typename AnyTriangle>
void round_exactly(const SweptCapsule<Scalar>& capsule, const AnyTriangle& triangle, const CapsuleContact& contact,
                   ShapeHit<Scalar>& hit);

/// Returns the direction of a contact's normal, from the triangle toward the core. It has no length if the core
/// meets the triangle.
template <typename Scalar, typename AnyTriangle>
[[nodiscard]] Direction exact_direction(const SweptCapsule<Scalar>& capsule, const AnyTriangle& triangle,
                                        const CapsuleContact& contact);

}  // namespace surehit::detail
