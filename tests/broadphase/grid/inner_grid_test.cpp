#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <set>
#include <span>
#include <vector>

#include "grid/grid.hpp"
#include "support/exact_cells.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/listing_slack.hpp"
#include "support/scalars.hpp"

namespace surehit::test::inner_grid_test {
namespace {

/// Grids of meshes with small parts of many triangles.
template <typename Scalar>
class InnerGrid : public testing::Test {
 protected:
  static constexpr std::size_t prop_triangles = 300;

  static Grid grid_of(const GeneratedMesh<Scalar>& mesh, const GridOptions& options = {.crowded = 30}) {
    return Grid(mesh.view(), box_of(mesh.view()), options);
  }

  /// Returns a prop that is `ratio` times smaller than the level around it.
  GeneratedMesh<Scalar> prop(Scalar ratio, const Vector3<Scalar>& offset) {
    return placed<Scalar>(scattered_triangles<Scalar>(prop_triangles, Scalar{0.2F}, random_), 1 / ratio, offset);
  }
  GeneratedMesh<Scalar> level() { return rough_ground<Scalar>(6, Scalar{0.3F}, random_); }

  /// Every triangle of a frame is listed where it comes as near as a path may be wrong, and nowhere where it is far.
  static void expect_complete_and_tight(const GeneratedMesh<Scalar>& mesh, const Grid& grid, const GridFrame& frame,
                                        const std::set<std::uint32_t>& expected) {
    constexpr double error_of_paths = 16 * 0x1p-24;
    const LeafCells leaves(grid, frame);
    std::vector<std::vector<std::size_t>> leaves_of(mesh.triangles.size());
    for (std::size_t leaf = 0; leaf < leaves.size(); ++leaf) {
      if (leaves[leaf].word.is_empty()) continue;
      const std::vector<std::uint32_t> ids = triangles_in(grid, leaves[leaf].word);
      for (const std::uint32_t id : ids) leaves_of.at(id).push_back(leaf);
      if (leaves[leaf].word.has_inner_grid()) {
        const GridFrame& inner = grid.inner_frame(leaves[leaf].word);
        std::set<std::uint32_t> inner_ids;
        for (const LeafCell& cell : LeafCells(grid, inner)) {
          if (cell.word.is_empty()) continue;
          const std::vector<std::uint32_t> some = triangles_in(grid, cell.word);
          inner_ids.insert(some.begin(), some.end());
        }
        for (const std::uint32_t id : grid.triangles(leaves[leaf].word)) EXPECT_EQ(inner_ids.count(id), 0U) << id;
        expect_complete_and_tight(mesh, grid, inner, inner_ids);
      }
    }
    const double size = std::max({frame.resolution(0), frame.resolution(1), frame.resolution(2)});
    for (std::uint32_t id = 0; id < mesh.triangles.size(); ++id) {
      const auto& listed = leaves_of[id];
      EXPECT_EQ(listed.empty(), expected.count(id) == 0) << id;
      if (listed.empty()) continue;
      const ExactPolygon polygon = in_frame(frame, mesh.view().triangle(id));
      const auto must = leaves.met_by(polygon, growth_by(frame, error_of_paths));
      const auto may = leaves.met_by(polygon, growth_by(frame, GridFrame::padding_share, listing_slack(polygon, size)));
      EXPECT_FALSE(must.empty()) << id;
      EXPECT_TRUE(std::includes(listed.begin(), listed.end(), must.begin(), must.end())) << id << " is missing";
      EXPECT_TRUE(std::includes(may.begin(), may.end(), listed.begin(), listed.end())) << id << " is too often";
    }
  }

  static void expect_complete_and_tight(const GeneratedMesh<Scalar>& mesh, const Grid& grid) {
    std::set<std::uint32_t> all;
    for (std::uint32_t id = 0; id < mesh.triangles.size(); ++id) all.insert(all.end(), id);
    expect_complete_and_tight(mesh, grid, grid.frame(), all);
  }

