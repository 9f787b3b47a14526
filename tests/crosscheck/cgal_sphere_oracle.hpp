#pragma once

#include <optional>
#include <string>

#include "surehit/shape_hit.hpp"
#include "surehit/swept_sphere.hpp"
#include "surehit/triangle.hpp"

namespace surehit::test {

/// Says what is wrong with an answer about a moving ball and a triangle, or returns nothing if it is right in every
/// field. All numbers must be finite, and the radius must not be negative.
///
/// CGAL has no distance between a segment and a triangle. That of the way to the triangle is composed: it is zero where
/// `do_intersect` says so, and else the lowest `squared_distance` of the ends to the triangle and of the way to the
/// edges. The time and the weights at the answered part are numbers of `Sqrt_extension`.
template <typename Scalar>
[[nodiscard]] std::optional<std::string> cgal_error(const SweptSphere<Scalar>& sphere, const Triangle<Scalar>& triangle,
                                                    const std::optional<ShapeHit<Scalar>>& answer);

}  // namespace surehit::test
