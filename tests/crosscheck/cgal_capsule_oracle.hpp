#pragma once

#include <optional>
#include <string>

#include "surehit/shape_hit.hpp"
#include "surehit/swept_capsule.hpp"
#include "surehit/triangle.hpp"

namespace surehit::test {

/// Says what is wrong with an answer about a moving capsule and a triangle, or returns nothing if it is right in every
/// field. All numbers must be finite, and the radius must not be negative.
///
/// The core sweeps over two triangles. Their distance to the triangle is composed: it is zero where `do_intersect` says
/// so, and else the lowest `squared_distance` of corners to triangles and of edges to edges. The time and the weights
/// are numbers of `Sqrt_extension`: those of the answered part and of an end, the centre or the line of the core.
template <typename Scalar>
[[nodiscard]] std::optional<std::string> cgal_error(const SweptCapsule<Scalar>& capsule,
                                                    const Triangle<Scalar>& triangle,
                                                    const std::optional<ShapeHit<Scalar>>& answer);

}  // namespace surehit::test
