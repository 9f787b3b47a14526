#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "build/triangle_overlap.hpp"
#include "grid/grid.hpp"

namespace surehit::detail {

/// Triangles, many of which are asked at once, each with a block of up to 2 × 2 × 2 cells. Points are stored whole:
/// vectors that part them into axes cost less than to store each coordinate in its place.
struct OverlapLanes {
  static constexpr std::size_t count = 16;
  static constexpr std::uint32_t cells_of_a_block = 8;
  template <typename T>
  struct alignas(count * sizeof(T)) Row : std::array<T, count> {};
  using Points = std::array<PaddedPoint, count>;

  std::array<Points, 3> corners;
  Points low;   ///< the block's first cell
  Points more;  ///< 1 if it has another on the axis, else 0

  OverlapLanes() {
    for (Points& corner : corners) corner.fill(PaddedPoint{});
    low.fill(PaddedPoint{});
    more.fill(PaddedPoint{});
  }
};

/// Asks for each lane what `TriangleOverlap` tells of one triangle: bit x + 2 y + 4 z is whether it meets the cell that
/// is so much farther than the block's first. Cells are `size` finest cells long, a power of two, and overlap the
/// triangle's box. Never a bit too few; one too many only by rounding.
void find_overlaps(const OverlapLanes& lanes, const CellPoint& padding, float size,
                   OverlapLanes::Row<std::int32_t>& overlaps);

/// Cells are listed in this order, x first.
struct CellOrder {
  std::uint32_t row;    ///< cells from one to the next on axis y
  std::uint32_t layer;  ///< and on axis z
};

/// Blocks of up to 2 × 2 × 2 cells, each with a triangle, and which of the cells this meets.
struct ListedBlocks {
  static constexpr std::size_t max_count = 64;

  std::array<std::uint32_t, max_count> triangles;
  std::array<std::uint32_t, max_count> first;    ///< the first cell's place in the order
  std::array<std::int32_t, max_count> overlaps;  ///< as `find_overlaps` tells them
};

/// Writes the cells that are met in the first `count` blocks, block by block, by their places in the order, and for
/// each of them the triangle. Returns how many; of the rest up to 8 a block, anything may be written.
std::size_t write_overlaps(const ListedBlocks& blocks, std::size_t count, const CellOrder& order, std::uint32_t* cells,
                           std::uint32_t* owners);

}  // namespace surehit::detail
