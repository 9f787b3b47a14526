#pragma once

#include "placement.hpp"
#include "surehit/path.hpp"

namespace surehit::detail {

/// Returns the point of a placed triangle with the weights u and v, where its instance is at t: linear (a + u (b - a) +
/// v (c - a)) + translation + t motion. Each coordinate is rounded once to nearest. t, u and v must be in [0, 1].
template <typename Scalar>
[[nodiscard]] Vector3<Scalar> exact_placed_point(const PlacedTriangle<Scalar>& triangle, Scalar t, Scalar u, Scalar v);

}  // namespace surehit::detail
