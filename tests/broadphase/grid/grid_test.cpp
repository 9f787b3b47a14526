#include "grid/grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <set>
#include <vector>

#include "support/exact_cells.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/listing_slack.hpp"
#include "support/scalars.hpp"

namespace surehit::test::grid_test {
namespace {

template <typename Scalar>
class GridTest : public testing::Test {
 protected:
  static Grid grid_of(const GeneratedMesh<Scalar>& mesh, const GridOptions& options = {}) {
    return Grid(mesh.view(), box_of(mesh.view()), options);
  }

  /// Every triangle is listed where it comes as near as a path may be wrong, and nowhere where it is far.
  static void expect_complete_and_tight(const GeneratedMesh<Scalar>& mesh, const GridOptions& options) {
    constexpr double error_of_paths = 16 * 0x1p-24;
    const Grid grid = grid_of(mesh, options);
    const GridFrame& frame = grid.frame();
    const LeafCells leaves(grid);
    std::vector<std::vector<std::size_t>> leaves_of(mesh.triangles.size());
    for (std::size_t leaf = 0; leaf < leaves.size(); ++leaf) {
      if (leaves[leaf].word.is_empty()) continue;
      for (const std::uint32_t triangle : grid.triangles(leaves[leaf].word)) {
        std::vector<std::size_t>& listing = leaves_of.at(triangle);
        if (listing.empty() || listing.back() != leaf) listing.push_back(leaf);
      }
    }
    const double size = std::max({frame.resolution(0), frame.resolution(1), frame.resolution(2)});
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const ExactPolygon polygon = in_frame(frame, mesh.view().triangle(i));
      const auto must = leaves.met_by(polygon, growth_by(frame, error_of_paths));
      const auto may = leaves.met_by(polygon, growth_by(frame, GridFrame::padding_share, listing_slack(polygon, size)));
      const auto& listed = leaves_of[i];
      EXPECT_FALSE(must.empty()) << i;
      EXPECT_TRUE(std::includes(listed.begin(), listed.end(), must.begin(), must.end())) << i << " is missing";
      EXPECT_TRUE(std::includes(may.begin(), may.end(), listed.begin(), listed.end())) << i << " is too often";
    }
  }

  /// What a list's triangles have within reach of a path that goes through the cell lies in the list's box, as far as
  /// such a path may be wrong; and the box is no larger than rounding to its parts makes it.
  static void expect_boxed(const GeneratedMesh<Scalar>& mesh, const GridOptions& options) {
    const Grid grid = grid_of(mesh, options);
    const GridFrame& frame = grid.frame();
    const Growth error_of_paths = growth_by(frame, 16 * 0x1p-24);
    const LeafCells leaves(grid);
    for (const LeafCell& leaf : leaves) {
      if (leaf.word.is_empty()) continue;
      const ExactBox box = leaf.listed_box(grid).grown(error_of_paths);
      ExactBox taken = {leaf.box().high, leaf.box().low};
      for (const std::uint32_t id : grid.triangles(leaf.word)) {
        const ExactPolygon polygon = in_frame(frame, mesh.view().triangle(id));
        for (const ExactPoint& corner : part_in(leaf.box().grown(error_of_paths), polygon)) {
          for (std::size_t axis = 0; axis < 3; ++axis) {
            EXPECT_LE(box.low[axis], corner[axis]) << id << " on axis " << axis;
            EXPECT_GE(box.high[axis], corner[axis]) << id << " on axis " << axis;
          }
        }
        for (const ExactPoint& corner : polygon) {
          for (std::size_t axis = 0; axis < 3; ++axis) {
            taken.low[axis] = std::min(taken.low[axis], corner[axis]);
            taken.high[axis] = std::max(taken.high[axis], corner[axis]);
          }
        }
      }
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const CellBox parts = grid.box(leaf.word);
        const mpq_class part(leaf.size / double{CellBox::parts});
        const mpq_class slack(2 * frame.padding(axis));
        EXPECT_LT(parts.low(axis), parts.high(axis));
        EXPECT_TRUE(parts.low(axis) + 1 == CellBox::parts ||
                    leaf.low[axis] + (parts.low(axis) + 1) * part + slack > taken.low[axis]);
        EXPECT_TRUE(parts.high(axis) == 1 || leaf.low[axis] + (parts.high(axis) - 1) * part - slack < taken.high[axis]);
      }
    }
  }

