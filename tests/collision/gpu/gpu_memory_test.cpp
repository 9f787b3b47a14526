// Allocations of a batch that fail. The batch tells so, and how many answers there are.

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <set>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "../allocations.hpp"
#include "buffer_answers.hpp"
#include "faulty_vulkan.hpp"
#include "gpu/in_dispatches.hpp"
#include "gpu_answers.hpp"
#include "reused_device.hpp"
#include "small_dispatches.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/random.hpp"

namespace surehit::test::gpu_memory_test {
namespace {

using detail::GpuDeviceState;

/// Asks a collider or a scene about segments.
template <typename Host>
class GpuMemoryTest : public testing::Test {
 protected:
  static constexpr bool is_scene = std::is_same_v<Host, Scenef>;
  using OnGpu = std::conditional_t<is_scene, GpuScene, GpuCollider>;
  using Hit = typename BatchesOf<Host>::Hit;
  using Options = typename BatchesOf<Host>::Options;
  using HitInBuffer = std::conditional_t<is_scene, detail::DeviceSceneHit, detail::DeviceHit>;

  static void TearDownTestSuite() { device = GpuDevice(); }
  void SetUp() override {
    renew(device, [] { return any_gpu(); });
    SUREHIT_SKIP_WITHOUT(device);
    Random random(1);
    const GeneratedMesh<float> ground = rough_ground<float>(20, 0.1F, random);
    Colliderf collider(ground.view());
    if constexpr (is_scene) {
      const auto shared = std::make_shared<Colliderf>(std::move(collider));
      host.add(shared);
      host.add(shared, Posef::translated({0.5F, 0.25F, 0.75F}));
      host.commit();
      on_gpu = GpuScene(device, host.snapshot());
    } else {
      host = std::move(collider);
      on_gpu = GpuCollider(device, host);
    }
    // Two dispatches. In the second one, the host has more to do than in the first, where most paths are far away.
    for (std::size_t i = 0; i < paths_in_small_dispatch + 2000; ++i) {
      Vector3f start(random.symmetric<float>(), random.symmetric<float>(), 2);
      Vector3f end(random.symmetric<float>(), random.symmetric<float>(), 3);
      if (i % 64 == 0) end.z() = random.unit<float>() - 0.5F;
      if (i % 64 == 1 || i >= paths_in_small_dispatch) {
        end = ground.vertices[random.below(ground.vertices.size())];
        start.x() = 0x1p-40F;  // Whole numbers of a device do not hold it, so the host decides.
      }
      paths.push_back({start, end});
    }
    own_options.resize(paths.size());
    options.path_options = own_options;
    expected.resize(paths.size());
    host.first_hits(paths, expected);
    ask_buffers(false);  // So a driver has compiled all that it needs.
    ask_spans(false, {}, ScarceMemory::all, 0);
  }
  [[nodiscard]] GpuDeviceState& state() const { return *GpuDeviceState::of(device); }

  /// Expects that the first `finished` hits are there, and that the others are as before.
  void expect_finished(std::span<const Hit> hits, std::size_t finished) const {
    Hit unset;
    unset.t = 7;
    for (std::size_t i = 0; i < hits.size(); ++i) {
      ASSERT_TRUE(same_bits(hits[i], i < finished ? expected[i] : unset)) << i << " of " << finished;
    }
  }

