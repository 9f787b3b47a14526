#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "grid/grid.hpp"
#include "support/empty_cubes.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/scalars.hpp"

namespace surehit::test::grid_distances_test {
namespace {

/// The distances in the words of a whole grid's empty cells, against asking all cells of every cube.
class GridDistances : public testing::Test {
 protected:
  static Grid grid_of(const GeneratedMesh<float>& mesh, const GridOptions& options) {
    return Grid(mesh.view(), box_of(mesh.view()), options);
  }

  static std::vector<bool> empty_cells(std::span<const CellWord> words) {
    std::vector<bool> empty(words.size());
    std::transform(words.begin(), words.end(), empty.begin(), [](CellWord word) { return word.is_empty(); });
    return empty;
  }

  static std::size_t expect_exact(std::span<const CellWord> words, const std::array<std::uint32_t, 3>& cells,
                                  bool empty_beyond) {
    const EmptyCubes cubes(empty_cells(words), cells, empty_beyond);
    std::size_t greatest = 0;
    for (std::size_t cell = 0; cell < words.size(); ++cell) {
      if (!words[cell].is_empty()) continue;
      for (std::uint32_t octant = 0; octant < 8; ++octant) {
        const std::uint32_t distance = words[cell].distance(octant);
        EXPECT_EQ(distance, cubes.largest(cell, octant, CellWord::max_distance)) << cell << " towards " << octant;
        greatest = std::max<std::size_t>(greatest, distance);
      }
    }
    return greatest;
  }

  Random random_{20240229};
};

TEST_F(GridDistances, of_top_cells_are_those_of_the_largest_empty_cubes) {
  for (const std::size_t count : {1U, 5U, 40U}) {
    const Grid grid = grid_of(scattered_triangles<float>(count, 0.05F, random_), {.resolution = {23, 17, 20}});
    EXPECT_GT(expect_exact(grid.top(), grid.resolution(), true), 4U);
  }
}

TEST_F(GridDistances, are_capped_at_what_a_nibble_holds) {
  GeneratedMesh<float> mesh;
  for (const float x : {0.0F, 1.0F}) mesh.add({{x, x, x}, {x, x, x}, {x, x, x}});
  const Grid grid = grid_of(mesh, {.resolution = {40, 3, 3}});
  EXPECT_EQ(expect_exact(grid.top(), grid.resolution(), true), CellWord::max_distance);
}

TEST_F(GridDistances, of_bricks_end_with_the_brick) {
  const Grid grid = grid_of(scattered_triangles<float>(300, 0.02F, random_), {.resolution = {3, 2, 2}, .crowded = 1});
  ASSERT_EQ(grid.levels(), Grid::max_levels);
  std::size_t greatest = 0;
  for (std::size_t first = 0; first < grid.bricks().size(); first += Grid::brick_size) {
    const std::uint32_t edge = Grid::brick_edge;
    greatest =
        std::max(greatest, expect_exact(grid.bricks().subspan(first, Grid::brick_size), {edge, edge, edge}, false));
  }
  EXPECT_GT(greatest, 1U);
  EXPECT_LE(greatest, Grid::brick_edge);
}

}  // namespace
}  // namespace surehit::test::grid_distances_test
