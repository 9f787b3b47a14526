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
/// t is the minimum of a linear program in the two weights and t, by the elimination of Fourier and Motzkin. The
/// weights come from the triangle's part in the box at this t, which is cut out face by face. All numbers are
/// rationals. It shares nothing with the library, and asks no separating axis but those of the coordinates. Call it in
/// the default floating-point environment.
template <typename Scalar>
[[nodiscard]] std::optional<std::string> find_error(const SweptBox<Scalar>& box, const Triangle<Scalar>& triangle,
                                                    const std::optional<ShapeHit<Scalar>>& answer);

/// Whether the box comes to x at a lower t than to y. It must touch both.
template <typename Scalar>
[[nodiscard]] bool comes_before(const SweptBox<Scalar>& box, const Triangle<Scalar>& x, const Triangle<Scalar>& y);

}  // namespace surehit::test
