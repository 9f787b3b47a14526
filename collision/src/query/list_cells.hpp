#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "grid/grid.hpp"

namespace surehit::detail {

/// A cell that lists triangles, in finest cells.
struct ListCell {
  CellWord word;
  std::array<std::uint32_t, 3> low;
  std::uint32_t size;
};

/// Calls `visit` with this cell, or with those of its bricks, and of theirs, that list triangles.
template <typename Visit>
void visit_list_cells(const Grid& grid, const ListCell& cell, const Visit& visit) {
  if (cell.word.is_empty()) return;
  if (!cell.word.is_divided()) {
    visit(cell);
    return;
  }
  constexpr std::uint32_t edge = Grid::brick_edge;
  const std::uint32_t size = cell.size / edge;
  const std::size_t brick = std::size_t{cell.word.number()} * Grid::brick_size;
  for (std::uint32_t i = 0; i < Grid::brick_size; ++i) {
    const std::array<std::uint32_t, 3> part = {i % edge, i / edge % edge, i / (edge * edge)};
    visit_list_cells(grid,
                     {grid.bricks()[brick + i],
                      {cell.low[0] + part[0] * size, cell.low[1] + part[1] * size, cell.low[2] + part[2] * size},
                      size},
                     visit);
  }
}

/// The same of some top cells. The numbers of the lists ascend.
template <typename Visit>
void visit_list_cells(const Grid& grid, std::size_t first, std::size_t last, const Visit& visit) {
  const auto& [columns, rows, layers] = grid.resolution();
  const std::uint32_t size = grid.frame().division;
  for (std::size_t top = first; top < last; ++top) {
    const CellWord word = grid.top()[top];
    if (word.is_empty()) continue;
    const auto index = static_cast<std::uint32_t>(top);
    visit_list_cells(
        grid, {word, {index % columns * size, index / columns % rows * size, index / columns / rows * size}, size},
        visit);
  }
}

}  // namespace surehit::detail