  /// Every inner grid belongs to one cell and is not empty. Every list belongs to one cell.
  static void expect_well_formed(const Grid& grid) {
    std::vector<const GridFrame*> frames = {&grid.frame()};
    std::set<std::uint32_t> lists;
    std::size_t entries = 0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      bool is_empty = true;
      for (const LeafCell& leaf : LeafCells(grid, *frames[i])) {
        if (leaf.word.is_empty()) continue;
        is_empty = false;
        EXPECT_TRUE(lists.insert(leaf.word.list()).second);
        entries += grid.triangles(leaf.word).size();
        if (!leaf.word.has_inner_grid()) {
          EXPECT_FALSE(grid.triangles(leaf.word).empty());
          continue;
        }
        EXPECT_TRUE(lists.insert(leaf.word.list() + 1).second);
        frames.push_back(&grid.inner_frame(leaf.word));
      }
      EXPECT_FALSE(is_empty);
    }
    EXPECT_EQ(entries, grid.entry_count());
    EXPECT_EQ(lists.size() + 1, grid.lists().size());
    EXPECT_EQ(frames.size(), grid.inner_frames().size() + 1);
    EXPECT_EQ(std::set(frames.begin(), frames.end()).size(), frames.size());
  }

  static std::size_t max_listed(const Grid& grid, const GridFrame& frame) {
    std::size_t most = 0;
    for (const LeafCell& leaf : LeafCells(grid, frame)) {
      if (!leaf.word.is_empty()) most = std::max(most, grid.triangles(leaf.word).size());
    }
    return most;
  }

  static std::size_t depth_of(const Grid& grid, const GridFrame& frame) {
    std::size_t depth = 0;
    for (const LeafCell& leaf : LeafCells(grid, frame)) {
      if (leaf.word.is_empty() || !leaf.word.has_inner_grid()) continue;
      depth = std::max(depth, 1 + depth_of(grid, grid.inner_frame(leaf.word)));
    }
    return depth;
  }