  /// Ids rise; the lists take up all entries, one behind the other.
  static void expect_well_formed(const Grid& grid) {
    std::size_t entries = 0;
    std::set<std::uint32_t> numbers;
    for (const LeafCell& leaf : LeafCells(grid)) {
      if (leaf.word.is_empty()) continue;
      const auto ids = grid.triangles(leaf.word);
      ASSERT_FALSE(ids.empty());
      EXPECT_EQ(std::adjacent_find(ids.begin(), ids.end(), std::greater_equal<>()), ids.end());
      EXPECT_TRUE(numbers.insert(leaf.word.list()).second);
      entries += ids.size();
    }
    EXPECT_EQ(entries, grid.entry_count());
    ASSERT_EQ(numbers.size() + 1, grid.lists().size());
    ASSERT_FALSE(numbers.empty());
    EXPECT_EQ(*numbers.rbegin() + 1, numbers.size());
    EXPECT_EQ(grid.lists().back().first_entry, grid.entry_count());
  }

  static std::size_t max_listed(const Grid& grid) {
    std::size_t most = 0;
    for (const LeafCell& leaf : LeafCells(grid)) {
      if (!leaf.word.is_empty()) most = std::max(most, grid.triangles(leaf.word).size());
    }
    return most;
  }

  static GridOptions odd(std::uint32_t crowded = 96) { return {.resolution = {6, 5, 7}, .crowded = crowded}; }

  Random random_{20240229};
};
TYPED_TEST_SUITE(GridTest, Scalars, ScalarNames);

TYPED_TEST(GridTest, by_default_and_without_triangles_has_no_cells) {
  for (const Grid& grid : {Grid(), this->grid_of({})}) {
    EXPECT_TRUE(grid.is_empty());
    EXPECT_EQ(grid.cell_count(), 0U);
    EXPECT_EQ(grid.entry_count(), 0U);
    EXPECT_EQ(grid.levels(), 0U);
  }
}

TYPED_TEST(GridTest, lists_each_triangle_where_it_is) {
  const auto triangles = scattered_triangles<TypeParam>(100, 0.5F, this->random_);
  this->expect_complete_and_tight(triangles, {});
  this->expect_complete_and_tight(triangles, this->odd());
  this->expect_complete_and_tight(line_of_needles<TypeParam>(100, this->random_), {.resolution = {20, 5, 5}});
  this->expect_complete_and_tight(lattice_cube<TypeParam>(4), {.resolution = {4, 4, 4}});
  this->expect_complete_and_tight(flattened<TypeParam>(triangles, 1, 7), this->odd());
}

TYPED_TEST(GridTest, lists_each_triangle_where_it_is_in_divided_cells) {
  const GridOptions divided = {.resolution = {2, 1, 1}, .crowded = 1};
  const auto small = scattered_triangles<TypeParam>(60, 0.05F, this->random_);
  ASSERT_EQ(this->grid_of(small, divided).levels(), Grid::max_levels);
  this->expect_complete_and_tight(small, divided);
  this->expect_complete_and_tight(small, this->odd(3));
  this->expect_complete_and_tight(rough_ground<TypeParam>(6, 0.2F, this->random_), divided);
  this->expect_complete_and_tight(lattice_cube<TypeParam>(4), divided);
  this->expect_complete_and_tight(flattened<TypeParam>(small, 2, 7), divided);
}

