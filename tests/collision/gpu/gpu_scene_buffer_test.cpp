// Paths that go through scenes, and their hits, in buffers of the caller's.

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "buffer_answers.hpp"
#include "caller_buffer.hpp"
#include "collision/scene/unit_scenes.hpp"
#include "drawn_scene_paths.hpp"
#include "faulty_vulkan.hpp"
#include "gpu/device_answers.hpp"
#include "gpu/gpu_device_state.hpp"
#include "gpu_answers.hpp"
#include "segments_to_ground.hpp"
#include "shared_gpu.hpp"
#include "small_dispatches.hpp"
#include "support/case_count.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "validation_layer.hpp"

namespace surehit::test::gpu_scene_buffer_test {
namespace {

using Reason = GpuError::Reason;
using detail::DeviceSceneHit;
using detail::GpuDeviceState;

class GpuSceneBufferTest : public SharedGpu {
 protected:
  GpuSceneBufferTest() { with_small_dispatches(device); }
  GpuDeviceState& state() { return *GpuDeviceState::of(device); }
};

TEST_F(GpuSceneBufferTest, scenes_of_each_family) {
  for (const SceneFamily family : all_scene_families) {
    SCOPED_TRACE(name_of(family));
    Random random(20261127 + static_cast<std::uint64_t>(family));
    for (std::size_t i = case_count(5); i > 0; --i) {
      const DrawnScene<float> drawn = draw_scene<float>(family, random);
      const JudgedScene<float> judged(drawn);
      const auto paths = draw_scene_paths(drawn, judged, random);
      const GpuScene on_gpu(device, judged.scene.snapshot());
      for (const PathKind kind : {PathKind::segment, PathKind::ray, PathKind::line}) {
        const auto& options = paths.options[static_cast<std::size_t>(kind)];
        expect_same_in_buffers(device, on_gpu, judged.scene, paths.of(kind), {.path_options = options}, &statistics);
      }
    }
  }
  EXPECT_GT(statistics.rounded, 0U);
  EXPECT_GT(statistics.undecided, 0U);
}

/// Three instances of a piece of ground. The first one was used before, and has another generation.
class GpuSceneGroundTest : public GpuSceneBufferTest {
 protected:
  GpuSceneGroundTest() {
    Random random(1);
    ground = rough_ground<float>(20, 0.1F, random);
    collider = std::make_shared<Colliderf>(ground.view());
    scene.remove(scene.add(collider));
    scene.commit();
    scene.add(collider);
    scene.add(collider, Posef::rigid({0, 0, 0.6F, 0.8F}, {0.5F, 0.25F, 0.75F}));
    scene.set_motion(scene.add(collider, Posef::translated({-0.5F, 0, 0.5F})), {0, 0, 0.125F});
    scene.commit();
  }
  std::vector<Segmentf> draw(std::size_t count, std::uint64_t share) {
    return draw_segments_to(ground, 0.375F, count, share);
  }
  GeneratedMesh<float> ground;
  std::shared_ptr<Colliderf> collider;
  Scenef scene;
};

/// Two dispatches, whose lists are longer than what comes back at once.
TEST_F(GpuSceneGroundTest, buffers_count_as_spans_do) {
  const GpuScene on_gpu(device, scene.snapshot());
  const std::vector<Segmentf> paths = draw(8750, 10);
  GpuStatistics in_spans;
  expect_same_as_host(on_gpu, scene, paths, {}, &in_spans);
  expect_same_in_buffers(device, on_gpu, scene, paths, {}, &statistics);
  EXPECT_EQ(statistics.paths, 17'500U);
  EXPECT_EQ(statistics.dispatches, 4U);
  EXPECT_EQ(statistics.paths, statistics.hits + statistics.misses + statistics.undecided);
  EXPECT_EQ(statistics.misses, in_spans.misses);
  EXPECT_EQ(statistics.hits, in_spans.hits);
  EXPECT_EQ(statistics.rounded, in_spans.rounded);
  EXPECT_EQ(statistics.rounded_by_host, in_spans.rounded_by_host);
  EXPECT_EQ(statistics.undecided, in_spans.undecided);
  EXPECT_GT(statistics.misses, 125U);
  EXPECT_GT(statistics.rounded, 1250U);
  EXPECT_GT(statistics.rounded_by_host, 0U);
  EXPECT_GT(statistics.undecided, 500U);
}

/// The host answers all of them, and the device only carries paths and answers.
TEST_F(GpuSceneGroundTest, filters_and_scenes_that_the_device_cannot_have) {
  const std::vector<Segmentf> paths = draw(8750, 10);
  const auto odd = [](const SceneHitf& hit) { return hit.triangle % 2 == 1; };
  expect_same_in_buffers(device, GpuScene(device, scene.snapshot()), scene, paths, {.filter = odd}, &statistics);
  const std::span<const Segmentf> few = std::span(paths).first(100);
  scene.add(collider, Posef::translated({1e10F, 0, 0}));
  scene.commit();
  expect_same_in_buffers(device, GpuScene(device, scene.snapshot()), scene, few, {}, &statistics);
  Scenef empty;
  expect_same_in_buffers(device, GpuScene(device, empty.snapshot()), empty, few, {}, &statistics);
  EXPECT_EQ(statistics.undecided, statistics.paths);
  EXPECT_EQ(statistics.dispatches, 0U);
}

TEST_F(GpuSceneGroundTest, what_cannot_be_asked_is_refused) {
  const CallerVulkan vulkan(device.handles());
  const CallerBuffer buffer(vulkan, 8192);
  const GpuPaths paths = {PathKind::segment, 100, buffer.part()};
  const GpuBufferPart hits = {paths.part.buffer, 4096, 2399};
  EXPECT_EQ(GpuScene().first_hits(paths, hits).error->reason, Reason::not_updated);
  const GpuScene on_gpu(device, scene.snapshot());
  const GpuBatchResult refused = on_gpu.first_hits(paths, hits);
  ASSERT_TRUE(refused.error);
  EXPECT_STREQ(refused.error->what(), "the answers take 2400 bytes, and their part of a buffer has 2399");
  EXPECT_TRUE(on_gpu.any_hits(paths, hits));
  collider->set_mask(0, 0);
  EXPECT_EQ(on_gpu.any_hits(paths, hits).error->reason, Reason::not_updated);
}

TEST_F(GpuSceneGroundTest, a_device_that_fails_says_how_many_answers_there_are) {
  const GpuScene on_gpu(device, scene.snapshot());
  expect_failures_of_works_are_told<DeviceSceneHit>(device, on_gpu, draw(12'700, 2));
}

/// A list may name any triangle, because the host answers the whole path. It may not name a path twice.
TEST_F(GpuSceneGroundTest, faulty_lists_of_a_device_change_no_answer) {
  const GpuScene on_gpu(device, scene.snapshot());
  const std::vector<Segmentf> paths = draw(200, 4);
  faulty = &state();
  wait_for = std::exchange(state().vulkan.WaitForFences, changed_list);
  constexpr std::size_t first_listed = sizeof(detail::ListedCounts);
  change = [](std::byte* list) {
    constexpr std::uint32_t odd = 0xfffffffd;
    std::memcpy(list + first_listed + offsetof(detail::ListedPath, triangle), &odd, sizeof odd);
  };
  expect_same_in_buffers(device, on_gpu, scene, paths);
  change = [](std::byte* list) {
    std::memcpy(list + first_listed, list + first_listed + sizeof(detail::ListedPath), sizeof(std::uint32_t));
  };
  const SegmentsInBuffers<DeviceSceneHit> in_buffers(device, paths);
  const GpuBatchResult result = on_gpu.first_hits(in_buffers.paths, in_buffers.hits.part());
  ASSERT_TRUE(result.error);
  EXPECT_EQ(result.error->reason, Reason::failed);
  state().vulkan.WaitForFences = wait_for;
}

TEST_F(GpuSceneGroundTest, the_validation_layer_has_nothing_to_say) {
  expect_nothing_from_validation([this](const GpuDevice& validated) {
    const GpuScene on_gpu(validated, scene.snapshot());
    const std::vector<Segmentf> paths = draw(5000, 2);
    expect_same_in_buffers(validated, on_gpu, scene, paths);
    const auto odd = [](const SceneHitf& hit) { return hit.triangle % 2 == 1; };
    expect_same_in_buffers(validated, on_gpu, scene, std::span(paths).first(100), {.filter = odd});
  });
}

}  // namespace
}  // namespace surehit::test::gpu_scene_buffer_test
