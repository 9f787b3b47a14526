#pragma once

#include <span>

#include "render/world.hpp"

namespace surehit::example {

/// Sets `points[i]` to where ray i has come, just before what it hits there: the start of its next rays. An exact query
/// says that the way from its origin to this point meets nothing. So no ray from there meets the surface by mistake,
/// and no light comes through it.
///
/// This is `Collider::last_free_point` for rays, in a batch. The candidates are the points at t - 2^k ulp(t), for k =
/// 0, 1, and so on, while that is above 0. If no candidate is free, the point is the origin. `hits[i]` is the first hit
/// of ray i.
void free_points(const World& world, std::span<const Rayf> rays, std::span<const Medium> media,
                 std::span<const Hitf> hits, std::span<Vector3f> points);

}  // namespace surehit::example
