#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "grid/grid.hpp"
#include "support/scratch_vector.hpp"

namespace surehit::detail {

/// Fills the words of the empty top cells, which are 0. A word gets a distance for each octant of directions: the edge
/// of the largest cube of empty cells that begins with this cell. It is at most `CellWord::max_distance`. Beyond the
/// grid all is empty. x runs fastest, then y, then z. `scratch` may hold anything; only its memory is used.
void measure_empty_space(std::span<std::uint32_t> words, const std::array<std::uint32_t, 3>& cells,
                         ScratchVector<std::uint8_t>& scratch);

/// Does the same for a brick. Outside the brick nothing counts as empty.
void measure_empty_space(std::span<std::uint32_t, Grid::brick_size> words);

}  // namespace surehit::detail
