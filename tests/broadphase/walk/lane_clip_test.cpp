#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "lane_clip_on_targets.hpp"
#include "support/case_count.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/instruction_sets.hpp"
#include "support/pair_text.hpp"
#include "support/path_drawer.hpp"
#include "support/random.hpp"

namespace surehit::test::lane_clip_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Lanes of doubles clip as `ClippedPath` does, in each bit. So its proof is theirs (L9).
class LaneClipTest : public testing::Test {
 protected:
  /// Returns the number of paths that lanes can walk.
  std::size_t expect_as_alone(const GeneratedMesh<double>& mesh, const GridOptions& options,
                              const std::vector<RangedPath>& paths) {
    const Grid grid(mesh.view(), box_of(mesh.view()), options);
    std::size_t inside = 0;
    for (const std::int64_t target : instruction_sets()) {
      const ForcedInstructionSet forced(target);
      const std::vector<ClippedLane> clips = clip_in_double(grid, paths);
      for (std::size_t i = 0; i < clips.size(); ++i) {
        SCOPED_TRACE(name_of_instruction_set(target) + ": " + hex_text(paths[i].path));
        inside += clips[i].is_inside;
        expect_same(grid, clips[i], paths[i]);
      }
    }
    return inside;
  }

 private:
  static void expect_same(const Grid& grid, const ClippedLane& clip, const RangedPath& ranged) {
    const auto& [path, first_t, last_t] = ranged;
    const ClippedPath alone(grid, path, first_t, last_t);
    // What stands may be scaled by 1.
    if (alone.status == ClippedPath::Status::clipped && !path.toward.isZero()) {
      EXPECT_EQ(clip.is_apart, !alone.is_unscaled());
    }
    if (clip.is_apart) {
      EXPECT_FALSE(clip.is_inside);
      return;
    }
    ASSERT_EQ(clip.is_inside, alone.status == ClippedPath::Status::clipped);
    if (!clip.is_inside) return;
    EXPECT_TRUE(alone.is_unscaled());
    EXPECT_EQ(clip.enters, alone.tau.origin[2]);
    EXPECT_EQ(clip.float_enters, static_cast<float>(alone.tau.origin[2]));
    EXPECT_EQ(clip.end, alone.end);
    EXPECT_EQ(clip.octant, alone.octant);
    const GridFrame::TopOrder& order = grid.frame().top_orders[alone.octant];
    EXPECT_EQ(clip.first_cell, static_cast<float>(order.first));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(clip.start[axis], alone.start[axis]);
      EXPECT_EQ(clip.rate[axis], alone.rate[axis]);
      EXPECT_EQ(clip.inverse_rate[axis], alone.inverse_rate[axis]);
      EXPECT_EQ(clip.finest[axis], std::floor(alone.start[axis]));
      EXPECT_EQ(clip.pitch[axis], static_cast<float>(order.pitch[axis]));
    }
  }
};

TEST_F(LaneClipTest, of_paths_of_every_kind_and_octant) {
  Random random(111);
  for (std::size_t i = case_count(40); i > 0 && !HasFailure(); --i) {
    const auto mesh = rough_ground<double>(6, 0.7, random);
    PathDrawer<double> drawer(mesh.view(), random.bits());
    std::vector<RangedPath> paths;
    const auto kind = static_cast<std::size_t>(random.below(3));
    for (std::size_t k = 0; k < 70; ++k) {
      const Vector3<double> start = drawer.point_around_mesh();
      const Vector3<double> target = random.one_in(3) ? drawer.point_around_mesh() : drawer.point_on_mesh();
      const double length = std::ldexp(1.0, static_cast<int>(random.between(-30, 18)));
      Vector3<double> way = length * (target - start);
      if (random.one_in(4)) way[static_cast<Eigen::Index>(random.below(3))] = 0;
      if (random.one_in(6)) way = Vector3<double>::Zero();
      // So slow and so far away that a ray is scaled (L11).
      const bool is_far = kind != 0 && random.one_in(6);
      if (is_far) way = 0x1p-19 * (target - start);
      Vector3<double> from = random.one_in(2) ? start : Vector3<double>(target - way);
      if (is_far) from = start - 0x1p19 * (target - start);
      const Path<double> path = kind == 0   ? Path<double>(Segment<double>{from, from + way})
                                : kind == 1 ? Path<double>(Ray<double>{from, way})
                                            : Path<double>(Line<double>{from, way});
      RangedPath ranged = {path, path.has_start() ? 0 : -infinity, path.has_end() ? 1 : infinity};
      if (random.one_in(2)) ranged.first_t = random.unit<double>();
      if (random.one_in(2)) ranged.last_t = random.unit<double>();
      paths.push_back(ranged);
    }
    for (const GridOptions& options :
         {GridOptions{.resolution = {9, 8, 5}, .crowded = 0}, GridOptions{.resolution = {3, 2, 1}, .crowded = 4}}) {
      EXPECT_GT(expect_as_alone(mesh, options, paths), 0U);
    }
  }
}

TEST_F(LaneClipTest, leaves_what_must_be_scaled_apart) {
  Random random(112);
  const auto mesh = rough_ground<double>(6, 0.7, random);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<RangedPath> paths;
  for (const double far : {0x1p30, 0x1p100, 1e300, infinity, nan}) {
    paths.push_back({Segment<double>{{far, 0, 0}, {0, 0, 0}}, 0, 1});
    paths.push_back({Segment<double>{{0, 0, 0}, {0, far, 0}}, 0, 1});
  }
  const Grid grid(mesh.view(), box_of(mesh.view()), {.resolution = {9, 8, 5}, .crowded = 0});
  for (const std::int64_t target : instruction_sets()) {
    const ForcedInstructionSet forced(target);
    const std::vector<ClippedLane> clips = clip_in_double(grid, paths);
    for (std::size_t i = 0; i < clips.size(); ++i) {
      // A segment that ends far away is not scaled if it is not too fast.
      const bool is_plain = i == 1;
      EXPECT_EQ(clips[i].is_apart, !is_plain) << name_of_instruction_set(target) << ": " << hex_text(paths[i].path);
    }
  }
}

}  // namespace
}  // namespace surehit::test::lane_clip_test
