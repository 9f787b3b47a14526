#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace surehit {

/// How finely a grid divides the mesh's box. No setting changes an answer. Settings change time and memory only.
struct GridOptions {
  /// The number of top cells along x, y and z. Crowded cells are divided further.
  ///
  /// 0 leaves an axis to the grid. The grid then aims at `cells_per_triangle` top cells a triangle. It takes fewer if
  /// the triangles are large for such cells. Cells are cubes, unless the triangles' mean box is far from a cube. Then
  /// they follow the shape of that box.
  ///
  /// The grid is coarser than asked if it would break its budget of memory or its bound on rounding.
  std::array<std::uint32_t, 3> resolution = {0, 0, 0};
  /// The number of top cells a triangle, for the axes whose resolution is 0.
  double cells_per_triangle = 1;
  /// A cell that lists more triangles than this is divided into 4 × 4 × 4 cells, on at most two levels. It stays whole
  /// if the division would not separate the triangles. A cell that is still crowded gets a grid of its own for its
  /// small triangles. 0 means that no cell is divided.
  std::uint32_t crowded = 128;
};

/// The size of a grid. All numbers are 0 if the mesh has no triangles.
struct GridSummary {
  std::array<std::uint32_t, 3> resolution = {0, 0, 0};  ///< The number of top cells along x, y and z.
  std::uint32_t levels = 0;                             ///< The number of levels of divided cells below the top cells.
  std::size_t cells = 0;    ///< The number of top cells of all grids, and of the cells into which cells are divided.
  std::size_t entries = 0;  ///< The number of entries in all lists. A triangle has one in each cell that lists it.
  std::size_t memory_bytes = 0;  ///< The memory that is allocated for cells and lists, in bytes.
};

}  // namespace surehit
