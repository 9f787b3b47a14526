#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "grid/grid.hpp"

namespace surehit::detail {

/// A cell that lists triangles.
struct ListCell {
  CellWord word;                     ///< The word of the cell.
  std::array<std::uint32_t, 3> low;  ///< The low corner, in finest cells.
  std::uint32_t size;                ///< The edge, in finest cells.
};

/// Calls `visit` with this cell if it lists triangles. If it is divided, calls `visit` with the cells of its bricks
/// that list triangles.
template <typename Visit>
void visit_list_cells(const Grid& grid, const ListCell& cell, const Visit& visit) {
  if (cell.word.is_empty()) return;
  if (!cell.word.is_divided()) {
    visit(cell);
    return;
  }
  const std::uint32_t size = cell.size / Grid::brick_edge;
  const std::size_t brick = std::size_t{cell.word.brick()} * Grid::brick_size;
  for (std::uint32_t i = 0; i < Grid::brick_size; ++i) {
    const std::array<std::uint32_t, 3> part = Grid::position_in_brick(i);
    visit_list_cells(grid,
                     {grid.bricks()[brick + i],
                      {cell.low[0] + part[0] * size, cell.low[1] + part[1] * size, cell.low[2] + part[2] * size},
                      size},
                     visit);
  }
}

/// Does the same for the top cells of a frame from `first` to `last` - 1. It visits the lists in the order of their
/// numbers.
template <typename Visit>
void visit_list_cells(const Grid& grid, const GridFrame& frame, std::size_t first, std::size_t last,
                      const Visit& visit) {
  const auto& [columns, rows, layers] = frame.cells;
  const std::uint32_t size = frame.division;
  const CellWord* const words = grid.all_top().data() + frame.first_top;
  for (std::size_t top = first; top < last; ++top) {
    const CellWord word = words[top];
    if (word.is_empty()) continue;
    const auto index = static_cast<std::uint32_t>(top);
    visit_list_cells(
        grid, {word, {index % columns * size, index / columns % rows * size, index / columns / rows * size}, size},
        visit);
  }
}

}  // namespace surehit::detail