  Random random_{20261125};
};
TYPED_TEST_SUITE(InnerGrid, Scalars, ScalarNames);

TYPED_TEST(InnerGrid, holds_what_is_much_smaller_than_a_cell) {
  for (const double ratio : {1e3, 1e6}) {
    SCOPED_TRACE(ratio);
    auto mesh = this->level();
    const Grid even = this->grid_of(mesh);
    EXPECT_TRUE(even.inner_frames().empty());
    mesh = joined(mesh, this->prop(static_cast<TypeParam>(ratio), {TypeParam{0.31F}, TypeParam{0.27F}, 0}));
    const Grid grid = this->grid_of(mesh);
    EXPECT_EQ(grid.inner_frames().size(), 1U);
    EXPECT_LE(this->max_listed(grid, grid.frame()), 30U);
    for (const GridFrame& frame : grid.inner_frames()) EXPECT_LE(this->max_listed(grid, frame), 60U);
    this->expect_well_formed(grid);
    this->expect_complete_and_tight(mesh, grid);
  }
}

TYPED_TEST(InnerGrid, belongs_to_each_cell_that_its_triangles_touch) {
  const auto mesh = joined(this->level(), this->prop(1000, {0, 0, 0}));
  const GridOptions options = {.resolution = {2, 2, 2}, .crowded = 12};
  const Grid grid = this->grid_of(mesh, options);
  EXPECT_GT(grid.inner_frames().size(), 1U);
  this->expect_well_formed(grid);
  this->expect_complete_and_tight(mesh, grid);
}

/// Cubes of unit squares, with the middle of their box at the origin. A plane between cells goes through it where their
/// number is even. So triangles on both sides end there, without any rounding, and are listed on both.
TYPED_TEST(InnerGrid, lists_what_ends_at_its_planes) {
  const auto level = placed<TypeParam>(this->level(), 1, {TypeParam{-0.31F}, TypeParam{-0.27F}, TypeParam{-0.1F}});
  for (const std::uint32_t size : {6U, 8U, 10U, 12U}) {
    SCOPED_TRACE(size);
    const TypeParam edge = TypeParam{1e-5F};
    const Vector3<TypeParam> corner = Vector3<TypeParam>::Constant(-edge * static_cast<TypeParam>(size / 2));
    const auto mesh = joined(level, placed<TypeParam>(lattice_cube<TypeParam>(size), edge, corner));
    const Grid grid = this->grid_of(mesh);
    EXPECT_EQ(grid.inner_frames().size(), 1U);
    this->expect_well_formed(grid);
    this->expect_complete_and_tight(mesh, grid);
  }
}

TYPED_TEST(InnerGrid, lies_in_inner_grids) {
  const auto mesh = joined(joined(this->level(), this->prop(1e3F, {TypeParam{0.31F}, TypeParam{0.27F}, 0})),
                           this->prop(1e6F, {TypeParam{0.3101F}, TypeParam{0.2703F}, TypeParam{1e-4F}}));
  const Grid grid = this->grid_of(mesh);
  EXPECT_GE(this->depth_of(grid, grid.frame()), 2U);
  this->expect_well_formed(grid);
  this->expect_complete_and_tight(mesh, grid);
}

TYPED_TEST(InnerGrid, is_not_deeper_than_queries_go) {
  GeneratedMesh<TypeParam> mesh;
  for (TypeParam ratio = 1; ratio < 1e18F; ratio *= 1000) mesh = joined(mesh, this->prop(ratio, {0, 0, 0}));
  const Grid grid = this->grid_of(mesh);
  EXPECT_EQ(this->depth_of(grid, grid.frame()), Grid::max_depth);
  this->expect_well_formed(grid);
}

/// A grid within the grid would have the same lists again.
TYPED_TEST(InnerGrid, is_much_smaller_than_the_grid_around_it) {
  GeneratedMesh<TypeParam> points;
  for (int i = 0; i < 10'000; ++i) points.add({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}});
  EXPECT_TRUE(this->grid_of(points).inner_frames().empty());
  // One cell lists all, and is not divided.
  const auto scattered = scattered_triangles<TypeParam>(10'000, TypeParam{0.05F}, this->random_);
  const Grid one_cell = this->grid_of(scattered, {.resolution = {1, 1, 1}, .crowded = 100});
  EXPECT_TRUE(one_cell.top()[0].is_divided());
  this->expect_well_formed(one_cell);
}

TYPED_TEST(InnerGrid, takes_a_stray_triangle_for_what_it_is) {
  for (const double distance : {1e3, 1e5, 1e9, 1e30}) {
    SCOPED_TRACE(distance);
    GeneratedMesh<TypeParam> mesh = rough_ground<TypeParam>(20, TypeParam{0.3F}, this->random_);
    const auto far = static_cast<TypeParam>(distance);
    mesh.add({{far, far, far}, {far * TypeParam{1.5F}, far, far}, {far, far * TypeParam{1.5F}, far}});
    const Grid grid = this->grid_of(mesh, {});
    ASSERT_EQ(grid.inner_frames().size(), 1U);
    EXPECT_LE(this->max_listed(grid, grid.inner_frames().front()), 40U);
    EXPECT_LE(this->max_listed(grid, grid.frame()), 1U);
    this->expect_well_formed(grid);
  }
}

TYPED_TEST(InnerGrid, takes_linear_memory_however_many_there_are) {
  auto mesh = this->level();
  for (int i = 0; i < 100; ++i) {
    const auto at = [&] { return this->random_.template symmetric<TypeParam>(); };
    mesh = joined(mesh, this->prop(1e4F, {at(), at(), 0}));
  }
  const Grid grid = this->grid_of(mesh);
  EXPECT_GE(grid.inner_frames().size(), 90U);
  EXPECT_LE(grid.entry_count(), 16 * mesh.triangles.size());
  EXPECT_LE(grid.cell_count(), 16 * mesh.triangles.size());
  this->expect_well_formed(grid);
}

}  // namespace
}  // namespace surehit::test::inner_grid_test
