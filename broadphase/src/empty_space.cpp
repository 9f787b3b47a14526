#include "empty_space.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace surehit::detail {
namespace {

constexpr std::uint8_t farthest = CellWord::farthest;
/// Room beside a row for what lies beyond the grid, as far as a row is looked along.
constexpr std::size_t beyond = 16;

/// Distances in one octant, row by row, with room beside each row. A cube with a corner in an empty cell is one larger
/// than the least of those that have it in the seven next cells.
class Octant {
 public:
  Octant(const std::array<std::uint32_t, 3>& cells, std::vector<std::uint8_t>& scratch)
      : cells_(cells), pitch_(cells[0] + 2 * beyond) {
    const std::size_t cell_count = std::size_t{cells[0]} * cells[1] * cells[2];
    const std::size_t rows = std::size_t{cells[1]} * cells[2];
    scratch.assign(cell_count + (rows + 3) * pitch_, farthest);
    occupied_ = scratch.data();
    distances_ = occupied_ + cell_count;
    outer_row_ = distances_ + rows * pitch_;
    row_ = outer_row_ + pitch_;
    next_ = row_ + pitch_;
  }

  void set_occupied(std::size_t cell, bool occupied) { occupied_[cell] = occupied ? 1 : 0; }

  void measure(std::uint32_t octant) {
    const bool up_y = (octant & 2) == 0;
    const bool up_z = (octant & 4) == 0;
    for (std::uint32_t step_z = 0; step_z < cells_[2]; ++step_z) {
      const std::uint32_t z = up_z ? cells_[2] - 1 - step_z : step_z;
      for (std::uint32_t step_y = 0; step_y < cells_[1]; ++step_y) {
        const std::uint32_t y = up_y ? cells_[1] - 1 - step_y : step_y;
        const auto beside = [&](bool beside_y, bool beside_z) -> const std::uint8_t* {
          if ((beside_y && step_y == 0) || (beside_z && step_z == 0)) return outer_row_;
          const std::uint32_t row_y = beside_y ? (up_y ? y + 1 : y - 1) : y;
          const std::uint32_t row_z = beside_z ? (up_z ? z + 1 : z - 1) : z;
          return row(row_y, row_z);
        };
        measure_row(occupied_ + (std::size_t{z} * cells_[1] + y) * cells_[0], (octant & 1) == 0,
                    {beside(true, false), beside(false, true), beside(true, true)}, row(y, z) + beyond);
      }
    }
  }

  [[nodiscard]] const std::uint8_t* distances(std::uint32_t y, std::uint32_t z) { return row(y, z) + beyond; }

 private:
  [[nodiscard]] std::uint8_t* row(std::uint32_t y, std::uint32_t z) {
    return distances_ + (std::size_t{z} * cells_[1] + y) * pitch_;
  }

  /// Along the row a distance is the least of what the rows beside it allow here, one more than they allow in the next
  /// cell, and so on: looked up in strides of 1, 2, 4 and 8, as loops that are vectors.
  void measure_row(const std::uint8_t* occupied, bool upward, const std::array<const std::uint8_t*, 3>& beside,
                   std::uint8_t* distances) {
    const std::size_t count = cells_[0];
    for (std::size_t x = 0; x < pitch_; ++x) {
      const std::uint8_t two = beside[0][x] < beside[1][x] ? beside[0][x] : beside[1][x];
      next_[x] = two < beside[2][x] ? two : beside[2][x];
    }
    std::uint8_t* from = row_ + beyond;
    std::uint8_t* to = next_ + beyond;
    const std::ptrdiff_t forward = upward ? 1 : -1;
    std::fill_n(row_, pitch_, farthest);
    for (std::size_t x = 0; x < count; ++x) {
      const std::uint8_t ahead = to[static_cast<std::ptrdiff_t>(x) + forward];
      const std::uint8_t least = to[x] < ahead ? to[x] : ahead;
      const std::uint8_t more = least < farthest ? static_cast<std::uint8_t>(least + 1) : farthest;
      from[x] = occupied[x] != 0 ? 0 : more;
    }
    std::fill_n(next_, pitch_, farthest);
    for (std::ptrdiff_t stride = 1; stride < 16; stride *= 2) {
      const std::uint8_t* ahead = from + stride * forward;
      for (std::size_t x = 0; x < count; ++x) {
        const auto through = static_cast<std::uint8_t>(ahead[x] + stride);
        to[x] = from[x] < through ? from[x] : through;
      }
      std::swap(from, to);
    }
    std::copy_n(from, count, distances);
  }

  std::array<std::uint32_t, 3> cells_;
  std::size_t pitch_;
  // All in the scratch.
  std::uint8_t* occupied_;
  std::uint8_t* distances_;
  std::uint8_t* outer_row_;
  std::uint8_t* row_;
  std::uint8_t* next_;
};

/// A brick's cells as bits; the last ones of each axis, upward or downward.
struct BrickAxis {
  int shift;
  std::uint64_t highest;
  std::uint64_t lowest;
};
constexpr std::array<BrickAxis, 3> brick_axes = {{{1, 0x8888888888888888, 0x1111111111111111},
                                                  {4, 0xf000f000f000f000, 0x000f000f000f000f},
                                                  {16, 0xffff000000000000, 0x000000000000ffff}}};
static_assert(Grid::brick_edge == 4);

/// The corners of cubes of one more cell that are not empty, for cubes that are not empty where bits are set.
std::uint64_t grown(std::uint64_t cubes, std::uint32_t octant) {
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    const BrickAxis& along = brick_axes[axis];
    const bool upward = (octant >> axis & 1) == 0;
    cubes |= upward ? cubes >> along.shift | along.highest : cubes << along.shift | along.lowest;
  }
  return cubes;
}

}  // namespace

void measure_empty_space(std::span<std::uint32_t> words, const std::array<std::uint32_t, 3>& cells,
                         std::vector<std::uint8_t>& scratch) {
  Octant octant(cells, scratch);
  for (std::size_t cell = 0; cell < words.size(); ++cell) octant.set_occupied(cell, words[cell] != 0);
  for (std::uint32_t index = 0; index < 8; ++index) {
    octant.measure(index);
    std::size_t cell = 0;
    for (std::uint32_t z = 0; z < cells[2]; ++z) {
      for (std::uint32_t y = 0; y < cells[1]; ++y) {
        const std::uint8_t* distances = octant.distances(y, z);
        for (std::uint32_t x = 0; x < cells[0]; ++x, ++cell) words[cell] |= std::uint32_t{distances[x]} << 4 * index;
      }
    }
  }
}

void measure_empty_space(std::span<std::uint32_t, Grid::brick_size> words) {
  std::uint64_t occupied = 0;
  for (std::uint32_t cell = 0; cell < Grid::brick_size; ++cell) {
    occupied |= std::uint64_t{words[cell] != 0 ? 1U : 0U} << cell;
  }
  for (std::uint32_t octant = 0; octant < 8; ++octant) {
    const std::uint64_t two = grown(occupied, octant);
    const std::uint64_t three = grown(two, octant);
    const std::uint64_t four = grown(three, octant);
    for (std::uint32_t cell = 0; cell < Grid::brick_size; ++cell) {
      if ((occupied >> cell & 1) != 0) continue;
      const auto distance =
          static_cast<std::uint32_t>(4 - (two >> cell & 1) - (three >> cell & 1) - (four >> cell & 1));
      words[cell] |= distance << 4 * octant;
    }
  }
}

}  // namespace surehit::detail
