#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "build/grid_scratch.hpp"
#include "build/triangle_overlap.hpp"
#include "grid/grid.hpp"

namespace surehit::detail {

/// Triangles that are tested at once, each with a block of up to 2 × 2 × 2 cells. Points are stored whole. To split
/// them into axes by vector loads costs less than to store each coordinate separately.
struct OverlapLanes {
  static constexpr std::size_t count = 16;  ///< The number of triangles that are tested at once.
  static constexpr std::uint32_t cells_of_a_block = 8;
  template <typename T>
  struct alignas(count * sizeof(T)) Row : std::array<T, count> {};
  using Points = std::array<PaddedPoint, count>;

  std::array<Points, 3> corners;  ///< The corners of the triangles.
  Points low;                     ///< The first cell of each block.
  Points more;                    ///< 1 if the block has another cell on the axis, else 0.

  OverlapLanes() {
    for (Points& corner : corners) corner.fill(PaddedPoint{});
    low.fill(PaddedPoint{});
    more.fill(PaddedPoint{});
  }
};

/// Tests the triangle of each lane against the cells of its block, as `TriangleOverlap` does. Bit x + 2 y + 4 z is set
/// if the triangle meets the cell that is (x, y, z) after the first one. Cells are `size` finest cells long, a power of
/// two. They must overlap the triangle's box. No bit is missing. A bit too many is set only because of rounding.
void find_overlaps(const OverlapLanes& lanes, const CellPoint& padding, float size,
                   OverlapLanes::Row<std::int32_t>& overlaps);

/// The order in which cells are numbered: x runs fastest.
struct CellOrder {
  std::uint32_t row;    ///< The number grows by this to the next cell on axis y.
  std::uint32_t layer;  ///< The number grows by this to the next cell on axis z.
};

/// Blocks of up to 2 × 2 × 2 cells. Each has a triangle, and tells which of its cells the triangle meets.
struct ListedBlocks {
  static constexpr std::size_t max_count = 64;

  std::array<std::uint32_t, max_count> triangles;  ///< The ids of the triangles.
  std::array<std::uint32_t, max_count> first;      ///< The number of the first cell of each block in the order.
  std::array<std::int32_t, max_count> overlaps;    ///< The bits that `find_overlaps` stores for each block.
};

/// Writes the cells that are met in the first `count` blocks, block by block, and the triangle of each. Cells are
/// written by their numbers in the order. Returns how many pairs it wrote. It may write anything behind them, up to 8
/// pairs a block in all.
std::size_t write_overlaps(const ListedBlocks& blocks, std::size_t count, const CellOrder& order, std::uint32_t* cells,
                           std::uint32_t* owners);

}  // namespace surehit::detail
