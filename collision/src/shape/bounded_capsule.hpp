#pragma once

#include "shape/capsule_contact.hpp"
#include "surehit/swept_capsule.hpp"
#include "surehit/triangle.hpp"
#include "verdict.hpp"

namespace surehit::detail {

/// Decides a moving capsule and a triangle in double, first with the sizes of all numbers, then with running error
/// bounds. If it is a hit, sets `found`. If it is undecided, adds to `findings`. The input must be finite, and the
/// radius must not be negative. Triangles without a certain area are undecided.
template <typename Scalar, typename AnyTriangle>
[[nodiscard]] Verdict bounded_contact(const SweptCapsule<Scalar>& capsule, const AnyTriangle& triangle,
                                      CapsuleContact& found, CapsuleFindings& findings);

/// Rounds t, u and v of a contact. Returns false if its bounds do not decide all of them.
template <typename Scalar, typename AnyTriangle>
[[nodiscard]] bool try_round(const SweptCapsule<Scalar>& capsule, const AnyTriangle& triangle,
                             const CapsuleContact& contact, ShapeHit<Scalar>& hit);

}  // namespace surehit::detail
