#include "build/empty_space.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
#include <vector>

#include "support/vector_of.hpp"

namespace surehit::detail {
namespace {

constexpr std::uint8_t max_distance = CellWord::max_distance;
constexpr std::uint32_t octants = 8;

/// Distances of 16 cells side by side on the x axis, one byte each. Every target has such vectors.
using CellBytes = VectorOf<std::uint8_t, 16>;
/// The two halves of such a vector.
using Halves = VectorOf<std::uint64_t, 2>;
constexpr std::size_t row_unit = sizeof(CellBytes);

SUREHIT_ALWAYS_INLINE inline CellBytes all_cells(std::uint8_t x) { return CellBytes{} + x; }

SUREHIT_ALWAYS_INLINE inline CellBytes load(const std::uint8_t* from) {
  CellBytes cells;
  std::memcpy(&cells, from, sizeof cells);
  return cells;
}

SUREHIT_ALWAYS_INLINE inline void store(CellBytes cells, std::uint8_t* to) { std::memcpy(to, &cells, sizeof cells); }

/// Returns, for each cell, what is `by` cells ahead of it: upward or downward, as the octant looks. `next` holds the 16
/// cells that follow in that direction.
template <bool is_upward, int by>
SUREHIT_ALWAYS_INLINE inline CellBytes ahead(CellBytes cells, CellBytes next) {
  const auto near = with_bits_of<Halves>(cells);
  const auto far = with_bits_of<Halves>(next);
  const Halves middle = is_upward ? shuffled<1, 2>(near, far) : shuffled<1, 2>(far, near);
  if constexpr (by == 8) return with_bits_of<CellBytes>(middle);
  const Halves& first = by < 8 ? near : middle;
  const Halves& second = by < 8 ? middle : far;
  constexpr int bits = by % 8 * 8;
  constexpr bool to_the_right = is_upward == (std::endian::native == std::endian::little);
  return with_bits_of<CellBytes>(to_the_right ? first >> bits | second << (64 - bits)
                                              : first << bits | second >> (64 - bits));
}

/// Measures the distances in each octant, row by row. An empty cell has seven neighbours ahead. Its cube is larger by
/// one than the smallest of their cubes.
class Octants {
 public:
  /// Rows are padded to whole vectors. Their cells beyond the grid count as empty. What is stored there is read only by
  /// other such cells.
  Octants(const std::array<std::uint32_t, 3>& cells, ScratchVector<std::uint8_t>& scratch)
      : cells_(cells), pitch_((cells[0] + row_unit - 1) / row_unit * row_unit) {
    const std::size_t all_rows = std::size_t{cells[1]} * cells[2] * pitch_;
    scratch.resize((1 + octants) * all_rows + pitch_);
    emptiness_ = scratch.data();
    for (std::uint32_t octant = 0; octant < octants; ++octant)
      distances_[octant] = emptiness_ + (1 + octant) * all_rows;
    outer_row_ = emptiness_ + (1 + octants) * all_rows;
    std::fill_n(outer_row_, pitch_, max_distance);
  }

  /// Returns the index of the first cell of a row.
  [[nodiscard]] std::size_t row(std::uint32_t y, std::uint32_t z) const {
    return (std::size_t{z} * cells_[1] + y) * pitch_;
  }

  /// Stores which cells of a row are empty: those whose words are 0.
  void set_row(std::size_t row, const std::uint32_t* words) {
    std::uint8_t* const emptiness = emptiness_ + row;
    std::fill_n(emptiness, pitch_, no_bits_clear);
    for (std::size_t x = 0; x < cells_[0]; ++x) emptiness[x] = words[x] == 0 ? no_bits_clear : 0;
  }

  /// Measures a row of each octant in turn, because rows of different octants do not wait for each other.
  void measure() {
    for (std::uint32_t step_z = 0; step_z < cells_[2]; ++step_z) {
      for (std::uint32_t step_y = 0; step_y < cells_[1]; ++step_y) {
        for (std::uint32_t octant = 0; octant < octants; octant += 2) {
          measure_row<true>(octant, step_y, step_z);
          measure_row<false>(octant + 1, step_y, step_z);
        }
      }
    }
  }

