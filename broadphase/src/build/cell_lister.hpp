#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>

#include "build/overlap_lanes.hpp"
#include "build/triangle_overlap.hpp"
#include "grid/grid.hpp"

namespace surehit::detail {

/// Finds which cells of a box triangles meet, which come one by one. Their boxes are cut into blocks of cells, many of
/// which are asked at once whether they meet their triangle, where that is not known beforehand.
class CellLister {
 public:
  using Corners = std::array<PaddedPoint, 3>;

  /// Of `cells` that are `size` finest cells long. The entries, which outlive this, are complete once it is finished;
  /// if they may not grow, they are too many as soon as there is no room.
  CellLister(CellEntries& entries, bool may_grow, const CellRange& cells, std::uint32_t size, const CellPoint& padding);

  /// A triangle whose box, once it is padded, overlaps some of the cells. Entries keep the order in which triangles are
  /// added.
  void add(std::uint32_t triangle, const Corners& corners, const PaddedBox& box) {
    const Cell low = cell_of(box.low - padding_);
    const Cell high = cell_of(box.high + padding_);
    const Cell first = max(low, first_);
    const Cell last = min(high, last_);
    const Cell more = last - first;
    assert(!any_lane(more < all_lanes(0.0F)));
    if (sum_of(high - low) <= 1) {
      // Within one cell, or across one plane between cells: some corner is in each that the box overlaps, but for the
      // padding and its rounding. All of the box counts: what is beyond a brick may cross other planes.
      list(triangle, first, 1 + sum_of(more * Cell{2, 4, 16, 0}));
    } else if (any_lane(more > all_lanes(1.0F))) {
      add_range(triangle, corners, first, last);
    } else {
      add_block(triangle, corners, first, more);
    }
  }

  void finish() { ask(); }

 private:
  /// Whole numbers.
  using Cell = PaddedPoint;

  /// Rounded towards 0, where it is not floor that counts: no cell lies below.
  [[nodiscard]] Cell cell_of(const PaddedPoint& point) const { return to_float(to_int(point * per_size_)); }

  /// Of one more cell on some axes, or none.
  void add_block(std::uint32_t triangle, const Corners& corners, const Cell& first, const Cell& more) {
    const std::size_t lane = filled_++;
    for (std::size_t i = 0; i < 3; ++i) lanes_.corners[i][lane] = corners[i];
    lanes_.low[lane] = first;
    lanes_.more[lane] = more;
    block_of_lane_[lane] = block_count_;
    list(triangle, first, 0);
    if (filled_ == OverlapLanes::count) ask();
  }

  /// A block and the bits of its overlaps, or 0 for what the lanes are yet to tell. Numbers are whole, and exact: cells
  /// are no more than floats can count.
  void list(std::uint32_t triangle, const Cell& first, float overlaps) {
    const std::size_t block = block_count_++;
    blocks_.triangles[block] = triangle;
    blocks_.first[block] = static_cast<std::uint32_t>(static_cast<std::int32_t>(sum_of((first - first_) * pitch_)));
    blocks_.overlaps[block] = static_cast<std::int32_t>(overlaps);
    if (block + 1 == ListedBlocks::max_count) ask();
  }

  void add_range(std::uint32_t triangle, const Corners& corners, const Cell& first, const Cell& last);
  void add_parts(std::uint32_t triangle, const Corners& corners, const Cell& first, const Cell& last,
                 const TriangleOverlap& overlap);
  void add_blocks(std::uint32_t triangle, const Corners& corners, const Cell& first, const Cell& last);
  /// Asks what is in the lanes, and makes entries of all blocks.
  void ask();

  OverlapLanes lanes_;
  std::array<std::size_t, OverlapLanes::count> block_of_lane_;
  std::size_t filled_ = 0;  ///< lanes
  ListedBlocks blocks_;
  std::size_t block_count_ = 0;
  CellEntries& entries_;
  bool may_grow_;
  float size_;
  float per_size_;
  CellPoint cell_padding_;
  PaddedPoint padding_;
  Cell first_;
  Cell last_;
  CellOrder order_;
  Cell pitch_;  ///< from one cell to the next on each axis, in that order
};

/// Sorts the entries of so many cells into lists, by counting.
void sort_entries(std::span<const CellEntries> parts, std::size_t cell_count, CellLists& lists);

}  // namespace surehit::detail
