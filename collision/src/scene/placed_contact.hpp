#pragma once

#include "filter/bounded_contact.hpp"
#include "scene/placed_path.hpp"

namespace surehit::detail {

/// The second stage for an instance: Möller-Trumbore in double, in the frame of the mesh. The errors of the path are
/// part of the bounds (I8). The side is that of the placed triangle.
template <typename Scalar>
[[nodiscard]] BoundedContact placed_contact(const PlacedPath<Scalar>& path, bool is_mirrored,
                                            const Triangle<Scalar>& local);

}  // namespace surehit::detail
