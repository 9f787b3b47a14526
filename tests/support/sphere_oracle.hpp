#pragma once

#include <gmpxx.h>

#include <array>
#include <optional>
#include <string>

#include "surehit/shape_hit.hpp"
#include "surehit/swept_sphere.hpp"
#include "surehit/triangle.hpp"

namespace surehit::test {

/// A moving ball and a triangle, in numbers of one kind.
template <typename Number>
struct PairOf {
  std::array<Number, 3> start, step, a, b, c;
  Number rr;  ///< The square of the radius.
};
/// In rationals, it may be a placed triangle, and a ball as an instance sees it that moves.
using RationalPair = PairOf<mpq_class>;

/// Says what is wrong with an answer about a moving ball and a triangle, or returns nothing if it is right in every
/// field. All numbers must be finite, and the radius must not be negative.
///
/// Yes or no, and the rounding of t, follow from distances between segments and triangles in rationals. They need no
/// root. The weights and the feature come from floats of many thousand bits. It shares nothing with the library. Call
/// it in the default floating-point environment.
template <typename Scalar>
[[nodiscard]] std::optional<std::string> find_error(const SweptSphere<Scalar>& sphere, const Triangle<Scalar>& triangle,
                                                    const std::optional<ShapeHit<Scalar>>& answer);

/// Says what is wrong with the normal of a contact, or returns nothing. A component may be off by `allowed`.
template <typename Scalar>
[[nodiscard]] std::optional<std::string> find_error_of_normal(const RationalPair& pair, const ShapeHit<Scalar>& hit,
                                                              const Vector3<Scalar>& normal, double allowed);
template <typename Scalar>
[[nodiscard]] std::optional<std::string> find_error_of_normal(const SweptSphere<Scalar>& sphere,
                                                              const Triangle<Scalar>& triangle,
                                                              const ShapeHit<Scalar>& hit,
                                                              const Vector3<Scalar>& normal, double allowed);

/// Whether the ball comes to x at a lower t than to y. It must touch both, and neither at its start.
template <typename Scalar>
[[nodiscard]] bool comes_before(const SweptSphere<Scalar>& sphere, const Triangle<Scalar>& x,
                                const Triangle<Scalar>& y);

}  // namespace surehit::test
