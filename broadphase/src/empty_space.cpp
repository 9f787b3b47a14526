#include "empty_space.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace surehit::detail {
namespace {

constexpr std::uint8_t farthest = CellWord::farthest;
/// Rows are as long as some of these, so that loops along them are whole vectors, and lie one apart: room for what is
/// beyond the grid, as far as a row is looked along.
constexpr std::size_t row_unit = 16;
constexpr std::uint32_t octants = 8;

/// Distances in each octant, row by row. A cube with a corner in an empty cell is one larger than the least of those
/// that have it in the seven next cells.
class Octants {
 public:
  Octants(const std::array<std::uint32_t, 3>& cells, std::vector<std::uint8_t>& scratch)
      : cells_(cells), length_((cells[0] + row_unit - 1) / row_unit * row_unit), pitch_(length_ + row_unit) {
    const std::size_t all_rows = std::size_t{cells[1]} * cells[2] * pitch_;
    scratch.assign(row_unit + (1 + octants) * all_rows + (1 + 2 * octants) * pitch_, farthest);
    emptiness_ = scratch.data() + row_unit;
    for (std::uint32_t octant = 0; octant < octants; ++octant)
      distances_[octant] = emptiness_ + (1 + octant) * all_rows;
    outer_row_ = emptiness_ + (1 + octants) * all_rows;
    for (std::uint32_t octant = 0; octant < octants; ++octant) {
      begun_[octant] = outer_row_ + (1 + octant) * pitch_;
      fours_[octant] = outer_row_ + (1 + octants + octant) * pitch_;
    }
  }

  /// Where the cells of a row begin.
  [[nodiscard]] std::size_t row(std::uint32_t y, std::uint32_t z) const {
    return (std::size_t{z} * cells_[1] + y) * pitch_;
  }

  void set_row(std::size_t row, const std::uint32_t* words) {
    std::uint8_t* const emptiness = emptiness_ + row;
    std::fill_n(emptiness, length_, no_bits_clear);
    for (std::size_t x = 0; x < cells_[0]; ++x) emptiness[x] = words[x] == 0 ? no_bits_clear : 0;
  }

  /// Along a row a distance is the least of what the rows beside it allow here, one more than they allow in the next
  /// cell, and so on: looked up among four cells, then among four fours. Cells of the row beyond the grid count as
  /// empty; what they are given is read only from there.
  ///
  /// All octants by turns: their rows do not wait for one another, nor does a look ahead for what was just stored.
  void measure() {
    for (std::uint32_t step_z = 0; step_z < cells_[2]; ++step_z) {
      for (std::uint32_t step_y = 0; step_y < cells_[1]; ++step_y) {
        for (std::uint32_t octant = 0; octant < octants; ++octant) begin_row(octant, step_y, step_z);
        for (std::uint32_t octant = 0; octant < octants; ++octant) {
          look_ahead(begun_[octant], forward(octant), 1, fours_[octant]);
        }
        for (std::uint32_t octant = 0; octant < octants; ++octant) {
          const Place place = place_of(octant, step_y, step_z);
          look_ahead(fours_[octant], 4 * forward(octant), 4, distances_[octant] + row(place.y, place.z));
        }
      }
    }
  }

  /// Adds the distances of all octants to a row of words.
  void add_row(std::size_t row, std::uint32_t* words) const {
    std::array<std::array<std::uint8_t, row_unit>, octants / 2> pairs;
    for (std::size_t first = 0; first < cells_[0]; first += row_unit) {
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        const std::uint8_t* const even = distances_[2 * i] + row + first;
        const std::uint8_t* const odd = distances_[2 * i + 1] + row + first;
        for (std::size_t x = 0; x < row_unit; ++x) pairs[i][x] = static_cast<std::uint8_t>(even[x] | odd[x] << 4);
      }
      for (std::size_t x = 0; x < std::min(row_unit, cells_[0] - first); ++x) {
        words[first + x] |= std::uint32_t{pairs[0][x]} | std::uint32_t{pairs[1][x]} << 8 |
                            std::uint32_t{pairs[2][x]} << 16 | std::uint32_t{pairs[3][x]} << 24;
      }
    }
  }

 private:
  static constexpr std::uint8_t no_bits_clear = 0xff;

