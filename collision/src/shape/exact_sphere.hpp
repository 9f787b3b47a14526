#pragma once

#include <optional>

#include "shape/exact_direction.hpp"
#include "shape/sphere_contact.hpp"
#include "surehit/swept_sphere.hpp"
#include "surehit/triangle.hpp"

namespace surehit::detail {

// Decides moving balls and triangles with integers. The input must be finite, and radii must not be negative. Any such
// input is allowed: triangles without area, balls that rest, radius 0, and numbers of all sizes. `AnyTriangle` is
// `Triangle` or `PlacedTriangle`. The ball is then seen from the instance, which may move.

/// Returns the contact of a ball with a triangle, or nothing if they do not touch. Asks nothing again that `findings`
/// knows.
template <typename Scalar, typename AnyTriangle>
[[nodiscard]] std::optional<SphereContact> exact_contact(const SweptSphere<Scalar>& sphere, const AnyTriangle& triangle,
                                                         SphereFindings findings = {});

/// Returns the sign of t of x less t of y.
template <typename Scalar, typename AnyTriangle>
[[nodiscard]] int compare_times(const SweptSphere<Scalar>& sphere, const AnyTriangle& x_triangle,
                                const SphereContact& x, const AnyTriangle& y_triangle, const SphereContact& y);

/// Returns the sign of t less a Scalar in [0, 1].
template <typename Scalar, typename AnyTriangle>
[[nodiscard]] int compare_time(const SweptSphere<Scalar>& sphere, const AnyTriangle& triangle,
                               const SphereContact& contact, Scalar limit);

/// Returns the sign of the step times the triangle's normal. It is 0 for a triangle without area.
template <typename Scalar, typename AnyTriangle>
[[nodiscard]] int sign_along(const SweptSphere<Scalar>& sphere, const AnyTriangle& triangle);

/// Sets t, u and v of a hit to those of a contact, each rounded once.
template <typename Scalar, typename AnyTriangle>
void round_exactly(const SweptSphere<Scalar>& sphere, const AnyTriangle& triangle, const SphereContact& contact,
                   ShapeHit<Scalar>& hit);

/// Returns the direction of a contact's normal, from the triangle toward the centre. It has no length if the centre
/// meets the triangle.
template <typename Scalar, typename AnyTriangle>
[[nodiscard]] Direction exact_direction(const SweptSphere<Scalar>& sphere, const AnyTriangle& triangle,
                                        const SphereContact& contact);

}  // namespace surehit::detail
