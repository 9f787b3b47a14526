#pragma once

#include "build/grid_scratch.hpp"
#include "support/float4.hpp"
#include "support/rounding_flags.hpp"

namespace surehit::detail {

/// A triangle is small for a cell if its box is at most the cell's edge over this, on all axes.
inline constexpr float small_share = 4;

/// Returns whether a triangle is small for a cell of this size. If the cell has an inner grid, this lists its small
/// triangles, and the cell's own list has the others.
[[nodiscard]] inline bool is_small(const PaddedBox& box, std::uint32_t size) {
  return !any_lane(box.high - box.low > all_lanes(static_cast<float>(size) / small_share));
}

/// The triangles of all inner grids are at most this many times those of the mesh.
inline constexpr std::size_t max_inner_share = 4;

}  // namespace surehit::detail
