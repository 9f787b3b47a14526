#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace surehit {

/// How finely a grid divides the mesh's box. No setting changes an answer, only time and memory.
struct GridOptions {
  /// Cells along x, y and z, before crowded ones are divided again.
  ///
  /// 0 leaves that axis to the grid. It then aims at `cells_per_triangle` cells in all. They are cubes, or have the
  /// shape of the triangles' mean box where that is far from a cube. Whatever is asked for is made coarser where it
  /// would break the grid's budget of memory or its bound on rounding.
  std::array<std::uint32_t, 3> resolution = {0, 0, 0};
  /// Top cells for each triangle, where the resolution is left to the grid.
  double cells_per_triangle = 1;
  /// A cell that lists more triangles than this is divided into 4 × 4 × 4, if that parts the triangles. 0: never.
  std::uint32_t crowded = 192;
};

/// What a grid came to.
struct GridSummary {
  std::array<std::uint32_t, 3> resolution = {0, 0, 0};  ///< top cells along x, y and z
  std::uint32_t levels = 0;                             ///< levels of divided cells below the top cells
  std::size_t cells = 0;                                ///< top cells, and the cells of all that are divided
  std::size_t entries = 0;                              ///< entries of all cells' lists, repetitions included
  std::size_t memory_bytes = 0;                         ///< allocated for cells and lists
};

}  // namespace surehit
