#include "build/empty_space.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "support/case_count.hpp"
#include "support/empty_cubes.hpp"
#include "support/random.hpp"

namespace surehit::test::empty_space_test {
namespace {

using Cells = std::array<std::uint32_t, 3>;

class EmptySpace : public testing::Test {
 protected:
  std::vector<std::uint32_t> draw(const Cells& cells, std::uint64_t one_in) {
    std::vector<std::uint32_t> words(std::size_t{cells[0]} * cells[1] * cells[2]);
    for (std::uint32_t& word : words) {
      if (random_.one_in(one_in)) word = CellWord::listing(static_cast<std::uint32_t>(random_.below(1000))).bits();
    }
    return words;
  }

  static void expect_top_measured(const std::vector<std::uint32_t>& words, const Cells& cells) {
    std::vector<std::uint32_t> measured = words;
    detail::ScratchVector<std::uint8_t> scratch(7, 3);  // as another build may leave it
    detail::measure_empty_space(measured, cells, scratch);
    expect_exact(words, measured, cells, true);
  }

  static void expect_brick_measured(const std::vector<std::uint32_t>& words) {
    std::vector<std::uint32_t> measured = words;
    detail::measure_empty_space(std::span<std::uint32_t, Grid::brick_size>(measured));
    expect_exact(words, measured, {Grid::brick_edge, Grid::brick_edge, Grid::brick_edge}, false);
  }

  /// Words of occupied cells stay as they are; those of empty ones hold the largest empty cube of each octant.
  static void expect_exact(const std::vector<std::uint32_t>& words, const std::vector<std::uint32_t>& measured,
                           const Cells& cells, bool empty_beyond) {
    std::vector<bool> empty(words.size());
    for (std::size_t cell = 0; cell < words.size(); ++cell) empty[cell] = words[cell] == 0;
    const EmptyCubes cubes(empty, cells, empty_beyond);
    for (std::size_t cell = 0; cell < words.size(); ++cell) {
      if (!empty[cell]) {
        ASSERT_EQ(measured[cell], words[cell]);
        continue;
      }
      ASSERT_TRUE(CellWord(measured[cell]).is_empty());
      for (std::uint32_t octant = 0; octant < 8; ++octant) {
        ASSERT_EQ(CellWord(measured[cell]).distance(octant), cubes.largest(cell, octant, CellWord::max_distance))
            << "cell " << cell << " of " << cells[0] << " × " << cells[1] << " × " << cells[2] << " towards " << octant;
      }
    }
  }

  Random random_{20240229};
};

TEST_F(EmptySpace, of_top_cells_is_that_of_the_largest_empty_cubes) {
  for (std::size_t i = 0; i < case_count(300); ++i) {
    const auto length = [&] { return static_cast<std::uint32_t>(random_.between(1, 7)); };
    const Cells cells = {length(), length(), length()};
    expect_top_measured(draw(cells, 1 + random_.below(60)), cells);
  }
}

TEST_F(EmptySpace, is_capped_at_what_a_nibble_holds) {
  for (const Cells& cells : {Cells{40, 1, 1}, Cells{1, 40, 1}, Cells{1, 1, 40}, Cells{16, 18, 17}}) {
    expect_top_measured(draw(cells, 10'000), cells);
    expect_top_measured(draw(cells, 30), cells);
    std::vector<std::uint32_t> corner = draw(cells, 1'000'000'000);
    corner.front() = CellWord::listing(0).bits();
    expect_top_measured(corner, cells);
  }
}

TEST_F(EmptySpace, of_a_brick_ends_with_it) {
  for (std::size_t i = 0; i < case_count(1000); ++i) {
    expect_brick_measured(draw({Grid::brick_edge, Grid::brick_edge, Grid::brick_edge}, 1 + random_.below(100)));
  }
}

TEST_F(EmptySpace, of_a_brick_with_one_cell_or_none) {
  std::vector<std::uint32_t> words(Grid::brick_size);
  expect_brick_measured(words);
  for (std::uint32_t& word : words) {
    word = CellWord::listing(7).bits();
    expect_brick_measured(words);
    word = 0;
  }
}

}  // namespace
}  // namespace surehit::test::empty_space_test
