#include "filter/kernel_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "mesh/mesh_blocks.hpp"
#include "support/case_count.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/instruction_sets.hpp"
#include "support/pair_text.hpp"
#include "support/path_drawer.hpp"
#include "support/scalars.hpp"
#include "surehit/collider.hpp"
#include "walk/grid_traversal.hpp"

namespace surehit::test::kernel_path_test {
namespace {

template <typename Scalar>
class KernelPathOf : public testing::Test {
 protected:
  /// How much of what the kernel takes for the farthest corner's distance the farthest one takes up, of all lists that
  /// some paths come to.
  struct Shares {
    double of_segments = 0;
    double of_others = 0;
  };

  static Shares worst_shares(const GeneratedMesh<Scalar>& mesh, const GridOptions& options, Random& random) {
    const Grid grid(mesh.view(), box_of(mesh.view()), options);
    const MeshBlocks<Scalar> blocks(mesh.view(), grid);
    PathDrawer<Scalar> drawer(mesh.view(), random.bits());
    Shares worst;
    for (std::size_t i = case_count(1'000); i > 0; --i) {
      Path<Scalar> path = drawer.draw();
      if (path.has_end() && random.one_in(2)) {
        path.toward =
            path.start + std::ldexp(Scalar{1}, -static_cast<int>(random.below(30))) * (path.toward - path.start);
      }
      const detail::KernelPath<Scalar> kernel_path(path, grid.frame());
      const ClippedPath clipped(grid, path, path.has_start() ? 0 : -infinity, path.has_end() ? 1 : infinity);
      for (GridTraversal traversal(grid, clipped); !traversal.at_end(); traversal.advance()) {
        if (traversal.word().is_empty()) continue;
        const CellWord word = traversal.word();
        const Scalar* block = blocks.block(word.list(), grid.first_entry(word));
        const double bound = double{kernel_path.reach} + double{blocks.edge_size(block)};
        for (const std::uint32_t id : grid.triangles(word)) {
          const Eigen::Vector3d s = path.start.template cast<double>() - blocks.triangle(id).a.template cast<double>();
          double& share = path.has_end() ? worst.of_segments : worst.of_others;
          share = std::max(share, s.cwiseAbs().maxCoeff() / bound);
        }
      }
    }
    return worst;
  }

  static constexpr double infinity = std::numeric_limits<double>::infinity();
};
TYPED_TEST_SUITE(KernelPathOf, Scalars, ScalarNames);

/// What the bound leaves for roundings is far more than this.
TYPED_TEST(KernelPathOf, reaches_every_corner_of_the_lists_that_it_comes_to) {
  constexpr double roundings = 0x1p-18;
  Random random(28);
  double of_segments = 0;
  double of_others = 0;
  for (const TypeParam size : {TypeParam{1}, TypeParam{0.1F}, TypeParam{0.001F}}) {
    for (const GridOptions& options :
         {GridOptions{.resolution = {1, 1, 1}, .crowded = 0}, GridOptions{.resolution = {5, 3, 4}, .crowded = 0},
          GridOptions{.resolution = {2, 2, 3}, .crowded = 4}}) {
      for (const TypeParam offset : {TypeParam{0}, TypeParam{1000}}) {
        const auto mesh = placed<TypeParam>(scattered_triangles<TypeParam>(100, size, random), TypeParam{0.5},
                                            {offset, offset, -offset});
        const auto shares = this->worst_shares(mesh, options, random);
        EXPECT_LE(shares.of_segments, 1 + roundings);
        EXPECT_LE(shares.of_others, 1 + roundings);
        of_segments = std::max(of_segments, shares.of_segments);
        of_others = std::max(of_others, shares.of_others);
      }
    }
  }
  EXPECT_GT(of_segments, 0.8) << "there is room to waste";
  EXPECT_GT(of_others, 0.8) << "there is room to waste";
  this->RecordProperty("worst_share_of_segments", std::to_string(of_segments));
  this->RecordProperty("worst_share_of_others", std::to_string(of_others));
}

/// Its cells are as thick as they are wide, or more.
TYPED_TEST(KernelPathOf, reaches_no_farther_than_a_flat_mesh) {
  Random random(34);
  const auto ground = rough_ground<TypeParam>(40, TypeParam{0.5F}, random);
  const auto mesh = flattened<TypeParam>(placed<TypeParam>(ground, TypeParam{20}, {0, 0, 0}), 2, TypeParam{0});
  const Grid grid(mesh.view(), box_of(mesh.view()), {});
  const Path<TypeParam> path = Segment<TypeParam>{{1, 2, TypeParam{0.25F}}, {1, 2, TypeParam{-0.25F}}};
  EXPECT_LE(detail::KernelPath<TypeParam>(path, grid.frame()).reach, 2);
  const auto shares = this->worst_shares(mesh, {}, random);
  EXPECT_LE(std::max(shares.of_segments, shares.of_others), 1 + 0x1p-18);
}

TYPED_TEST(KernelPathOf, reaches_as_far_as_a_scalar_does_where_the_mesh_is_wider) {
  const TypeParam huge = std::numeric_limits<TypeParam>::max();
  GeneratedMesh<TypeParam> mesh;
  mesh.add({{-huge, -huge, -huge}, {huge, huge, huge}, {0, huge, 0}});
  const Grid grid(mesh.view(), box_of(mesh.view()), {.resolution = {1, 1, 1}});
  for (const Path<TypeParam>& path : {Path<TypeParam>(Segment<TypeParam>{{0, 0, 0}, {1, 0, 0}}),
                                      Path<TypeParam>(Ray<TypeParam>{{1, 0, 0}, {1, 0, 0}})}) {
    EXPECT_GE(detail::KernelPath<TypeParam>(path, grid.frame()).reach, huge);
  }
}

/// Lanes have the same reach as a path alone: they leave as many triangles undecided. No triangle takes part, so that
/// every walk goes to its end.
TYPED_TEST(KernelPathOf, is_the_same_in_lanes) {
  Random random(29);
  const auto mesh = scattered_triangles<TypeParam>(400, TypeParam{0.4F}, random);
  PathDrawer<TypeParam> drawer(mesh.view(), 30);
  const QueryOptions<TypeParam> nothing = {.mask = 0};
  for (const std::int64_t target : instruction_sets()) {
    const ForcedInstructionSet forced(target);
    const Collider<TypeParam> collider(mesh.view(), BuildOptions{{.resolution = {3, 3, 3}, .crowded = 0}, {}});
    SCOPED_TRACE(name_of_instruction_set(target));
    std::size_t undecided = 0;
    for (std::size_t i = case_count(2'000); i > 0; --i) {
      const auto power = [&] { return std::ldexp(TypeParam{1}, -static_cast<int>(random.below(24))); };
      const Vector3<TypeParam> start = drawer.point_on_mesh() + power() * drawer.point_around_mesh();
      const Vector3<TypeParam> way = power() * (drawer.point_on_mesh() - start);
      const auto expect_same = [&](const auto& path) {
        QueryStatistics alone;
        EXPECT_FALSE(collider.any_hit(path, nothing, &alone));
        QueryStatistics in_lane;
        constexpr std::size_t copies = 12;  // Fewer paths would be asked one by one.
        const std::vector paths(copies, path);
        std::vector<std::uint8_t> blocked(copies, 1);
        collider.any_hits(paths, blocked, {.options = nothing, .statistics = &in_lane});
        EXPECT_EQ(std::count(blocked.begin(), blocked.end(), 0), copies);
        // Where rounding lets one of them come to a list that the other misses, there is nothing to compare.
        if (copies * alone.candidates != in_lane.candidates) return;
        EXPECT_EQ(copies * alone.undecided, in_lane.undecided) << hex_text(Path<TypeParam>(path));
        undecided += alone.undecided;
      };
      expect_same(Segment<TypeParam>{start, start + way});
      expect_same(Ray<TypeParam>{start, way});
      expect_same(Line<TypeParam>{start, way});
    }
    EXPECT_GT(undecided, 0U);
    this->RecordProperty("undecided_" + name_of_instruction_set(target), std::to_string(undecided));
  }
}

}  // namespace
}  // namespace surehit::test::kernel_path_test
