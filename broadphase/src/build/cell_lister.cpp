#include "build/cell_lister.hpp"

#include <cmath>
#include <numeric>
#include <utility>

#include "support/rounding_flags.hpp"

namespace surehit::detail {
namespace {

/// If a triangle's cells take more blocks than this, parts that the triangle misses are removed first.
constexpr float max_blocks = 16;

/// Returns the number of blocks that cover the cells from `first` to `last`.
float count_blocks(const PaddedPoint& first, const PaddedPoint& last) {
  const PaddedPoint blocks = to_float(to_int((last - first) * 0.5F)) + 1;
  return blocks[0] * blocks[1] * blocks[2];
}

}  // namespace

CellLister::CellLister(CellEntries& entries, bool may_grow, const CellRange& cells, std::uint32_t size,
                       const CellPoint& padding)
    : entries_(entries),
      may_grow_(may_grow),
      size_(static_cast<float>(size)),
      per_size_(1 / size_),  // A power of two.
      cell_padding_(padding),
      padding_{padding[0], padding[1], padding[2], 0},
      order_{cells.length(0), cells.length(0) * cells.length(1)},
      pitch_{1, static_cast<float>(order_.row), static_cast<float>(order_.layer), 0} {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    first_[axis] = static_cast<float>(cells.low[axis]);
    last_[axis] = static_cast<float>(cells.high[axis] - 1);
  }
  first_[3] = last_[3] = 0;
  entries_.count = 0;
}

void CellLister::add_range(std::uint32_t triangle, const Corners& corners, const Cell& first, const Cell& last) {
  if (count_blocks(first, last) <= max_blocks) {
    add_blocks(triangle, corners, first, last);
    return;
  }
  std::array<CellPoint, 3> points;
  for (std::size_t i = 0; i < 3; ++i) points[i] = {corners[i][0], corners[i][1], corners[i][2]};
  add_parts(triangle, corners, first, last, TriangleOverlap(points, cell_padding_));
}

/// Halves the cells until the triangle misses them, or until they are few enough. The caller knows that the triangle
/// meets them at first.
void CellLister::add_parts(std::uint32_t triangle, const Corners& corners, const Cell& first, const Cell& last,
                           const TriangleOverlap& overlap) {
  if (count_blocks(first, last) <= max_blocks) {
    add_blocks(triangle, corners, first, last);
    return;
  }
  const Cell more = last - first;
  std::size_t longest = 0;
  for (std::size_t axis = 1; axis < 3; ++axis) longest = more[axis] > more[longest] ? axis : longest;
  for (const bool upper : {false, true}) {
    Cell part_first = first;
    Cell part_last = last;
    const float middle = std::floor((first[longest] + last[longest]) / 2);
    if (upper) {
      part_first[longest] = middle + 1;
    } else {
      part_last[longest] = middle;
    }
    const PaddedPoint low = part_first * size_;
    const PaddedPoint high = (part_last + 1) * size_;
    if (!overlap.meets({low[0], low[1], low[2]}, {high[0], high[1], high[2]})) continue;
    add_parts(triangle, corners, part_first, part_last, overlap);
  }
}

void CellLister::add_blocks(std::uint32_t triangle, const Corners& corners, const Cell& first, const Cell& last) {
  Cell block = first;
  for (block[2] = first[2]; block[2] <= last[2]; block[2] += 2) {
    for (block[1] = first[1]; block[1] <= last[1]; block[1] += 2) {
      for (block[0] = first[0]; block[0] <= last[0]; block[0] += 2) {
        add_block(triangle, corners, block, min(last - block, all_lanes(1.0F)));
      }
    }
  }
}

void CellLister::flush() {
  const std::size_t filled = std::exchange(filled_, 0);
  const std::size_t blocks = std::exchange(block_count_, 0);
  if (blocks == 0 || entries_.count == CellEntries::too_many) return;
  const std::size_t max_count = entries_.count + blocks * OverlapLanes::cells_of_a_block;
  if (entries_.cells.size() < max_count) {
    if (!may_grow_) {
      entries_.count = CellEntries::too_many;
      return;
    }
    entries_.make_room(2 * max_count);
  }
  if (filled > 0) {
    OverlapLanes::Row<std::int32_t> overlaps;
    find_overlaps(lanes_, cell_padding_, size_, overlaps);
    for (std::size_t lane = 0; lane < filled; ++lane) blocks_.overlaps[block_of_lane_[lane]] = overlaps[lane];
  }
  entries_.count += write_overlaps(blocks_, blocks, order_, entries_.cells.data() + entries_.count,
                                   entries_.triangles.data() + entries_.count);
}

void sort_entries(std::span<const CellEntries> parts, std::size_t cell_count, CellLists& lists) {
  auto& offsets = lists.offsets;
  offsets.assign(cell_count + 1, 0);
  for (const CellEntries& part : parts) {
    for (std::size_t i = 0; i < part.count; ++i) ++offsets[part.cells[i]];
  }
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  lists.triangles.resize(offsets.back());
  for (std::size_t k = parts.size(); k-- > 0;) {
    const CellEntries& part = parts[k];
    for (std::size_t i = part.count; i-- > 0;) lists.triangles[--offsets[part.cells[i]]] = part.triangles[i];
  }
}

}  // namespace surehit::detail
