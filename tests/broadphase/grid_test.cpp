#include "surehit/grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "support/exact_cells.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/scalars.hpp"

namespace surehit::test {
namespace {

template <typename Scalar>
class GridTest : public testing::Test {
 protected:
  static Grid grid_of(const GeneratedMesh<Scalar>& mesh, const GridOptions& options = {}) {
    return Grid(mesh.view(), box_of(mesh.view()), options);
  }

  /// Every triangle is listed where it comes as near as a path may be wrong, and nowhere where it is far.
  static void expect_complete_and_tight(const GeneratedMesh<Scalar>& mesh, const GridOptions& options) {
    constexpr double error_of_paths = 0x1p-33;
    constexpr double rounding = 0x1p-45;
    const Grid grid = grid_of(mesh, options);
    std::vector<std::vector<std::size_t>> cells_of(mesh.triangles.size());
    for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
      for (const std::uint32_t triangle : grid.triangles(cell)) cells_of.at(triangle).push_back(cell);
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const ExactPolygon polygon = in_frame(grid.frame(), mesh.view().triangle(i));
      const auto must = cells_met(grid.frame(), polygon, error_of_paths);
      const auto may = cells_met(grid.frame(), polygon, GridFrame::padding + rounding);
      EXPECT_FALSE(must.empty()) << i;
      EXPECT_TRUE(std::includes(cells_of[i].begin(), cells_of[i].end(), must.begin(), must.end()))
          << i << " is missing";
      EXPECT_TRUE(std::includes(may.begin(), may.end(), cells_of[i].begin(), cells_of[i].end()))
          << i << " is too often";
    }
  }

  static void expect_ascending(const Grid& grid) {
    std::size_t entries = 0;
    for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
      const auto triangles = grid.triangles(cell);
      entries += triangles.size();
      EXPECT_EQ(std::adjacent_find(triangles.begin(), triangles.end(), std::greater_equal<>()), triangles.end())
          << cell;
    }
    EXPECT_EQ(entries, grid.entry_count());
  }

  static constexpr std::uint32_t absurd = std::numeric_limits<std::uint32_t>::max();
  Random random_{20240229};
};
TYPED_TEST_SUITE(GridTest, Scalars, ScalarNames);

TYPED_TEST(GridTest, ByDefaultAndWithoutTrianglesHasNoCells) {
  EXPECT_EQ(Grid().cell_count(), 0U);
  EXPECT_EQ(Grid().entry_count(), 0U);
  const Grid empty = this->grid_of({});
  EXPECT_EQ(empty.cell_count(), 0U);
  EXPECT_EQ(empty.entry_count(), 0U);
}

TYPED_TEST(GridTest, ListsEachTriangleWhereItIs) {
  const auto triangles = scattered_triangles<TypeParam>(100, 0.5F, this->random_);
  const GridOptions odd = {.resolution = {6, 5, 7}};
  this->expect_complete_and_tight(triangles, {});
  this->expect_complete_and_tight(triangles, odd);
  this->expect_complete_and_tight(line_of_needles<TypeParam>(100, this->random_), {.resolution = {20, 5, 5}});
  this->expect_complete_and_tight(lattice_cube<TypeParam>(4), {.resolution = {4, 4, 4}});
  this->expect_complete_and_tight(flattened<TypeParam>(triangles, 1, 7), odd);
}

TYPED_TEST(GridTest, ListsEachTriangleWhereItIsAtEveryScale) {
  const auto triangles = scattered_triangles<TypeParam>(100, 0.5F, this->random_);
  const GridOptions odd = {.resolution = {6, 5, 7}};
  constexpr TypeParam huge = std::numeric_limits<TypeParam>::max() / 2;
  constexpr TypeParam least = std::numeric_limits<TypeParam>::denorm_min();
  this->expect_complete_and_tight(placed<TypeParam>(triangles, huge, {0, 0, 0}), odd);
  this->expect_complete_and_tight(placed<TypeParam>(triangles, 100 * least, {0, 0, 0}), odd);
  this->expect_complete_and_tight(placed<TypeParam>(triangles, 1, {1e7F, -1e7F, 1e30F}), odd);
  this->expect_complete_and_tight(placed<TypeParam>(triangles, least, {0, 0, 0}), odd);
}

TYPED_TEST(GridTest, ListsAscendAndAddUp) {
  this->expect_ascending(this->grid_of(scattered_triangles<TypeParam>(1000, 0.5F, this->random_)));
  this->expect_ascending(this->grid_of(line_of_needles<TypeParam>(300, this->random_), {.resolution = {50, 1, 9}}));
}

