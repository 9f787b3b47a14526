#pragma once

#include "shape/shape_contact.hpp"
#include "surehit/path.hpp"

namespace surehit::detail {

/// Returns the unit normal of the contact of a moving shape with a triangle, see `surehit::contact_normal`. It is zero
/// for a shape that is not valid. `AnyTriangle` is `Triangle`, whose corners must be finite, or `PlacedTriangle`. A
/// placed triangle has the normal of its exact image, and sees the shape from its instance.
template <typename Shape, typename AnyTriangle>
[[nodiscard]] Vector3<ScalarOf<Shape>> normal_of_contact(const Shape& shape, const AnyTriangle& triangle);

}  // namespace surehit::detail
