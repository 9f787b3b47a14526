// How many paths a device leaves to the host, of the sets that the benchmark draws. The guide has the shares.

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/named_mesh.hpp"
#include "benchmarks/path_set.hpp"
#include "benchmarks/uneven_meshes.hpp"
#include "gpu_answers.hpp"
#include "shared_gpu.hpp"
#include "support/same_bits.hpp"

namespace surehit::test::gpu_shares_test {
namespace {

using benchmark::NamedMesh;
using benchmark::PathSet;

/// What the host has done of the paths of a set, in thousandths of them.
struct HostShares {
  double first;  ///< Of `first_hits`: paths that it has answered, and hits that it has rounded.
  double any;    ///< Of `any_hits`: paths that it has answered.
};

class GpuSharesTest : public SharedGpu {
 protected:
  static constexpr std::size_t path_count = 2000;
  static constexpr PathSet general_sets[] = {PathSet::long_paths,  PathSet::short_paths,  PathSet::near_paths,
                                             PathSet::sight_paths, PathSet::detail_paths, PathSet::far_paths,
                                             PathSet::cell_paths};
  static constexpr PathSet exact_sets[] = {PathSet::edge_paths, PathSet::edge_end_paths, PathSet::in_plane_paths};

  /// Asks the device and the host about a set, expects the same bits, and returns the shares.
  template <typename OnGpu, typename Host>
  [[nodiscard]] static HostShares shares_of(const OnGpu& on_gpu, const Host& host, std::span<const Segmentf> paths,
                                            const std::string& name) {
    typename BatchesOf<Host>::Hit unset;
    unset.t = 7;
    std::vector hits(paths.size(), unset);
    std::vector expected(paths.size(), unset);
    std::vector<std::uint8_t> blocked(paths.size(), 7);
    std::vector<std::uint8_t> expected_blocked(paths.size(), 7);
    GpuStatistics first;
    GpuStatistics any;
    EXPECT_TRUE(on_gpu.first_hits(paths, hits, {}, {.statistics = &first}));
    EXPECT_TRUE(on_gpu.any_hits(paths, blocked, {}, {.statistics = &any}));
    host.first_hits(paths, expected);
    host.any_hits(paths, expected_blocked);
    std::size_t different = 0;
    for (std::size_t i = 0; i < paths.size(); ++i) different += same_bits(hits[i], expected[i]) ? 0 : 1;
    EXPECT_EQ(different, 0U) << name;
    EXPECT_EQ(blocked, expected_blocked) << name;
    const auto thousandths = [&](std::uint64_t count) {
      return 1000 * static_cast<double>(count) / static_cast<double>(paths.size());
    };
    RecordProperty(name + "_first_answered", std::to_string(thousandths(first.undecided)));
    RecordProperty(name + "_first_rounded", std::to_string(thousandths(first.rounded_by_host)));
    RecordProperty(name + "_any_answered", std::to_string(thousandths(any.undecided)));
    return {thousandths(first.undecided + first.rounded_by_host), thousandths(any.undecided)};
  }

  /// Expects that each of these sets has shares below `max` in a mesh.
  static void expect_in_mesh(const NamedMesh& mesh, std::size_t count, std::span<const PathSet> sets, double max) {
    const Colliderf collider(mesh.mesh.view());
    const GpuCollider on_gpu(device, collider);
    for (const PathSet set : sets) {
      const benchmark::PathBatch paths = draw_paths(set, mesh, count);
      const std::string name = mesh.name + "_" + name_of(set);
      const HostShares shares = shares_of(on_gpu, collider, paths.segments(), name);
      EXPECT_LT(shares.first, max) << name;
      EXPECT_LT(shares.any, max) << name;
    }
  }
  /// Expects what the goals are, with fewer paths.
  static void expect_goals(const NamedMesh& mesh) {
    expect_in_mesh(mesh, path_count / 2, general_sets, 10);
    expect_in_mesh(mesh, path_count / 2, exact_sets, 100);
  }
};

TEST_F(GpuSharesTest, paths_in_general_position_are_left_to_the_host_rarely) {
  expect_in_mesh(benchmark::level_mesh(1), path_count, general_sets, 10);
}

TEST_F(GpuSharesTest, paths_along_edges_and_in_planes_are_decided_on_the_device) {
  expect_in_mesh(benchmark::level_mesh(1), path_count, exact_sets, 100);
}

TEST_F(GpuSharesTest, the_terrain_meets_both_goals) { expect_goals(benchmark::uneven_mesh("terrain", 0.5F)); }

TEST_F(GpuSharesTest, voxels_meet_both_goals) { expect_goals(benchmark::uneven_mesh("voxels", 0.5F)); }

TEST_F(GpuSharesTest, meshes_of_others_meet_both_goals) {
  const std::filesystem::path folder = SUREHIT_MESH_FOLDER;
  if (!std::filesystem::exists(folder / "dungeon.obj")) GTEST_SKIP() << "no meshes in " << folder;
  for (const NamedMesh& mesh : benchmark::meshes_in(folder.string(), {}, {})) expect_goals(mesh);
}

}  // namespace
}  // namespace surehit::test::gpu_shares_test
