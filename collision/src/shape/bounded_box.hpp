#pragma once

#include "shape/box_contact.hpp"
#include "surehit/shape_hit.hpp"
#include "surehit/swept_box.hpp"
#include "surehit/triangle.hpp"
#include "verdict.hpp"

namespace surehit::detail {

/// Decides a moving box and a triangle in double, first with the sizes of all numbers, then with running error bounds.
/// If it is a hit, sets `found`. The input must be finite, and half extents must not be negative.
template <typename Scalar, typename AnyTriangle>
[[nodiscard]] Verdict bounded_contact(const SweptBox<Scalar>& box, const AnyTriangle& triangle, BoxContact& found,
                                      NoFindings = {});

/// Rounds t, u and v of a contact, and sets the feature. Returns false if its bounds do not decide all of them.
template <typename Scalar, typename AnyTriangle>
[[nodiscard]] bool try_round(const SweptBox<Scalar>& box, const AnyTriangle& triangle, const BoxContact& contact,
                             ShapeHit<Scalar>& hit);

}  // namespace surehit::detail