TYPED_TEST(GridTest, lists_each_triangle_where_it_is_at_every_scale) {
  const auto triangles = scattered_triangles<TypeParam>(100, 0.5F, this->random_);
  const auto small = scattered_triangles<TypeParam>(60, 0.05F, this->random_);
  constexpr TypeParam huge = std::numeric_limits<TypeParam>::max() / 2;
  constexpr TypeParam least = std::numeric_limits<TypeParam>::denorm_min();
  const auto expect_at = [&](TypeParam factor, const Vector3<TypeParam>& offset) {
    this->expect_complete_and_tight(placed<TypeParam>(triangles, factor, offset), this->odd());
    this->expect_complete_and_tight(placed<TypeParam>(small, factor, offset), {.resolution = {2, 1, 1}, .crowded = 2});
  };
  expect_at(huge, {0, 0, 0});
  expect_at(100 * least, {0, 0, 0});
  expect_at(1, {1e7F, -1e7F, 1e30F});
  expect_at(least, {0, 0, 0});
}

/// Points lie nowhere but where they are, so that they show where the padding ends.
TYPED_TEST(GridTest, lists_points_as_far_as_the_padding_reaches) {
  for (const std::uint32_t crowded : {0U, 20U}) {
    GeneratedMesh<TypeParam> mesh;
    const auto add_point = [&](const Vector3<TypeParam>& point) { mesh.add({point, point, point}); };
    for (const TypeParam x : {TypeParam{0}, TypeParam{1}}) add_point({x, x, x});
    const GridOptions options = {.resolution = {6, 5, 7}, .crowded = crowded};
    const GridFrame frame = this->grid_of(mesh, this->odd(0)).frame();
    for (int i = 0; i < 400; ++i) {
      Vector3<TypeParam> point;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto plane = static_cast<double>(this->random_.between(1, frame.resolution(axis) - 1));
        const double off = 2 * frame.padding(axis) * this->random_.template symmetric<double>();
        point[static_cast<Eigen::Index>(axis)] = static_cast<TypeParam>(out_of_frame(frame, axis, plane + off));
      }
      add_point(point);
    }
    const Grid grid = this->grid_of(mesh, options);
    const LeafCells leaves(grid);
    for (std::uint32_t id = 0; id < mesh.triangles.size(); ++id) {
      const ExactPolygon polygon = in_frame(grid.frame(), mesh.view().triangle(id));
      constexpr double rounding = 4 * 0x1p-24;
      const auto must = leaves.met_by(polygon, growth_by(grid.frame(), GridFrame::padding_share - rounding));
      const auto may = leaves.met_by(polygon, growth_by(grid.frame(), GridFrame::padding_share + rounding));
      for (std::size_t leaf = 0; leaf < leaves.size(); ++leaf) {
        const CellWord word = leaves[leaf].word;
        const bool is_listed = !word.is_empty() && std::ranges::count(grid.triangles(word), id) != 0;
        EXPECT_TRUE(is_listed || !std::binary_search(must.begin(), must.end(), leaf)) << id;
        EXPECT_TRUE(!is_listed || std::binary_search(may.begin(), may.end(), leaf)) << id;
      }
    }
  }
}

TYPED_TEST(GridTest, boxes_what_its_lists_take_up_of_their_cells) {
  const auto triangles = scattered_triangles<TypeParam>(100, 0.5F, this->random_);
  const auto small = scattered_triangles<TypeParam>(100, 0.05F, this->random_);
  this->expect_boxed(triangles, this->odd());
  this->expect_boxed(small, this->odd());
  this->expect_boxed(small, {.resolution = {2, 1, 1}, .crowded = 1});
  this->expect_boxed(lattice_cube<TypeParam>(4), {.resolution = {8, 8, 8}});
  this->expect_boxed(lattice_cube<TypeParam>(4), {.resolution = {2, 2, 2}, .crowded = 2});
  this->expect_boxed(line_of_needles<TypeParam>(100, this->random_), {.resolution = {20, 5, 5}});
  this->expect_boxed(flattened<TypeParam>(small, 1, 7), this->odd(3));
  this->expect_boxed(placed<TypeParam>(small, std::numeric_limits<TypeParam>::max() / 2, {0, 0, 0}), this->odd(3));
  this->expect_boxed(placed<TypeParam>(small, 64 * std::numeric_limits<TypeParam>::denorm_min(), {0, 0, 0}),
                     this->odd(3));
}

