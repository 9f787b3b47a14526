#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "build/grid_scratch.hpp"
#include "grid/grid.hpp"
#include "grid/grid_frame.hpp"
#include "support/float4.hpp"
#include "support/rounding_flags.hpp"

namespace surehit::detail {

/// The main part of a mesh is at most one in so many of the box's width on each axis.
inline constexpr float max_part_share = 7;
/// The maximum number of entries that are beside the main part on one side of an axis.
inline constexpr std::size_t max_left_out = Grid::max_unwalked / 2;

/// Returns true if most triangles of a sample take up more than half of the width on some axis.
inline bool are_spread(const GridFrame& frame, std::span<const PaddedBox> boxes) {
  constexpr std::size_t samples = 64;
  constexpr std::size_t left_out = 6;  // On either side.
  std::array<float, samples> places;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t k = 0; k < samples; ++k) places[k] = boxes[k * boxes.size() / samples].low[axis];
    std::sort(places.begin(), places.end());
    if (2 * (places[samples - 1 - left_out] - places[left_out]) > frame.float_stop[axis]) return true;
  }
  return false;
}

/// If all triangles but a few lie in a small part of the box, returns two or three cells for each axis, so that one
/// cell holds this part. Its triangles get an inner grid then. Otherwise several cells would share them, and a path
/// would enter an inner grid in each of them. The lists are those of the frame's top cells. `counts` is memory.
inline std::optional<std::array<double, 3>> resolution_around_main_part(const GridFrame& frame, const CellLists& lists,
                                                                        std::span<const PaddedBox> boxes,
                                                                        ScratchVector<std::uint32_t>& counts) {
  const auto& cells = frame.cells;
  if (std::min({cells[0], cells[1], cells[2]}) < 2 || are_spread(frame, boxes)) return std::nullopt;
  const std::array<std::size_t, 3> first = {0, cells[0], std::size_t{cells[0]} + cells[1]};
  counts.assign(first[2] + cells[2], 0);
  std::size_t cell = 0;
  for (std::uint32_t z = 0; z < cells[2]; ++z) {
    for (std::uint32_t y = 0; y < cells[1]; ++y) {
      for (std::uint32_t x = 0; x < cells[0]; ++x, ++cell) {
        const std::uint32_t count = lists.offsets[cell + 1] - lists.offsets[cell];
        counts[first[0] + x] += count;
        counts[first[1] + y] += count;
        counts[first[2] + z] += count;
      }
    }
  }
  // The cells that have nearly all entries, and then the box of the triangles in them, both in finest cells.
  PaddedBox part = {all_lanes(0.0F), all_lanes(0.0F)};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::uint32_t* const on_axis = counts.data() + first[axis];
    std::size_t low = 0;
    std::size_t high = cells[axis];
    for (std::size_t left_out = on_axis[low]; left_out <= max_left_out; left_out += on_axis[low]) ++low;
    for (std::size_t left_out = on_axis[high - 1]; left_out <= max_left_out; left_out += on_axis[high - 1]) --high;
    if (2 * (high - low) > cells[axis]) return std::nullopt;
    part.low[axis] = static_cast<float>(low * frame.division);
    part.high[axis] = static_cast<float>(high * frame.division);
  }
  PaddedBox main = {part.high, part.low};
  for (const PaddedBox& box : boxes) {
    if (any_lane((box.low < part.low) | (box.high > part.high))) continue;
    main = {min(main.low, box.low), max(main.high, box.high)};
  }
  std::array<double, 3> resolution;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float stop = frame.float_stop[axis];
    if ((main.high[axis] - main.low[axis]) * max_part_share > stop) return std::nullopt;
    // A part of this size lies across the middle or across a third, but not across both. A triangle that is nearer to
    // a plane than a padding, up to roundings, would be listed on both sides.
    const float room = 2 * frame.padding(axis);
    const bool is_across_middle = main.low[axis] - room <= stop / 2 && stop / 2 <= main.high[axis] + room;
    resolution[axis] = is_across_middle ? 3 : 2;
  }
  return resolution;
}

}  // namespace surehit::detail
