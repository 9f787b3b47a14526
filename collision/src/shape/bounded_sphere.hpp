#pragma once

#include "shape/sphere_contact.hpp"
#include "surehit/swept_sphere.hpp"
#include "surehit/triangle.hpp"
#include "verdict.hpp"

namespace surehit::detail {

/// Decides a moving ball and a triangle in double, first with the sizes of all numbers, then with running error bounds.
/// If it is a hit, sets `found`. The input must be finite, and the radius must not be negative. Triangles without a
/// certain area are undecided. If it is undecided, adds to `findings`. `AnyTriangle` is `Triangle` or `PlacedTriangle`,
/// here and below.
template <typename Scalar, typename AnyTriangle>
[[nodiscard]] Verdict bounded_contact(const SweptSphere<Scalar>& sphere, const AnyTriangle& triangle,
                                      SphereContact& found, SphereFindings& findings);

/// Decides whether a moving ball touches the inside of a triangle or of an edge first, before `limit`, or nothing of
/// the triangle until then, if this is certain. If it is undecided, it sets `found.t_lower` to a lower bound of any
/// contact's t.
template <typename Scalar>
[[nodiscard]] Verdict simple_contact(const SweptSphere<Scalar>& sphere, const Triangle<Scalar>& triangle, double limit,
                                     SphereContact& found);

/// Rounds t, u and v of a contact. Returns false if its bounds do not decide all of them.
template <typename Scalar, typename AnyTriangle>
[[nodiscard]] bool try_round(const SweptSphere<Scalar>& sphere, const AnyTriangle& triangle,
                             const SphereContact& contact, ShapeHit<Scalar>& hit);

}  // namespace surehit::detail