TEST(CellBox, holds_every_side) {
  const auto expect_held = [](const std::array<std::uint32_t, 3>& low, const std::array<std::uint32_t, 3>& high) {
    const CellBox box = CellBox::around(low, high);
    const CellBox same(box.bits());
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ASSERT_EQ(same.low(axis), low[axis]);
      ASSERT_EQ(same.high(axis), high[axis]);
    }
  };
  for (std::uint32_t low = 0; low < CellBox::parts; ++low) {
    for (std::uint32_t high = low + 1; high <= CellBox::parts; ++high) {
      const std::uint32_t other = (low * 7 + high) % CellBox::parts;
      expect_held({low, other, 0}, {high, other + 1, CellBox::parts});
      expect_held({other, low, CellBox::parts - 1}, {CellBox::parts, high, CellBox::parts});
      expect_held({0, other, low}, {1, CellBox::parts, high});
    }
  }
}

TEST(CellSlab, holds_every_normal_and_place) {
  const auto expect_held = [](const std::array<std::int32_t, 3>& normal, std::int32_t low, std::int32_t high) {
    const CellSlab slab = CellSlab::between(normal, low, high);
    const CellSlab same(slab.bits());
    for (std::size_t axis = 0; axis < 3; ++axis) ASSERT_EQ(same.normal(axis), normal[axis]);
    ASSERT_EQ(same.low(), low);
    ASSERT_EQ(same.high(), high);
  };
  constexpr std::int32_t longest = CellSlab::longest;
  for (std::int32_t x = -longest; x <= longest; ++x) {
    for (std::int32_t y = -longest; y <= longest; ++y) {
      expect_held({x, y, 0}, -x, y);
      expect_held({y, longest, x}, CellSlab::lowest, CellSlab::highest);
      expect_held({-longest, x, y}, CellSlab::lowest + longest + x, CellSlab::highest - longest - y);
    }
  }
  for (std::int32_t low = CellSlab::lowest; low <= CellSlab::highest; ++low) expect_held({1, -2, 3}, low, -1 - low);
}

/// And half a padding more, which is half of a sixteenth of a cell at most.
TEST(CellSlab, has_all_of_its_cell_between_its_planes_unless_it_is_given_others) {
  const CellSlab all;
  const float farthest = 3 * CellSlab::longest * (0.5F + 1.0F / 32);
  EXPECT_LE(static_cast<float>(all.low()) * CellSlab::step, -farthest);
  EXPECT_GE(static_cast<float>(all.high() + 1) * CellSlab::step, farthest);
}

TYPED_TEST(GridTest, lists_are_well_formed) {
  const auto scattered = scattered_triangles<TypeParam>(1000, 0.5F, this->random_);
  this->expect_well_formed(this->grid_of(scattered));
  this->expect_well_formed(this->grid_of(scattered, {.crowded = 1}));
  this->expect_well_formed(this->grid_of(line_of_needles<TypeParam>(300, this->random_), {.resolution = {50, 1, 9}}));
}

