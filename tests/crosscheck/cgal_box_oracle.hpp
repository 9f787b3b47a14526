#pragma once

#include <optional>
#include <string>

#include "surehit/shape_hit.hpp"
#include "surehit/swept_box.hpp"
#include "surehit/triangle.hpp"

namespace surehit::test {

/// Says what is wrong with an answer about a moving box and a triangle, or returns nothing if it is right in every
/// field. All numbers must be finite, and no half extent may be negative.
///
/// CGAL's solver of linear and quadratic programs finds both answers, exactly. t is the lowest one at which a point of
/// the triangle is in the box. The touched point is the nearest one to the centre of all that are in the box at this t.
template <typename Scalar>
[[nodiscard]] std::optional<std::string> cgal_error(const SweptBox<Scalar>& box, const Triangle<Scalar>& triangle,
                                                    const std::optional<ShapeHit<Scalar>>& answer);

}  // namespace surehit::test
