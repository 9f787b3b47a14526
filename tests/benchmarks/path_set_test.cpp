#include "path_set.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <surehit/collider.hpp>
#include <vector>

#include "named_mesh.hpp"

namespace surehit::test::path_set_test {
namespace {

using benchmark::all_path_sets;
using benchmark::draw_paths;
using benchmark::name_of;
using benchmark::NamedMesh;
using benchmark::PathBatch;
using benchmark::PathSet;

class PathSetTest : public testing::Test {
 protected:
  static constexpr std::size_t count = 2000;

  [[nodiscard]] PathBatch draw(PathSet set) const { return draw_paths(set, level_, count); }
  /// Returns the share of a set's paths that meet the mesh.
  [[nodiscard]] double share_of_hits(PathSet set) const {
    const Colliderf collider(level_.mesh.view());
    const PathBatch paths = draw(set);
    std::vector<std::uint8_t> blocked(paths.size());
    paths.visit([&](const auto& all) { collider.any_hits(all, blocked); });
    return static_cast<double>(std::count(blocked.begin(), blocked.end(), 1)) / static_cast<double>(paths.size());
  }

  const NamedMesh level_ = benchmark::level_mesh(0.05F);
  const double diagonal_ = level_.diagonal();
  const Vector3d centre_ = (level_.box().low.cast<double>() + level_.box().high.cast<double>()) / 2;
};

TEST_F(PathSetTest, has_a_name_of_its_own) {
  std::set<std::string> names;
  for (const PathSet set : all_path_sets) names.insert(name_of(set));
  EXPECT_EQ(names.size(), all_path_sets.size());
}

TEST_F(PathSetTest, has_rays_only_where_it_says_so) {
  for (const PathSet set : all_path_sets) EXPECT_EQ(draw(set).are_rays(), set == PathSet::far_rays) << name_of(set);
  const std::vector<PathSet> sets(all_path_sets.begin(), all_path_sets.end());
  const std::vector<PathSet> with_segments = benchmark::sets_of_segments(sets);
  EXPECT_EQ(with_segments.size(), sets.size() - 1);
  for (const PathSet set : with_segments) EXPECT_FALSE(draw(set).are_rays()) << name_of(set);
}

TEST_F(PathSetTest, draws_the_same_paths_for_the_same_seed) {
  for (const PathSet set : all_path_sets) {
    const PathBatch paths = draw(set);
    const PathBatch again = draw(set);
    const PathBatch others = draw_paths(set, level_, count, 2);
    const auto is_same = [](const Segmentf& x, const Segmentf& y) { return x.start == y.start && x.end == y.end; };
    EXPECT_TRUE(std::ranges::equal(paths.segments(), again.segments(), is_same)) << name_of(set);
    EXPECT_FALSE(std::ranges::equal(paths.segments(), others.segments(), is_same)) << name_of(set);
  }
}

TEST_F(PathSetTest, has_short_paths_of_one_length) {
  for (const PathSet set : {PathSet::short_paths, PathSet::near_paths, PathSet::detail_paths}) {
    const PathBatch paths = draw(set);
    for (const Segmentf& path : paths.segments()) {
      EXPECT_NEAR((path.end - path.start).cast<double>().norm(), 0.01 * diagonal_, 1e-5 * diagonal_) << name_of(set);
    }
  }
}

TEST_F(PathSetTest, begins_far_away_and_is_aimed_at_the_mesh_half_of_the_time) {
  for (const PathSet set : {PathSet::far_paths, PathSet::far_rays}) {
    const PathBatch paths = draw(set);
    for (const Segmentf& path : paths.segments()) {
      const double distance = (path.start.cast<double>() - centre_).norm() / diagonal_;
      EXPECT_GE(distance, 9.99) << name_of(set);
      EXPECT_LE(distance, 1000.1) << name_of(set);
    }
    // A path that is aimed may end in front of the first triangle, or leave through the open side of a hall.
    EXPECT_GT(share_of_hits(set), 0.3) << name_of(set);
    EXPECT_LT(share_of_hits(set), 0.55) << name_of(set);
  }
}

TEST_F(PathSetTest, meets_what_it_is_aimed_at) {
  for (const PathSet set : {PathSet::edge_paths, PathSet::edge_end_paths}) {
    EXPECT_GT(share_of_hits(set), 0.9) << name_of(set);
  }
}

}  // namespace
}  // namespace surehit::test::path_set_test
