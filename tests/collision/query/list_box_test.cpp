#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include "mesh/mesh_blocks.hpp"
#include "support/box_sides.hpp"
#include "support/case_count.hpp"
#include "support/exact_cells.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/instruction_sets.hpp"
#include "support/pair_text.hpp"
#include "support/path_drawer.hpp"
#include "support/scalars.hpp"
#include "surehit/collider.hpp"

namespace surehit::test::list_box_test {
namespace {

/// A path's candidates are the lists of those cells in whose boxes it is, and there in their slabs, if lists have any;
/// and maybe of some that it nearly touches: for a path alone and for one in a lane. No triangle takes part, so that
/// every walk goes to its end.
template <typename Scalar>
class ListBox : public testing::Test {
 protected:
  struct Bounds {
    std::uint64_t least = 0;
    std::uint64_t most = 0;
  };

  static Bounds candidates_of(const Grid& grid, const MeshBlocks<Scalar>& blocks, const LeafCells& leaves,
                              const Path<Scalar>& path) {
    const double first = path.has_start() ? 0 : -infinity;
    const double last = path.has_end() ? 1 : infinity;
    Bounds bounds;
    for (const LeafCell& leaf : leaves) {
      if (leaf.word.is_empty()) continue;
      const std::size_t listed = grid.triangles(leaf.word).size();
      const ExactBox box = leaf.listed_box(grid);
      const ExactSlab slab = leaf.placed(blocks.has_slabs() ? blocks.slab(leaf.word) : CellSlab());
      const auto is_in = [&](const Growth& growth) {
        return meets_part_in_slab(grid.frame(), path, first, last, box.grown(growth), slab.grown(growth));
      };
      const bool is_near = is_in(growth_by(grid.frame(), 2 * GridFrame::padding_share));
      bounds.most += is_near ? listed : 0;
      bounds.least += is_near && is_in({}) ? listed : 0;
    }
    return bounds;
  }

  template <typename AnyPath>
  void expect_within(const Collider<Scalar>& any_collider, const std::vector<AnyPath>& paths,
                     const std::vector<Bounds>& bounds) {
    const QueryOptions<Scalar> nothing = {.mask = 0};
    for (const std::int64_t target : instruction_sets()) {
      const ForcedInstructionSet forced(target);
      const Collider<Scalar> collider(any_collider);  // A copy chooses its instruction set again.
      SCOPED_TRACE(name_of_instruction_set(target));
      for (std::size_t i = 0; i < paths.size(); ++i) {
        SCOPED_TRACE(hex_text(Path<Scalar>(paths[i])));
        QueryStatistics single;
        EXPECT_FALSE(collider.first_hit(paths[i], nothing, &single));
        expect_between(single, bounds[i]);
        // A long path is cut into pieces here, and a list where two of them meet counts twice.
        QueryStatistics in_pieces;
        EXPECT_FALSE(collider.any_hit(paths[i], nothing, &in_pieces));
        EXPECT_GE(in_pieces.candidates, bounds[i].least);
        QueryStatistics in_lane;
        Hit<Scalar> hit;
        collider.first_hits(std::span(&paths[i], 1), std::span(&hit, 1), {.options = nothing, .statistics = &in_lane});
        EXPECT_EQ(hit.triangle, no_triangle);
        expect_between(in_lane, bounds[i]);
      }
      Bounds of_all;
      for (const Bounds& of_one : bounds) {
        of_all.least += of_one.least;
        of_all.most += of_one.most;
      }
      QueryStatistics batch;
      std::vector<Hit<Scalar>> hits(paths.size());
      collider.first_hits(paths, hits, {.options = nothing, .statistics = &batch});
      expect_between(batch, of_all);
    }
  }

  static void expect_between(const QueryStatistics& statistics, const Bounds& bounds) {
    EXPECT_GE(statistics.candidates, bounds.least);
    EXPECT_LE(statistics.candidates, bounds.most);
  }

