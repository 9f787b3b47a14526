#include "build/cell_lister.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace surehit::test::cell_lister_test {
namespace {

using detail::CellEntries;
using detail::CellLister;
using detail::PaddedPoint;

/// Listed in two rows of cells of size 1.
class TrianglesInTwoRows {
 public:
  static constexpr std::uint32_t row = 300;

  TrianglesInTwoRows() : lister_(entries_, true, cells, 1, padding) {}
  explicit TrianglesInTwoRows(std::size_t room) : lister_(entries_, false, cells, 1, padding) {
    entries_.make_room(room);
  }

  /// Within one cell of the first row.
  void add_small(std::uint32_t cell) {
    const auto x = static_cast<float>(cell);
    add({PaddedPoint{x + 0.4F, 0.4F, 0.5F, 0}, PaddedPoint{x + 0.6F, 0.4F, 0.5F, 0},
         PaddedPoint{x + 0.5F, 0.6F, 0.5F, 0}});
    expected_.push_back({triangles_ - 1, cell});
  }
  /// Across two planes: in four cells, which only the lanes can tell.
  void add_large(std::uint32_t cell) {
    const auto x = static_cast<float>(cell);
    add({PaddedPoint{x + 0.5F, 0.5F, 0.5F, 0}, PaddedPoint{x + 1.5F, 0.5F, 0.5F, 0},
         PaddedPoint{x + 1, 1.5F, 0.5F, 0}});
    for (const std::uint32_t met : {cell, cell + 1, cell + row, cell + row + 1}) {
      expected_.push_back({triangles_ - 1, met});
    }
  }

  void expect_listed() {
    ASSERT_TRUE(fit());
    for (std::size_t i = 0; i < expected_.size(); ++i) {
      ASSERT_EQ(entries_.triangles[i], expected_[i].triangle) << i;
      ASSERT_EQ(entries_.cells[i], expected_[i].cell) << i;
    }
  }

  [[nodiscard]] bool fit() {
    lister_.finish();
    return entries_.count == expected_.size();
  }

 private:
  struct Entry {
    std::uint32_t triangle;
    std::uint32_t cell;
  };

  void add(const CellLister::Corners& corners) {
    const auto& [a, b, c] = corners;
    using namespace detail;
    lister_.add(triangles_++, corners, {min(min(a, b), c), max(max(a, b), c)});
  }

  static constexpr detail::CellRange cells = {{0, 0, 0}, {row, 2, 1}};
  static constexpr detail::CellPoint padding = {0.01F, 0.01F, 0.01F};
  CellEntries entries_;
  CellLister lister_;
  std::uint32_t triangles_ = 0;
  std::vector<Entry> expected_;
};

TEST(CellLister, keeps_the_order_in_which_triangles_are_added) {
  TrianglesInTwoRows triangles;
  for (std::uint32_t i = 0; i < 200; ++i) {
    if (i % 3 == 0 || (i > 80 && i < 120)) {
      triangles.add_large(i);
    } else {
      triangles.add_small(i);
    }
  }
  triangles.expect_listed();
}

/// Waiting blocks are listed when they are many, whether lanes are full or not.
TEST(CellLister, lists_many_blocks_without_asking_and_many_that_are_asked) {
  TrianglesInTwoRows triangles;
  for (std::uint32_t i = 0; i < 127; ++i) triangles.add_small(i);
  triangles.add_large(127);
  for (std::uint32_t i = 128; i < 290; ++i) triangles.add_large(i);
  triangles.expect_listed();
}

/// What is written for a block, met or not, takes eight entries at most.
TEST(CellLister, has_too_many_entries_where_not_all_that_may_be_written_fits) {
  const auto fit = [](std::uint32_t count, std::size_t room) {
    TrianglesInTwoRows triangles(room);
    for (std::uint32_t i = 0; i < count; ++i) triangles.add_small(i);
    return triangles.fit();
  };
  constexpr auto most = static_cast<std::uint32_t>(detail::ListedBlocks::max_count);
  EXPECT_TRUE(fit(3, 24));
  EXPECT_FALSE(fit(3, 23));
  EXPECT_TRUE(fit(most, 8 * most));
  EXPECT_FALSE(fit(most, 8 * most - 1));
  EXPECT_TRUE(fit(most + 1, 8 * most));
  EXPECT_TRUE(fit(0, 0));
}

}  // namespace
}  // namespace surehit::test::cell_lister_test
