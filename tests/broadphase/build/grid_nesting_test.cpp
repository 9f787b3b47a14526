#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <span>

#include "grid/grid.hpp"
#include "support/exact_cells.hpp"
#include "support/grid_breaking_meshes.hpp"

namespace surehit::test::grid_nesting_test {
namespace {

/// Which cells a grid divides.
class GridNesting : public testing::Test {
 protected:
  static Grid grid_of(const GeneratedMesh<float>& mesh, const GridOptions& options) {
    return Grid(mesh.view(), box_of(mesh.view()), options);
  }

  static std::size_t max_listed(const Grid& grid) {
    std::size_t most = 0;
    for (const LeafCell& leaf : LeafCells(grid)) {
      if (!leaf.word.is_empty()) most = std::max(most, grid.triangles(leaf.word).size());
    }
    return most;
  }

  /// Points, one at each of count × count × count positions in the unit cube: they part as far as cells go.
  static GeneratedMesh<float> dust(std::uint32_t count) {
    GeneratedMesh<float> mesh;
    const auto at = [&](std::uint32_t i) { return (static_cast<float>(i) + 0.37F) / static_cast<float>(count); };
    for (std::uint32_t x = 0; x < count; ++x) {
      for (std::uint32_t y = 0; y < count; ++y) {
        for (std::uint32_t z = 0; z < count; ++z) {
          const Vector3<float> point(at(x), at(y), at(z));
          mesh.add({point, point, point});
        }
      }
    }
    for (const float x : {0.0F, 1.0F}) mesh.add({{x, x, x}, {x, x, x}, {x, x, x}});
    return mesh;
  }

  Random random_{20240229};
};

TEST_F(GridNesting, divides_cells_that_list_more_than_is_crowded) {
  const auto mesh = dust(8);
  const std::size_t once = 8 * 8 * 8;
  EXPECT_EQ(grid_of(mesh, {.resolution = {1, 1, 1}, .crowded = once + 2}).levels(), 0U);
  const Grid one_level = grid_of(mesh, {.resolution = {1, 1, 1}, .crowded = once + 1});
  EXPECT_EQ(one_level.levels(), 1U);
  EXPECT_EQ(one_level.frame().division, 4U);
  EXPECT_LE(max_listed(one_level), 9U);
  const Grid two_levels = grid_of(mesh, {.resolution = {1, 1, 1}, .crowded = 3});
  EXPECT_EQ(two_levels.levels(), 2U);
  EXPECT_EQ(two_levels.frame().division, 16U);
  EXPECT_LE(max_listed(two_levels), 2U);
  EXPECT_EQ(two_levels.resolution(), (std::array<std::uint32_t, 3>{1, 1, 1}));
}

TEST_F(GridNesting, never_divides_where_crowded_is_zero) {
  const Grid grid = grid_of(dust(20), {.resolution = {2, 1, 1}, .crowded = 0});
  EXPECT_EQ(grid.levels(), 0U);
  EXPECT_EQ(grid.frame().division, 1U);
  EXPECT_TRUE(grid.bricks().empty());
  EXPECT_EQ(grid.cell_count(), 2U);
}

TEST_F(GridNesting, goes_two_levels_deep_and_no_further) {
  auto mesh = dust(12);
  const Vector3<float> point(0.77F, 0.77F, 0.77F);
  for (int i = 0; i < 10; ++i) mesh.add({point, point, point});
  const Grid grid = grid_of(mesh, {.resolution = {1, 1, 1}, .crowded = 1});
  EXPECT_EQ(grid.levels(), Grid::max_levels);
  EXPECT_GE(max_listed(grid), 10U);
}

/// Dividing would only list each of them 64 times.
TEST_F(GridNesting, leaves_cells_whole_whose_triangles_it_does_not_part) {
  GeneratedMesh<float> mesh;
  for (int i = 0; i < 1000; ++i) {
    const float height = random_.unit<float>();
    mesh.add({{-1, -1, height}, {1, -1, height / 2}, {0, 1, 1 - height}});
  }
  const Grid grid = grid_of(mesh, {.resolution = {2, 2, 2}, .crowded = 4});
  EXPECT_EQ(grid.levels(), 0U);
  EXPECT_TRUE(grid.bricks().empty());
}

TEST_F(GridNesting, leaves_cells_whole_that_list_one_triangle_many_times_over) {
  GeneratedMesh<float> mesh;
  for (int i = 0; i < 1000; ++i) mesh.add({{0, 0, 0}, {1, 0, 0.3F}, {0, 1, 1}});
  const Grid grid = grid_of(mesh, {.resolution = {1, 1, 1}, .crowded = 4});
  EXPECT_TRUE(grid.bricks().empty());
  EXPECT_EQ(max_listed(grid), 1000U);
}

TEST_F(GridNesting, divides_only_where_triangles_crowd) {
  const auto ground = rough_ground<float>(12, 0.3F, random_);
  const Grid grid =
      grid_of(with_small_copy<float>(ground, {0.5F, 0.5F, 0.1F}), {.resolution = {8, 8, 2}, .crowded = 30});
  EXPECT_GT(grid.levels(), 0U);
  const auto divided =
      std::count_if(grid.top().begin(), grid.top().end(), [](CellWord word) { return word.is_divided(); });
  EXPECT_GE(divided, 1);
  EXPECT_LE(divided, 8);
}

/// A word that says nothing but "divided" must not be taken for that of an empty cell, nor the first brick for none.
TEST_F(GridNesting, divides_an_only_cell) {
  const Grid grid = grid_of(dust(4), {.resolution = {1, 1, 1}, .crowded = 8});
  EXPECT_TRUE(grid.top()[0].is_divided());
  EXPECT_EQ(grid.levels(), 1U);
}

/// Every brick hangs from one cell.
TEST_F(GridNesting, has_no_brick_that_no_cell_is_divided_into) {
  for (const std::uint32_t crowded : {1U, 5U, 20U}) {
    const Grid grid =
        grid_of(scattered_triangles<float>(2000, 0.02F, random_), {.resolution = {3, 2, 4}, .crowded = crowded});
    std::multiset<std::uint32_t> bricks;
    const auto find_bricks = [&](auto& self, std::span<const CellWord> words) -> void {
      for (const CellWord word : words) {
        if (!word.is_divided()) continue;
        bricks.insert(word.brick());
        self(self, grid.bricks().subspan(std::size_t{word.brick()} * Grid::brick_size, Grid::brick_size));
      }
    };
    find_bricks(find_bricks, grid.all_top());
    ASSERT_GT(bricks.size(), 0U);
    EXPECT_EQ(std::set(bricks.begin(), bricks.end()).size(), bricks.size()) << "one brick for two cells";
    EXPECT_LE(grid.bricks().size() / Grid::brick_size, bricks.size() + 1) << "one may be left out for its number 0";
  }
}

}  // namespace
}  // namespace surehit::test::grid_nesting_test