  /// Adds the distances of all octants to a row of words.
  void add_row(std::size_t row, std::uint32_t* words) const {
    for (std::size_t first = 0; first < cells_[0]; first += row_unit) {
      std::array<std::array<std::uint8_t, row_unit>, octants / 2> pairs;
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        store(load(distances_[2 * i] + row + first) | load(distances_[2 * i + 1] + row + first) << 4, pairs[i].data());
      }
      std::array<std::uint32_t, row_unit> added;
      for (std::size_t x = 0; x < row_unit; ++x) {
        added[x] = std::uint32_t{pairs[0][x]} | std::uint32_t{pairs[1][x]} << 8 | std::uint32_t{pairs[2][x]} << 16 |
                   std::uint32_t{pairs[3][x]} << 24;
      }
      const std::size_t count = std::min(row_unit, cells_[0] - first);
      for (std::size_t x = 0; x < count; ++x) words[first + x] |= added[x];
    }
  }

 private:
  static constexpr std::uint8_t no_bits_clear = 0xff;

  /// Measures a row. The rows beside it allow some distance in each cell. A distance is the minimum of what they allow
  /// in this cell, of one more than they allow in the next cell, and so on. The minimum is taken over four cells first,
  /// then over four groups of four.
  template <bool is_upward>
  SUREHIT_ALWAYS_INLINE void measure_row(std::uint32_t octant, std::uint32_t step_y, std::uint32_t step_z) {
    const std::uint32_t y = (octant & 2) == 0 ? cells_[1] - 1 - step_y : step_y;
    const std::uint32_t z = (octant & 4) == 0 ? cells_[2] - 1 - step_z : step_z;
    const std::uint32_t next_y = (octant & 2) == 0 ? y + 1 : y - 1;
    const std::uint32_t next_z = (octant & 4) == 0 ? z + 1 : z - 1;
    std::uint8_t* const distances = distances_[octant];
    const std::uint8_t* const beside_y = step_y == 0 ? outer_row_ : distances + row(next_y, z);
    const std::uint8_t* const beside_z = step_z == 0 ? outer_row_ : distances + row(y, next_z);
    const std::uint8_t* const beside_both = step_y == 0 || step_z == 0 ? outer_row_ : distances + row(next_y, next_z);
    const std::uint8_t* const emptiness = emptiness_ + row(y, z);
    std::uint8_t* const measured = distances + row(y, z);

    // The same values of the cells that follow in the row.
    CellBytes next_beside = all_cells(max_distance);
    CellBytes next_begun = all_cells(max_distance);
    CellBytes next_of_four = all_cells(max_distance);
    for (std::size_t step = 0; step < pitch_; step += row_unit) {
      const std::size_t x = is_upward ? pitch_ - row_unit - step : step;
      const CellBytes beside = lesser(lesser(load(beside_y + x), load(beside_z + x)), load(beside_both + x));
      const CellBytes nearest =
          lesser(lesser(beside, ahead<is_upward, 1>(beside, next_beside)), all_cells(max_distance - 1));
      const CellBytes begun = (nearest + 1) & load(emptiness + x);
      const CellBytes of_four = min_of_four<is_upward, 1>(begun, next_begun);
      const CellBytes distance = min_of_four<is_upward, 4>(of_four, next_of_four);
      store(distance, measured + x);
      next_beside = beside;
      next_begun = begun;
      next_of_four = of_four;
    }
  }

  /// Returns the minimum over a cell and three cells ahead of it, at distances of `by`. Each allows `by` more than the
  /// one before.
  template <bool is_upward, int by>
  SUREHIT_ALWAYS_INLINE static CellBytes min_of_four(CellBytes cells, CellBytes next) {
    return lesser(
        lesser(cells, ahead<is_upward, by>(cells, next) + by),
        lesser(ahead<is_upward, 2 * by>(cells, next) + 2 * by, ahead<is_upward, 3 * by>(cells, next) + 3 * by));
  }

