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

/// Finds the cells that triangles meet, in a range of cells. Triangles are added one by one. The box of each is cut
/// into blocks of cells. Many blocks are tested at once, unless the answer is known before.
class CellLister {
 public:
  using Corners = std::array<PaddedPoint, 3>;

  /// Lists triangles in `cells`, which are `size` finest cells long. The entries must outlive the lister. They are
  /// complete after `finish`. If they may not grow and there is no room, their count becomes `too_many`.
  CellLister(CellEntries& entries, bool may_grow, const CellRange& cells, std::uint32_t size, const CellPoint& padding);

  /// Adds a triangle. Its padded box must overlap some of the cells. Entries keep the order in which triangles are
  /// added.
  void add(std::uint32_t triangle, const Corners& corners, const PaddedBox& box) {
    const Cell low = cell_of(box.low - padding_);
    const Cell high = cell_of(box.high + padding_);
    const Cell first = max(low, first_);
    const Cell last = min(high, last_);
    const Cell more = last - first;
    assert(!any_lane(more < all_lanes(0.0F)));
    if (sum_of(high - low) <= 1) {
      // The box lies within one cell, or across one plane between cells. So each cell that it overlaps holds a corner
      // of the triangle, but for the padding. The whole box counts, because outside a brick it may cross other planes.
      list(triangle, first, 1 + sum_of(more * Cell{2, 4, 16, 0}));
    } else if (any_lane(more > all_lanes(1.0F))) {
      add_range(triangle, corners, first, last);
    } else {
      add_block(triangle, corners, first, more);
    }
  }

  /// Completes the entries.
  void finish() { flush(); }

 private:
  /// The index of a cell on each axis, as whole numbers.
  using Cell = PaddedPoint;

  /// Returns the cell of a point. It rounds towards 0 instead of down, which is enough, because no cell is below 0.
  [[nodiscard]] Cell cell_of(const PaddedPoint& point) const { return to_float(to_int(point * per_size_)); }

  /// Adds a block. It has one cell more on the axes where `more` is 1.
  void add_block(std::uint32_t triangle, const Corners& corners, const Cell& first, const Cell& more) {
    const std::size_t lane = filled_++;
    for (std::size_t i = 0; i < 3; ++i) lanes_.corners[i][lane] = corners[i];
    lanes_.low[lane] = first;
    lanes_.more[lane] = more;
    block_of_lane_[lane] = block_count_;
    list(triangle, first, 0);
    if (filled_ == OverlapLanes::count) flush();
  }

  /// Adds a block with the bits of its overlaps. They are 0 if the lanes are not tested yet. All numbers are whole, and
  /// exact, because floats can count all cells.
  void list(std::uint32_t triangle, const Cell& first, float overlaps) {
    const std::size_t block = block_count_++;
    blocks_.triangles[block] = triangle;
    blocks_.first[block] = static_cast<std::uint32_t>(static_cast<std::int32_t>(sum_of((first - first_) * pitch_)));
    blocks_.overlaps[block] = static_cast<std::int32_t>(overlaps);
    if (block + 1 == ListedBlocks::max_count) flush();
  }

  /// Adds a triangle with any number of cells, from `first` to `last`.
  void add_range(std::uint32_t triangle, const Corners& corners, const Cell& first, const Cell& last);
  /// The same, but without the parts that the triangle misses.
  void add_parts(std::uint32_t triangle, const Corners& corners, const Cell& first, const Cell& last,
                 const TriangleOverlap& overlap);
  /// Adds all blocks of the cells from `first` to `last`.
  void add_blocks(std::uint32_t triangle, const Corners& corners, const Cell& first, const Cell& last);
  /// Tests what is in the lanes, and makes entries from all blocks.
  void flush();

  OverlapLanes lanes_;                                          ///< The blocks that are still to be tested.
  std::array<std::size_t, OverlapLanes::count> block_of_lane_;  ///< The index in `blocks_` of each lane's block.
  std::size_t filled_ = 0;                                      ///< The number of lanes in use.
  ListedBlocks blocks_;                                         ///< The blocks whose entries are still to be written.
  std::size_t block_count_ = 0;                                 ///< The number of blocks in `blocks_`.
  CellEntries& entries_;
  bool may_grow_;
  float size_;      ///< The edge of a cell, in finest cells.
  float per_size_;  ///< 1 / size_.
  CellPoint cell_padding_;
  PaddedPoint padding_;  ///< The same as `cell_padding_`, with a fourth lane.
  Cell first_;           ///< The first cell of the range.
  Cell last_;            ///< The last cell of the range.
  CellOrder order_;
  Cell pitch_;  ///< The index in `order_` grows by this to the next cell on each axis.
};

/// Sorts the entries of `cell_count` cells into lists. It counts the entries of each cell first.
void sort_entries(std::span<const CellEntries> parts, std::size_t cell_count, CellLists& lists);

}  // namespace surehit::detail
