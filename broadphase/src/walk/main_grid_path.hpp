#pragma once

#include <limits>

#include "grid/main_grid.hpp"
#include "support/float4.hpp"
#include "support/inlining.hpp"
#include "surehit/path.hpp"
#include "walk/direction.hpp"

namespace surehit::detail {

/// Returns true if a path meets nothing that is not in the main grid, because it misses the boxes around the others.
/// The arithmetic is that of `BoxLanes`, with the axes side by side (L17, L18).
SUREHIT_ALWAYS_INLINE inline bool misses_others(const MainGrid& main, const Path<float>& path, float first_t,
                                                float last_t) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const Float4 start = {path.start[0], path.start[1], path.start[2], 0};
  const Float4 toward = {path.toward[0], path.toward[1], path.toward[2], 0};
  const Float4 way = direction_of(path.kind, start, toward);
  const Float4 size = absolute(way);
  const Int4 is_usual = (size >= all_lanes(0x1p-100F)) & (size <= all_lanes(0x1p100F));
  const Float4 inverse = 1 / way;
  bool misses_all = true;
  for (const MainGrid::OtherBox& box : main.boxes()) {
    const Float4 to_low = box.low - start;
    const Float4 to_high = box.high - start;
    const Int4 counts = is_usual & (max(absolute(to_low), absolute(to_high)) < all_lanes(infinity));
    const Float4 at_low = to_low * inverse;
    const Float4 at_high = to_high * inverse;
    Float4 entries = choose(counts, min(at_low, at_high), all_lanes(-infinity));
    Float4 exits = choose(counts, max(at_low, at_high), all_lanes(infinity));
    entries[3] = first_t;
    exits[3] = last_t;
    const float enters = max_lane(entries)[0];
    const float leaves = min_lane(exits)[0];
    const float first = enters * (enters > 0 ? 1 - 0x1p-20F : 1 + 0x1p-20F);
    const float last = leaves * (leaves > 0 ? 1 + 0x1p-20F : 1 - 0x1p-20F);
    const Int4 is_beside = (way == all_lanes(0.0F)) & ((box.low > start) | (box.high < start));
    misses_all &= first > last + std::numeric_limits<float>::min() || any_lane(is_beside);
  }
  return misses_all;
}

}  // namespace surehit::detail
