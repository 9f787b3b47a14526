#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "grid/grid.hpp"

namespace surehit::detail {

/// Fills the words of the empty top cells, those whose bits are 0: for each octant of directions the edge of the
/// largest empty cube that has the cell for its corner, up to `CellWord::max_distance`. Beyond the grid all is empty.
/// Cells of x lie side by side, then y, then z. What `scratch` holds does not matter; its memory is used again.
void measure_empty_space(std::span<std::uint32_t> words, const std::array<std::uint32_t, 3>& cells,
                         UnsetVector<std::uint8_t>& scratch);

/// The same for a brick, beyond which nothing is known to be empty.
void measure_empty_space(std::span<std::uint32_t, Grid::brick_size> words);

}  // namespace surehit::detail
