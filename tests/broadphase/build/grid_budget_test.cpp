#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "grid/grid.hpp"
#include "support/grid_breaking_meshes.hpp"

namespace surehit::test::grid_budget_test {
namespace {

/// Meshes and options that would take far too much memory and time if a grid did as it is told.
class GridBudget : public testing::Test {
 protected:
  static Grid grid_of(const GeneratedMesh<float>& mesh, const GridOptions& options = {}) {
    return Grid(mesh.view(), box_of(mesh.view()), options);
  }

  /// Lists may hold 8 entries a triangle, or 2^18, and each level of bricks up to three times as much.
  static void expect_within_budget(const Grid& grid, std::size_t triangles) {
    EXPECT_LE(grid.entry_count(), 9 * std::max(std::size_t{1} << 18, 8 * triangles));
    EXPECT_LE(grid.top().size(), std::size_t{1} << 24);
    const auto& cells = grid.resolution();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_LE(cells[axis], std::uint32_t{1} << 11);
      EXPECT_LE(grid.frame().resolution(axis), std::uint32_t{1} << 15);
    }
  }

  Random random_{20240229};
  static constexpr std::uint32_t absurd = std::numeric_limits<std::uint32_t>::max();
  static constexpr double infinity = std::numeric_limits<double>::infinity();
};

TEST_F(GridBudget, of_cells_is_kept) {
  const auto triangles = scattered_triangles<float>(10, 0.02F, random_);
  for (const GridOptions& options :
       {GridOptions{.resolution = {absurd, absurd, absurd}}, GridOptions{.cells_per_triangle = infinity},
        GridOptions{.cells_per_triangle = std::numeric_limits<double>::max()}}) {
    const Grid grid = grid_of(triangles, options);
    expect_within_budget(grid, 10);
    EXPECT_LE(grid.top().size(), std::size_t{1} << 20);
    EXPECT_GE(grid.top().size(), std::size_t{1} << 17) << "it is made coarser, not coarse";
  }
}

TEST_F(GridBudget, of_cells_on_an_axis_is_kept) {
  GeneratedMesh<float> mesh;
  for (const float x : {0.0F, 1.0F}) mesh.add({{x, x, x}, {x, x, x}, {x, x, x}});
  EXPECT_EQ(grid_of(mesh, {.resolution = {absurd, 1, 1}}).resolution(), (std::array<std::uint32_t, 3>{2048, 1, 1}));
  EXPECT_EQ(grid_of(mesh, {.resolution = {3000, 2, 2048}}).resolution()[0], 512U) << "2^20 cells are free";
}

TEST_F(GridBudget, of_cells_grows_with_the_mesh) {
  const std::size_t count = 500'000;
  const auto triangles = scattered_triangles<float>(count, 0.001F, random_);
  const Grid grid = grid_of(triangles, {.resolution = {absurd, absurd, absurd}});
  expect_within_budget(grid, count);
  EXPECT_LE(grid.top().size(), 8 * count);
  EXPECT_GT(grid.top().size(), std::size_t{1} << 20);
}

/// What takes a grid to its limits, and no more than some seconds each.
class GridBudgetOfMesh : public GridBudget {
 protected:
  void expect_built_quickly(const GeneratedMesh<float>& mesh) {
    const std::size_t triangles = mesh.triangles.size();
    for (const GridOptions& options :
         {GridOptions{}, GridOptions{.crowded = 1}, GridOptions{.resolution = {200, 200, 200}},
          GridOptions{.resolution = {absurd, absurd, absurd}, .crowded = 4}, GridOptions{.cells_per_triangle = 0.01},
          GridOptions{.resolution = {1, 1, 1}, .crowded = 0}}) {
      const auto before = std::chrono::steady_clock::now();
      const Grid grid = grid_of(mesh, options);
      const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - before;
      expect_within_budget(grid, triangles);
      EXPECT_LE(seconds.count(), 30) << "far more than it takes, far less than without a budget";
    }
  }
};

TEST_F(GridBudgetOfMesh, one_huge_triangle_among_many_tiny_ones) {
  auto mesh = placed<float>(scattered_triangles<float>(100'000, 0.01F, random_), 0.001F, {0, 0, 0});
  mesh.add({{-1, -1, -1}, {1, -1, 1}, {-1, 1, 1}});
  expect_built_quickly(mesh);
}

TEST_F(GridBudgetOfMesh, flat_sheet) {
  expect_built_quickly(flattened<float>(rough_ground<float>(200, 0, random_), 2, 5));
  expect_built_quickly(rough_ground<float>(200, 1e-6F, random_));
}

TEST_F(GridBudgetOfMesh, line_of_needles) { expect_built_quickly(line_of_needles<float>(20'000, random_)); }

TEST_F(GridBudgetOfMesh, many_copies_of_one_triangle) {
  GeneratedMesh<float> mesh;
  for (std::size_t i = 0; i < 30'000; ++i) mesh.add({{0, 0, 0}, {1, 0, 0.2F}, {0, 1, 1}});
  expect_built_quickly(mesh);
}

TEST_F(GridBudgetOfMesh, many_triangles_across_everything) {
  GeneratedMesh<float> mesh;
  for (std::size_t i = 0; i < 20'000; ++i) {
    const float height = random_.symmetric<float>();
    mesh.add({{-9, -9, height}, {9, -9, -height}, {0, 9, height}});
  }
  expect_built_quickly(mesh);
}

TEST_F(GridBudgetOfMesh, many_copies_of_one_point) {
  GeneratedMesh<float> mesh;
  for (std::size_t i = 0; i < 100'000; ++i) mesh.add({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}});
  expect_built_quickly(mesh);
}

/// Every triangle covers half of the cells, so that not all that are asked for fit; the grid comes there by halving.
TEST_F(GridBudget, of_entries_is_used) {
  GeneratedMesh<float> mesh;
  const std::size_t count = std::size_t{1} << 14;
  for (std::size_t i = 0; i < count; ++i) mesh.add({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  const Grid grid = grid_of(mesh, {.resolution = {200, 200, 1}});
  expect_within_budget(grid, count);
  EXPECT_GE(grid.entry_count(), count * 4) << "no coarser than it has to be";
}

}  // namespace
}  // namespace surehit::test::grid_budget_test