  /// Paths of every kind, of all octants and along the axes.
  void scan(const GeneratedMesh<Scalar>& mesh, const GridOptions& options, std::size_t paths) {
    const Collider<Scalar> collider(mesh.view(), BuildOptions{options, {}});
    const Grid grid(mesh.view(), box_of(mesh.view()), options);
    const MeshBlocks<Scalar> blocks(mesh.view(), grid);
    has_slabs_ = blocks.has_slabs();
    const LeafCells leaves(grid);
    PathDrawer<Scalar> drawer(mesh.view(), 7);
    std::vector<Segment<Scalar>> segments;
    std::vector<Line<Scalar>> lines;
    std::vector<Bounds> of_segments;
    std::vector<Bounds> of_lines;
    for (std::size_t i = case_count(paths); i > 0; --i) {
      Path<Scalar> path = drawer.random().one_in(3) ? drawer.draw_axis_parallel() : drawer.draw();
      if (drawer.random().one_in(3)) {
        path = Segment<Scalar>{drawer.point_around_mesh(), mesh.vertices[drawer.random().below(mesh.vertices.size())]};
      }
      if (path.has_end()) {
        segments.push_back({path.start, path.toward});
        of_segments.push_back(candidates_of(grid, blocks, leaves, path));
        passed_by_ += of_segments.back().most == 0 ? 1 : 0;
        met_ += of_segments.back().least != 0 ? 1 : 0;
      } else {
        lines.push_back({path.start, path.toward});
        of_lines.push_back(candidates_of(grid, blocks, leaves, Path<Scalar>(lines.back())));
      }
    }
    expect_within(collider, segments, of_segments);
    expect_within(collider, lines, of_lines);
  }

  static constexpr double infinity = std::numeric_limits<double>::infinity();
  bool has_slabs_ = false;
  std::size_t passed_by_ = 0;
  std::size_t met_ = 0;
};
TYPED_TEST_SUITE(ListBox, Scalars, ScalarNames);

TYPED_TEST(ListBox, is_met_by_paths_that_pass_through_it) {
  Random random(91);
  const auto small = scattered_triangles<TypeParam>(60, 0.05F, random);
  this->scan(small, {.resolution = {5, 4, 6}, .crowded = 0}, 300);
  this->scan(small, {.resolution = {2, 1, 2}, .crowded = 3}, 300);
  this->scan(flattened<TypeParam>(small, 2, TypeParam{3}), {.resolution = {5, 4, 6}, .crowded = 3}, 100);
  this->scan(placed<TypeParam>(small, 100, {1e5F, -1e5F, 1e5F}), {.resolution = {3, 4, 2}, .crowded = 3}, 100);
  for (const GridOptions& options :
       {GridOptions{.resolution = {9, 7, 11}, .crowded = 0}, GridOptions{.resolution = {5, 6, 4}, .crowded = 2}}) {
    this->scan(triangles_on_box_sides<TypeParam>(60, options, random), options, 1000);
  }
  EXPECT_GT(this->passed_by_, 0U);
  EXPECT_GT(this->met_, 0U);
}

TYPED_TEST(ListBox, and_slab_are_met_by_paths_that_pass_through_them) {
  constexpr bool has_slabs = std::is_same_v<TypeParam, float>;
  const auto bowl = smooth_bowl<TypeParam>(9);
  for (const GridOptions& options : {GridOptions{.resolution = {6, 5, 8}, .crowded = 0},
                                     GridOptions{.resolution = {3, 4, 2}, .crowded = 7}, GridOptions{}}) {
    this->scan(bowl, options, 300);
    EXPECT_EQ(this->has_slabs_, has_slabs);
    this->scan(placed<TypeParam>(bowl, 100, {1e5F, -1e5F, 1e5F}), options, 100);
    EXPECT_EQ(this->has_slabs_, has_slabs);
  }
  EXPECT_GT(this->met_, 0U);
}

}  // namespace
}  // namespace surehit::test::list_box_test