  /// Asks while some allocations fail. Returns false once none has failed.
  bool ask_spans(bool without_slots, const GpuBatchOptions& gpu, std::size_t successes, std::size_t failures) {
    Hit unset;
    unset.t = 7;
    std::vector<Hit> hits(paths.size(), unset);
    if (without_slots) state().pairs.clear();
    GpuStatistics statistics;
    GpuBatchOptions counted = gpu;
    counted.statistics = &statistics;
    GpuBatchResult result;
    bool has_failed = false;
    {
      const ScarceMemory scarce(successes, failures);
      result = on_gpu.first_hits(paths, hits, options, counted);
      has_failed = ScarceMemory::has_failed();
    }
    EXPECT_EQ(result.error.has_value(), has_failed);
    if (has_failed) {
      EXPECT_EQ(result.error->reason, GpuError::Reason::out_of_memory) << result.error->what();
      if (!gpu.goes_on_without_device) finished.insert(result.finished);
    }
    EXPECT_EQ(result.is_complete, gpu.goes_on_without_device || !has_failed);
    EXPECT_EQ(result.finished == paths.size(), result.is_complete);
    EXPECT_EQ(statistics.paths, paths.size());
    EXPECT_EQ(statistics.misses + statistics.hits + statistics.undecided, result.finished);
    EXPECT_EQ(statistics.rounded + statistics.rounded_by_host, statistics.hits);
    expect_finished(hits, result.finished);
    expect_idle(state());
    return has_failed;
  }

  /// Lets allocations of batches on buffers fail in turn, unless none shall.
  void ask_buffers(bool scarce) {
    const SegmentsInBuffers<HitInBuffer> buffers(device, paths);
    for (std::size_t successes = 0;; successes += 3) {
      std::memset(buffers.hits.data(), 7, paths.size() * sizeof(HitInBuffer));
      GpuBatchResult result;
      bool has_failed = false;
      {
        const ScarceMemory memory(successes, scarce ? ScarceMemory::all : 0);
        result = on_gpu.first_hits(buffers.paths, buffers.hits.part(), options);
        has_failed = ScarceMemory::has_failed();
      }
      EXPECT_EQ(!result, has_failed);
      const std::span found(reinterpret_cast<const HitInBuffer*>(buffers.hits.data()), paths.size());
      for (std::size_t i = 0; i < result.finished; ++i) ASSERT_TRUE(is_same(found[i], expected[i])) << i;
      expect_idle(state());
      if (!has_failed) {
        EXPECT_EQ(result.finished, paths.size());
        return;
      }
      ASSERT_TRUE(result.error);
      EXPECT_EQ(result.error->reason, GpuError::Reason::out_of_memory) << result.error->what();
      finished.insert(result.finished);
    }
  }

  static inline GpuDevice device;
  Host host;
  OnGpu on_gpu;
  std::vector<Segmentf> paths;
  std::vector<typename std::remove_cvref_t<decltype(Options().path_options[0])>> own_options;
  Options options;
  std::vector<Hit> expected;
  std::set<std::size_t> finished;  ///< How many answers there were in batches that failed.
};

using Hosts = testing::Types<Colliderf, Scenef>;
struct HostNames {
  template <typename Host>
  static std::string GetName(int) {
    return std::is_same_v<Host, Scenef> ? "scene" : "collider";
  }
};
TYPED_TEST_SUITE(GpuMemoryTest, Hosts, HostNames);

TYPED_TEST(GpuMemoryTest, batches_tell_what_is_finished) {
  for (std::size_t successes = 0; this->ask_spans(successes < 3, {}, successes, ScarceMemory::all); ++successes) {
  }
  EXPECT_EQ(this->finished, (std::set<std::size_t>{0, paths_in_small_dispatch}));
}

/// The host goes on whether it finds memory again or not.
TYPED_TEST(GpuMemoryTest, the_host_goes_on) {
  for (const std::size_t failures : {std::size_t{1}, ScarceMemory::all}) {
    const GpuBatchOptions gpu = {.goes_on_without_device = true};
    for (std::size_t successes = 0; this->ask_spans(successes < 3, gpu, successes, failures); successes += 5) {
    }
  }
}

TYPED_TEST(GpuMemoryTest, batches_on_buffers_tell_what_is_finished) {
  this->ask_buffers(true);
  EXPECT_EQ(this->finished, (std::set<std::size_t>{0, paths_in_small_dispatch}));
}

}  // namespace
}  // namespace surehit::test::gpu_memory_test
