#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "surehit/grid.hpp"

namespace surehit::detail {

using FramePoint = std::array<double, 3>;

/// A part of a triangle between parallel planes. Four cuts of a convex polygon leave 7 corners; rounding may dent it,
/// and then each cut leaves at most half as many again: 3, 4, 6, 9, 13.
struct ClippedTriangle {
  std::array<FramePoint, 13> corners;
  int count = 0;
};

/// Keeps what lies in low <= x[axis] <= high.
[[nodiscard]] ClippedTriangle clip(const ClippedTriangle& polygon, std::size_t axis, double low, double high);

/// Calls `list(x, y, z)` once for each cell whose padded box the triangle, given in the frame, meets: it is cut into
/// slabs along x, these into bars along y, and each bar spans its cells along z. Cost in proportion to the cells listed
/// and the bars.
template <typename List>
void list_cells(const GridFrame& frame, const std::array<FramePoint, 3>& triangle, List&& list) {
  // First and last cell that [low, high] meets, each cell being wider by the padding.
  const auto cells = [&](const ClippedTriangle& polygon, std::size_t axis) {
    double low = polygon.corners[0][axis];
    double high = low;
    for (int i = 1; i < polygon.count; ++i) {
      low = std::min(low, polygon.corners[static_cast<std::size_t>(i)][axis]);
      high = std::max(high, polygon.corners[static_cast<std::size_t>(i)][axis]);
    }
    // What lies within the padding of a plane belongs to the cells on both sides of it.
    return std::array<std::uint32_t, 2>{frame.cell_at(axis, low - frame.padding),
                                        frame.cell_at(axis, high + frame.padding)};
  };
  const auto slab = [&](const ClippedTriangle& polygon, std::size_t axis, std::uint32_t cell) {
    return clip(polygon, axis, frame.plane(axis, cell) - frame.padding, frame.plane(axis, cell + 1) + frame.padding);
  };

  ClippedTriangle whole = {};
  whole.count = 3;
  std::copy(triangle.begin(), triangle.end(), whole.corners.begin());
  const auto [first_x, last_x] = cells(whole, 0);
  for (std::uint32_t x = first_x; x <= last_x; ++x) {
    const ClippedTriangle slab_x = first_x == last_x ? whole : slab(whole, 0, x);
    if (slab_x.count == 0) continue;
    const auto [first_y, last_y] = cells(slab_x, 1);
    for (std::uint32_t y = first_y; y <= last_y; ++y) {
      const ClippedTriangle bar = first_y == last_y ? slab_x : slab(slab_x, 1, y);
      if (bar.count == 0) continue;
      const auto [first_z, last_z] = cells(bar, 2);
      for (std::uint32_t z = first_z; z <= last_z; ++z) list(x, y, z);
    }
  }
}

}  // namespace surehit::detail