  using Row = const std::uint8_t* __restrict;

  static std::uint8_t lesser(std::uint8_t x, std::uint8_t y) { return x < y ? x : y; }

  static std::ptrdiff_t forward(std::uint32_t octant) { return (octant & 1) == 0 ? 1 : -1; }

  /// Of the row to which so many steps lead, from the end of the grid towards which the octant looks.
  struct Place {
    std::uint32_t y, z;
  };
  [[nodiscard]] Place place_of(std::uint32_t octant, std::uint32_t step_y, std::uint32_t step_z) const {
    return {(octant & 2) == 0 ? cells_[1] - 1 - step_y : step_y, (octant & 4) == 0 ? cells_[2] - 1 - step_z : step_z};
  }

  /// What the rows beside it allow.
  void begin_row(std::uint32_t octant, std::uint32_t step_y, std::uint32_t step_z) {
    const Place here = place_of(octant, step_y, step_z);
    const auto beside = [&](std::uint32_t back_y, std::uint32_t back_z) -> const std::uint8_t* {
      if (step_y < back_y || step_z < back_z) return outer_row_;
      const Place place = place_of(octant, step_y - back_y, step_z - back_z);
      return distances_[octant] + row(place.y, place.z);
    };
    begin_row(emptiness_ + row(here.y, here.z), beside(1, 0), beside(0, 1), beside(1, 1), forward(octant),
              begun_[octant]);
  }

  void begin_row(Row emptiness, Row b0, Row b1, Row b2, std::ptrdiff_t forward, std::uint8_t* __restrict row) const {
    const Row ahead0 = b0 + forward;
    const Row ahead1 = b1 + forward;
    const Row ahead2 = b2 + forward;
    for (std::size_t first = 0; first < length_; first += row_unit) {
      for (std::size_t x = first; x < first + row_unit; ++x) {
        const std::uint8_t here = lesser(lesser(b0[x], b1[x]), b2[x]);
        const std::uint8_t ahead = lesser(lesser(ahead0[x], ahead1[x]), ahead2[x]);
        const std::uint8_t least = lesser(lesser(here, ahead), farthest - 1);
        row[x] = static_cast<std::uint8_t>((least + 1) & emptiness[x]);
      }
    }
  }

  /// The least of a cell and the three after it, `by` apart, each of which allows `more` than the one before.
  void look_ahead(Row row, std::ptrdiff_t by, std::uint8_t more, std::uint8_t* __restrict farther) const {
    const Row one = row + by;
    const Row two = row + 2 * by;
    const Row three = row + 3 * by;
    const auto plus = [](std::uint8_t x, int y) { return static_cast<std::uint8_t>(x + y); };
    for (std::size_t first = 0; first < length_; first += row_unit) {
      for (std::size_t x = first; x < first + row_unit; ++x) {
        farther[x] =
            lesser(lesser(row[x], plus(one[x], more)), lesser(plus(two[x], 2 * more), plus(three[x], 3 * more)));
      }
    }
  }

  std::array<std::uint32_t, 3> cells_;
  std::size_t length_;
  std::size_t pitch_;
  // All in the scratch.
  std::uint8_t* emptiness_;  ///< all bits set where a cell is empty
  std::array<std::uint8_t*, octants> distances_;
  std::uint8_t* outer_row_;
  // Of the row that is being measured, in each octant.
  std::array<std::uint8_t*, octants> begun_;  ///< what the rows beside it allow
  std::array<std::uint8_t*, octants> fours_;  ///< the least of four cells
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

using BitMatrix = std::array<std::uint32_t, 32>;

/// By swapping halves, then quarters, and so on (Warren, Hacker's Delight).
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
                         std::vector<std::uint8_t>& scratch) {
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
  // Bit b of the distances in an octant is row 4 octant + b, a bit for each cell; so the columns are the words.
  BitMatrix lower = {};
  BitMatrix upper = {};
  for (std::uint32_t octant = 0; octant < octants; ++octant) {
    const std::size_t row = std::size_t{4} * octant;
    const std::uint64_t two = grown(occupied, octant);
    const std::uint64_t three = grown(two, octant);
    const std::uint64_t four = grown(three, octant);
    // 1 where a cube of two cells is not empty, else 2 where one of three is not, and so on up to 4.
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