  std::array<std::uint32_t, 3> cells_;
  std::size_t pitch_;  ///< The length of a row.
  // These point into the scratch.
  std::uint8_t* emptiness_;                       ///< 0xff where a cell is empty, else 0.
  std::array<std::uint8_t*, octants> distances_;  ///< The distances of each octant.
  std::uint8_t* outer_row_;                       ///< A row outside the grid, where all is empty.
};

/// An axis of a brick, whose cells are the bits of one integer.
struct BrickAxis {
  int shift;              ///< The number of bits from one cell to the next on the axis.
  std::uint64_t highest;  ///< The bits of the last cells on the axis.
  std::uint64_t lowest;   ///< The bits of the first cells on the axis.
};
constexpr std::array<BrickAxis, 3> brick_axes = {{{1, 0x8888888888888888, 0x1111111111111111},
                                                  {4, 0xf000f000f000f000, 0x000f000f000f000f},
                                                  {16, 0xffff000000000000, 0x000000000000ffff}}};
static_assert(Grid::brick_edge == 4);

/// Takes the corners of all cubes of some size that are not empty, as set bits. Returns the same for cubes that are one
/// cell larger.
std::uint64_t grown(std::uint64_t cubes, std::uint32_t octant) {
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    const BrickAxis& along = brick_axes[axis];
    const bool upward = (octant >> axis & 1) == 0;
    cubes |= upward ? cubes >> along.shift | along.highest : cubes << along.shift | along.lowest;
  }
  return cubes;
}

/// 32 rows of 32 bits.
using BitMatrix = std::array<std::uint32_t, 32>;

/// Transposes the matrix by swapping halves, then quarters, and so on (Warren, Hacker's Delight).
void transpose(BitMatrix& rows) {
  std::uint32_t right_half = 0xffff;
  for (std::uint32_t half = 16; half != 0; half /= 2, right_half ^= right_half << half) {
    for (std::uint32_t i = 0; i < 32; i = (i + half + 1) & ~half) {
      const std::uint32_t swapped = (rows[i] >> half ^ rows[i + half]) & right_half;
      rows[i] ^= swapped << half;
      rows[i + half] ^= swapped;
    }
  }
}

}  // namespace

void measure_empty_space(std::span<std::uint32_t> words, const std::array<std::uint32_t, 3>& cells,
                         ScratchVector<std::uint8_t>& scratch) {
  Octants distances(cells, scratch);
  const auto for_rows = [&](const auto& visit) {
    std::uint32_t* row = words.data();
    for (std::uint32_t z = 0; z < cells[2]; ++z) {
      for (std::uint32_t y = 0; y < cells[1]; ++y, row += cells[0]) visit(distances.row(y, z), row);
    }
  };
  for_rows([&](std::size_t row, const std::uint32_t* cells_of_row) { distances.set_row(row, cells_of_row); });
  distances.measure();
  for_rows([&](std::size_t row, std::uint32_t* cells_of_row) { distances.add_row(row, cells_of_row); });
}

void measure_empty_space(std::span<std::uint32_t, Grid::brick_size> words) {
  std::uint64_t occupied = 0;
  for (std::uint32_t cell = 0; cell < Grid::brick_size; ++cell) {
    occupied |= std::uint64_t{words[cell] != 0 ? 1U : 0U} << cell;
  }
  // Row 4 octant + b holds bit b of the distances in an octant, with one bit for each cell. So the columns are the
  // words.
  BitMatrix lower = {};
  BitMatrix upper = {};
  for (std::uint32_t octant = 0; octant < octants; ++octant) {
    const std::size_t row = std::size_t{4} * octant;
    const std::uint64_t two = grown(occupied, octant);
    const std::uint64_t three = grown(two, octant);
    const std::uint64_t four = grown(three, octant);
    // The distance is 1 if a cube of two cells is not empty. Else it is 2 if a cube of three is not empty, and so on up
    // to 4.
    const std::array<std::uint64_t, 3> bits = {two | (four & ~three), four & ~two, ~four};
    for (std::size_t b = 0; b < bits.size(); ++b) {
      lower[row + b] = static_cast<std::uint32_t>(bits[b] & ~occupied);
      upper[row + b] = static_cast<std::uint32_t>((bits[b] & ~occupied) >> 32);
    }
  }
  transpose(lower);
  transpose(upper);
  for (std::size_t i = 0; i < lower.size(); ++i) {
    words[i] |= lower[i];
    words[32 + i] |= upper[i];
  }
}

}  // namespace surehit::detail
