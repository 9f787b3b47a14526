#pragma once

#include <optional>

#include "shape/box_contact.hpp"
#include "shape/exact_direction.hpp"
#include "surehit/shape_hit.hpp"
#include "surehit/swept_box.hpp"
#include "surehit/triangle.hpp"

namespace surehit::detail {

// Decides moving boxes and triangles with integers. The input must be finite, and half extents must not be negative.
// Any such input is allowed: triangles without area, boxes that rest, half extents of 0, and numbers of all sizes.
// `AnyTriangle` is `Triangle` or `PlacedTriangle`, which the shape then sees from its instance.

/// Returns the contact of a box with a triangle, or nothing if they do not touch.
template <typename Scalar, typename AnyTriangle>
[[nodiscard]] std::optional<BoxContact> exact_contact(const SweptBox<Scalar>& box, const AnyTriangle& triangle,
                                                      NoFindings = {});

/// Returns the sign of t of x less t of y.
template <typename Scalar, typename AnyTriangle>
[[nodiscard]] int compare_times(const SweptBox<Scalar>& box, const AnyTriangle& x_triangle, const BoxContact& x,
                                const AnyTriangle& y_triangle, const BoxContact& y);

/// Returns the sign of t less a Scalar in [0, 1].
template <typename Scalar, typename AnyTriangle>
[[nodiscard]] int compare_time(const SweptBox<Scalar>& box, const AnyTriangle& triangle, const BoxContact& contact,
                               Scalar limit);

/// Returns the sign of the step times the triangle's normal. It is 0 for a triangle without area.
template <typename Scalar, typename AnyTriangle>
[[nodiscard]] int sign_along(const SweptBox<Scalar>& box, const AnyTriangle& triangle);

/// Sets t, u, v and the feature of a hit to those of a contact. The numbers are rounded once.
template <typename Scalar, typename AnyTriangle>
void round_exactly(const SweptBox<Scalar>& box, const AnyTriangle& triangle, const BoxContact& contact,
                   ShapeHit<Scalar>& hit);

/// Returns the direction of a contact's normal, from the triangle toward the box. It is that of the side of K that the
/// centre passes at t (B1), and of several, that of the first axis. `contact` must be an exact one. If they touch at
/// the start, it is the direction in which the shortest way leads out of K.
template <typename Scalar, typename AnyTriangle>
[[nodiscard]] Direction exact_direction(const SweptBox<Scalar>& box, const AnyTriangle& triangle,
                                        const BoxContact& contact);

}  // namespace surehit::detail
