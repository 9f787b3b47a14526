#pragma once

#include "filter/bounded_contact.hpp"

namespace surehit::detail {

/// The second stage for a path in the plane of a triangle, if the plane is perpendicular to an axis. Walls and floors
/// have such planes. It works in double, with two coordinates. It is undecided about all other pairs, and about a
/// triangle that is a segment or a point.
template <typename Scalar>
[[nodiscard]] BoundedContact plane_contact(const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                                           const PathRange<Scalar>& range);

}  // namespace surehit::detail