/// As the budget and the options force them.
TYPED_TEST(GridTest, long_lists_are_well_formed) {
  for (const std::size_t count : {119U, 1000U, 100'000U}) {
    const auto mesh = scattered_triangles<TypeParam>(count, 0.01F, this->random_);
    const Grid one_cell = this->grid_of(mesh, {.resolution = {1, 1, 1}, .crowded = 0});
    this->expect_well_formed(one_cell);
    ASSERT_EQ(one_cell.cell_count(), 1U);
    const auto ids = one_cell.triangles(one_cell.top()[0]);
    ASSERT_EQ(ids.size(), count);
    for (std::size_t i = 0; i < ids.size(); ++i) ASSERT_EQ(ids[i], i);
    const Grid few_cells = this->grid_of(mesh, {.resolution = {3, 1, 2}, .crowded = 0});
    this->expect_well_formed(few_cells);
    EXPECT_GE(this->max_listed(few_cells), count / 6);
  }
}

TYPED_TEST(GridTest, long_lists_among_short_ones_are_where_they_belong) {
  GeneratedMesh<TypeParam> mesh = scattered_triangles<TypeParam>(50, 0.3F, this->random_);
  for (int i = 0; i < 200; ++i) mesh.add({{0.5F, 0.5F, 0.5F}, {0.6F, 0.5F, 0.5F}, {0.5F, 0.6F, 0.5F}});
  this->expect_complete_and_tight(mesh, {.resolution = {4, 4, 4}});
  this->expect_well_formed(this->grid_of(mesh, {.resolution = {4, 4, 4}}));
}

TYPED_TEST(GridTest, counts_its_cells_x_first) {
  GeneratedMesh<TypeParam> mesh;
  mesh.add({{0.1F, 0.1F, 0.1F}, {0.1F, 0.1F, 0.1F}, {0.1F, 0.1F, 0.1F}});
  mesh.add({{1.9F, 0.1F, 0.1F}, {1.9F, 0.1F, 0.1F}, {1.9F, 0.1F, 0.1F}});
  mesh.add({{0.1F, 2.9F, 0.1F}, {0.1F, 2.9F, 0.1F}, {0.1F, 2.9F, 0.1F}});
  mesh.add({{0.1F, 0.1F, 3.9F}, {0.1F, 0.1F, 3.9F}, {0.1F, 0.1F, 3.9F}});
  const Grid grid = this->grid_of(mesh, {.resolution = {2, 3, 4}});
  EXPECT_EQ(grid.resolution(), (std::array<std::uint32_t, 3>{2, 3, 4}));
  ASSERT_EQ(grid.cell_count(), 24U);
  const auto only_triangle = [&](std::size_t cell) { return grid.triangles(grid.top()[cell]).front(); };
  EXPECT_EQ(only_triangle(0), 0U);
  EXPECT_EQ(only_triangle(1), 1U);
  EXPECT_EQ(only_triangle(2 * 2), 2U);
  EXPECT_EQ(only_triangle(2 * 3 * 3), 3U);
}

TYPED_TEST(GridTest, aims_at_the_wished_number_of_cubic_cells) {
  GeneratedMesh<TypeParam> triangles;
  for (const float x : {0.F, 2.F, 4.F, 6.F}) {
    const auto some = scattered_triangles<TypeParam>(250, 0.02F, this->random_);
    triangles = joined(std::move(triangles), placed<TypeParam>(some, 1, {x, 0, 0}));
  }
  for (const double wish : {0.25, 2.0, 8.0}) {
    const Grid grid = this->grid_of(triangles, {.cells_per_triangle = wish, .crowded = 0});
    const double cells = static_cast<double>(grid.cell_count());
    EXPECT_LE(cells, wish * 1000);
    EXPECT_GE(cells, wish * 1000 / 2);
    const auto& scale = grid.frame().scale;
    EXPECT_LT(*std::max_element(scale.begin(), scale.end()), 1.5 * *std::min_element(scale.begin(), scale.end()));
  }
}

TYPED_TEST(GridTest, shapes_its_cells_as_triangles_are) {
  for (const std::size_t axis : {0U, 1U, 2U}) {
    auto triangles = scattered_triangles<TypeParam>(5000, 0.02F, this->random_);
    for (auto& vertex : triangles.vertices) vertex[static_cast<Eigen::Index>(axis)] *= 3;
    const Grid grid = this->grid_of(triangles, {.crowded = 0});
    const auto& scale = grid.frame().scale;
    for (const std::size_t other : {(axis + 1) % 3, (axis + 2) % 3}) {
      EXPECT_GT(scale[other], 2.3 * scale[axis]);
      EXPECT_LT(scale[other], 3.7 * scale[axis]);
    }
  }
}

TYPED_TEST(GridTest, has_fewer_cells_where_they_would_be_narrow_for_the_triangles) {
  const auto cells_of = [&](TypeParam size) {
    return this->grid_of(scattered_triangles<TypeParam>(1000, size, this->random_), {.crowded = 0}).cell_count();
  };
  EXPECT_GT(cells_of(0.02F), 500U);
  EXPECT_LT(cells_of(0.6F), 500U);
  EXPECT_GT(cells_of(0.6F), 100U);
}

/// Whose mean extent is zero when it is rounded, though not every triangle's is.
TYPED_TEST(GridTest, divides_points_of_which_one_is_hardly_more) {
  GeneratedMesh<TypeParam> points;
  points.add({{0, 0, 0}, {std::numeric_limits<TypeParam>::denorm_min(), 0, 0}, {0, 0, 0}});
  points.add({{0.3F, 0.3F, 0.3F}, {0.3F, 0.3F, 0.3F}, {0.3F, 0.3F, 0.3F}});
  const Grid grid = this->grid_of(points, {.cells_per_triangle = 1000, .crowded = 0});
  EXPECT_GT(grid.cell_count(), 1000U);
}

TYPED_TEST(GridTest, divides_flat_meshes_along_their_plane) {
  const auto triangles = scattered_triangles<TypeParam>(1000, 0.02F, this->random_);
  for (const int axis : {0, 1, 2}) {
    const Grid grid = this->grid_of(flattened<TypeParam>(triangles, axis, 3), {.crowded = 0});
    EXPECT_EQ(grid.resolution()[static_cast<std::size_t>(axis)], 1U);
    EXPECT_GE(grid.cell_count(), 500U);
    EXPECT_LE(grid.cell_count(), 1000U);
  }
}

TYPED_TEST(GridTest, leaves_axes_of_resolution_zero_to_itself) {
  const auto triangles = scattered_triangles<TypeParam>(1000, 0.1F, this->random_);
  const Grid grid = this->grid_of(triangles, {.resolution = {0, 40, 0}});
  const Grid own = this->grid_of(triangles);
  EXPECT_EQ(grid.resolution(), (std::array<std::uint32_t, 3>{own.resolution()[0], 40, own.resolution()[2]}));
}

TYPED_TEST(GridTest, takes_nonsense_for_one_cell) {
  const auto triangles = scattered_triangles<TypeParam>(10, 0.1F, this->random_);
  for (const double nonsense : {-1.0, 0.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_EQ(this->grid_of(triangles, {.cells_per_triangle = nonsense}).cell_count(), 1U);
  }
}

TYPED_TEST(GridTest, tells_its_memory) {
  for (const std::uint32_t crowded : {0U, 4U}) {
    const Grid grid = this->grid_of(scattered_triangles<TypeParam>(1000, 0.1F, this->random_), {.crowded = crowded});
    EXPECT_GE(grid.memory_bytes(), (grid.cell_count() + grid.entry_count()) * sizeof(std::uint32_t));
    EXPECT_LE(grid.memory_bytes(), 4 * (grid.cell_count() + grid.entry_count()) * sizeof(std::uint32_t));
  }
}

/// A build does not know beforehand how long the lists of its bricks become.
TYPED_TEST(GridTest, keeps_little_room) {
  for (const std::uint32_t crowded : {0U, 4U}) {
    const Grid grid = this->grid_of(scattered_triangles<TypeParam>(20'000, 0.05F, this->random_), {.crowded = crowded});
    ASSERT_EQ(grid.levels() > 0, crowded > 0);
    const std::size_t words = grid.cell_count() + 64 + 2 * grid.lists().size();
    const std::size_t bytes = words * sizeof(std::uint32_t) + grid.entry_count() * grid.entries().width();
    EXPECT_EQ(grid.entries().width(), 2U);
    EXPECT_GE(grid.memory_bytes(), bytes);
    EXPECT_LE(grid.memory_bytes(), bytes * 33 / 32);
  }
}

}  // namespace
}  // namespace surehit::test::grid_test
