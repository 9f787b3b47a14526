#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "surehit/grid.hpp"
#include "triangle_overlap.hpp"

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
    for (Points& corner : corners) corner.fill(PaddedPoint::Zero());
    low.fill(PaddedPoint::Zero());
    more.fill(PaddedPoint::Zero());
  }
};

/// Asks for each lane what `TriangleOverlap` tells of one triangle: bit x + 2 y + 4 z is whether it meets the cell that
/// is so much farther than the block's first. Cells are `size` finest cells long, a power of two, and overlap the
/// triangle's box. Never a bit too few; one too many only by rounding.
void find_overlaps(const OverlapLanes& lanes, const CellPoint& padding, float size,
                   OverlapLanes::Row<std::int32_t>& overlaps);

/// Cells in the order in which they are listed, x first.
struct CellOrder {
  CellPoint first;      ///< whole numbers
  std::uint32_t row;    ///< cells from one to the next on axis y
  std::uint32_t layer;  ///< and on axis z
};

/// Writes the cells of which the first `count` lanes' overlaps tell, each lane's in turn, by their places in the order,
/// and for each of them the lane's triangle. Returns how many; of the rest up to 8 a lane, anything may be written.
std::size_t write_overlaps(const OverlapLanes& lanes, const OverlapLanes::Row<std::int32_t>& overlaps,
                           const OverlapLanes::Row<std::uint32_t>& triangles, std::size_t count, const CellOrder& order,
                           std::uint32_t* cells, std::uint32_t* owners);

}  // namespace surehit::detail
