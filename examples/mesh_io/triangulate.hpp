#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace surehit::example {

/// Cuts a polygon into triangles of its corners, two fewer than it has corners, and appends them.
///
/// The polygon is its outline as it is seen along an axis, so it may be in any plane, and somewhat bent. The outline
/// may touch itself, as that of a wall does which a bridge joins to its window. Together the triangles are what it
/// winds round once, and no two of them overlap. A triangle without area, of corners that are in one line or coincide,
/// lies on the outline or on edges of others. Every decision is exact.
///
/// The fan of the first corner with each following pair is preferred; it is right for every convex polygon. Otherwise
/// ears are cut off. Cost: some exact decisions a corner, more in a long concave outline.
///
/// Returns false, and appends nothing, where there is no such triangulation: the outline crosses itself. There are at
/// least 3 corners, their vertices exist and are finite.
///
/// Source: Meisters, "Polygons Have Ears" (1975).
template <typename Scalar>
[[nodiscard]] bool triangulate(const std::vector<std::array<Scalar, 3>>& vertices,
                               const std::vector<std::uint32_t>& corners,
                               std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace surehit::example