TYPED_TEST(GridTest, CountsItsCellsXFirst) {
  const Grid grid = this->grid_of(lattice_cube<TypeParam>(4), {.resolution = {2, 3, 4}});
  EXPECT_EQ(grid.resolution(), (std::array<std::uint32_t, 3>{2, 3, 4}));
  EXPECT_EQ(grid.cell_count(), 24U);
  std::size_t next = 0;
  for (std::uint32_t z = 0; z < 4; ++z) {
    for (std::uint32_t y = 0; y < 3; ++y) {
      for (std::uint32_t x = 0; x < 2; ++x) EXPECT_EQ(grid.cell_index({x, y, z}), next++);
    }
  }
}

TYPED_TEST(GridTest, AimsAtTheWishedNumberOfCubicCells) {
  auto triangles = scattered_triangles<TypeParam>(1000, 0.1F, this->random_);
  for (auto& vertex : triangles.vertices) vertex[0] *= 4;
  for (const double wish : {0.25, 2.0, 8.0}) {
    const Grid grid = this->grid_of(triangles, {.cells_per_triangle = wish});
    const double cells = static_cast<double>(grid.cell_count());
    EXPECT_LE(cells, wish * 1000);
    EXPECT_GE(cells, wish * 1000 / 2);
    const auto& size = grid.frame().cell_size;
    EXPECT_LT(*std::max_element(size.begin(), size.end()), 1.5 * *std::min_element(size.begin(), size.end()));
  }
}

TYPED_TEST(GridTest, DividesFlatMeshesAlongTheirPlane) {
  const auto triangles = scattered_triangles<TypeParam>(1000, 0.1F, this->random_);
  for (const int axis : {0, 1, 2}) {
    const Grid grid = this->grid_of(flattened<TypeParam>(triangles, axis, 3));
    EXPECT_EQ(grid.resolution()[static_cast<std::size_t>(axis)], 1U);
    EXPECT_GE(grid.cell_count(), 1000U);
    EXPECT_LE(grid.cell_count(), 2000U);
  }
}

TYPED_TEST(GridTest, LeavesAxesOfResolutionZeroToItself) {
  const auto triangles = scattered_triangles<TypeParam>(1000, 0.1F, this->random_);
  const Grid grid = this->grid_of(triangles, {.resolution = {0, 40, 0}});
  const Grid own = this->grid_of(triangles);
  EXPECT_EQ(grid.resolution(), (std::array<std::uint32_t, 3>{own.resolution()[0], 40, own.resolution()[2]}));
}

TYPED_TEST(GridTest, KeepsItsBudgetOfCells) {
  const auto triangles = scattered_triangles<TypeParam>(10, 0.1F, this->random_);
  constexpr std::uint32_t absurd = std::numeric_limits<std::uint32_t>::max();
  for (const GridOptions& options :
       {GridOptions{.resolution = {absurd, absurd, absurd}}, GridOptions{.resolution = {absurd, 1, absurd}},
        GridOptions{.cells_per_triangle = std::numeric_limits<double>::infinity()}}) {
    const Grid grid = this->grid_of(triangles, options);
    EXPECT_LE(grid.cell_count(), std::size_t{1} << 24);
    EXPECT_GE(grid.cell_count(), std::size_t{1} << 20) << "it is made coarser, not coarse";
    for (const std::uint32_t cells : grid.resolution()) EXPECT_LE(cells, std::uint32_t{1} << 20);
  }
  EXPECT_EQ(this->grid_of(triangles, {.resolution = {absurd, 1, 1}}).resolution()[0], std::uint32_t{1} << 20);
}

TYPED_TEST(GridTest, TakesNonsenseForOneCell) {
  const auto triangles = scattered_triangles<TypeParam>(10, 0.1F, this->random_);
  for (const double nonsense : {-1.0, 0.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_EQ(this->grid_of(triangles, {.cells_per_triangle = nonsense}).cell_count(), 1U);
  }
}

/// Every triangle covers half of the cells, so that no more than some 2^11 of these fit; the grid comes there by
/// halving.
TYPED_TEST(GridTest, KeepsItsBudgetOfEntries) {
  GeneratedMesh<TypeParam> mesh;
  for (std::size_t i = 0; i < std::size_t{1} << 14; ++i) mesh.add({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  const Grid grid = this->grid_of(mesh, {.resolution = {200, 200, 1}});
  EXPECT_LE(grid.entry_count(), std::size_t{1} << 24);
  EXPECT_GE(grid.entry_count(), std::size_t{1} << 20) << "no coarser than it has to be";
  this->expect_ascending(grid);
}

TYPED_TEST(GridTest, TellsItsMemory) {
  const Grid grid = this->grid_of(scattered_triangles<TypeParam>(1000, 0.1F, this->random_));
  EXPECT_GE(grid.memory_bytes(), (grid.cell_count() + grid.entry_count()) * sizeof(std::uint32_t));
  EXPECT_LE(grid.memory_bytes(), 4 * (grid.cell_count() + grid.entry_count()) * sizeof(std::uint32_t));
}

}  // namespace
}  // namespace surehit::test
