// How many paths a device leaves to the host, of the sets that the benchmark draws. The guide has the shares.

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/named_mesh.hpp"
#include "benchmarks/path_set.hpp"
#include "gpu_answers.hpp"

namespace surehit::test::gpu_shares_test {
namespace {

using benchmark::PathSet;

/// What the host has done of 2,000 paths, in thousandths of them.
struct HostShares {
  double first;  ///< Of `first_hits`: paths that it has answered, and hits that it has rounded.
  double any;    ///< Of `any_hits`: paths that it has answered.
};

class GpuSharesTest : public testing::Test {
 protected:
  static constexpr std::size_t path_count = 2000;

  void SetUp() override { SUREHIT_SKIP_WITHOUT(device); }

  /// Asks the device and the host about a set, expects the same bits, and returns the shares.
  [[nodiscard]] HostShares shares_of(PathSet set) const {
    const benchmark::PathBatch drawn = draw_paths(set, level, path_count);
    const std::span<const Segmentf> paths = drawn.segments();
    const GpuCollider on_gpu(device, collider);
    expect_same_as_host(on_gpu, collider, paths);
    std::vector<Hitf> hits(paths.size());
    std::vector<std::uint8_t> blocked(paths.size());
    GpuStatistics first;
    GpuStatistics any;
    EXPECT_TRUE(on_gpu.first_hits(paths, hits, {}, {.statistics = &first}));
    EXPECT_TRUE(on_gpu.any_hits(paths, blocked, {}, {.statistics = &any}));
    const auto thousandths = [&](std::uint64_t count) {
      return 1000 * static_cast<double>(count) / static_cast<double>(paths.size());
    };
    RecordProperty(name_of(set) + "_first_answered", std::to_string(thousandths(first.undecided)));
    RecordProperty(name_of(set) + "_first_rounded", std::to_string(thousandths(first.rounded_by_host)));
    RecordProperty(name_of(set) + "_any_answered", std::to_string(thousandths(any.undecided)));
    return {thousandths(first.undecided + first.rounded_by_host), thousandths(any.undecided)};
  }

  GpuDevice device = any_gpu();
  benchmark::NamedMesh level = benchmark::level_mesh(1);
  Colliderf collider{level.mesh.view()};
};

TEST_F(GpuSharesTest, paths_in_general_position_are_left_to_the_host_rarely) {
  for (const PathSet set : {PathSet::long_paths, PathSet::short_paths, PathSet::near_paths, PathSet::sight_paths,
                            PathSet::detail_paths, PathSet::far_paths, PathSet::cell_paths}) {
    const HostShares shares = shares_of(set);
    EXPECT_LT(shares.first, 10) << name_of(set);
    EXPECT_LT(shares.any, 10) << name_of(set);
  }
}

TEST_F(GpuSharesTest, paths_along_edges_and_in_planes_are_decided_on_the_device) {
  for (const PathSet set : {PathSet::edge_paths, PathSet::edge_end_paths, PathSet::in_plane_paths}) {
    const HostShares shares = shares_of(set);
    EXPECT_LT(shares.first, 100) << name_of(set);
    EXPECT_LT(shares.any, 100) << name_of(set);
  }
}

}  // namespace
}  // namespace surehit::test::gpu_shares_test
