// Paths and answers that stay in buffers of the caller's, on the device.

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "buffer_answers.hpp"
#include "caller_buffer.hpp"
#include "faulty_vulkan.hpp"
#include "gpu/device_answers.hpp"
#include "gpu/gpu_device_state.hpp"
#include "gpu_answers.hpp"
#include "segments_to_ground.hpp"
#include "shared_gpu.hpp"
#include "small_dispatches.hpp"
#include "support/case_count.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/pair_families.hpp"
#include "support/path_drawer.hpp"
#include "support/threads.hpp"
#include "validation_layer.hpp"

namespace surehit::test::gpu_buffer_batch_test {
namespace {

using Reason = GpuError::Reason;
using detail::DeviceHit;
using detail::GpuDeviceState;

class GpuBufferBatchTest : public SharedGpu {
 protected:
  GpuBufferBatchTest() { with_small_dispatches(device); }
  GpuDeviceState& state() { return *GpuDeviceState::of(device); }
};

TEST_F(GpuBufferBatchTest, pairs_of_each_family) {
  for (const PairFamily family : all_pair_families) {
    if (family == PairFamily::mixed_magnitudes) continue;  // One of them is too large for the device.
    SCOPED_TRACE(name_of(family));
    Random random(41);
    GeneratedMesh<float> mesh;
    PathsOfKinds<> paths;
    for (std::size_t i = 0; i < 100; ++i) {
      const auto [segment, triangle] = draw_pair<float>(family, random);
      mesh.add(triangle);
      for (const PathKind kind : {PathKind::segment, PathKind::ray, PathKind::line}) {
        paths.add(path_along(segment, kind), draw_options(random, 0.5F));
      }
    }
    const Colliderf collider(mesh.view());
    const GpuCollider on_gpu(device, collider);
    for (const PathKind kind : {PathKind::segment, PathKind::ray, PathKind::line}) {
      const auto& options = paths.options[static_cast<std::size_t>(kind)];
      expect_same_in_buffers(device, on_gpu, collider, paths.of(kind));
      expect_same_in_buffers(device, on_gpu, collider, paths.of(kind), {.path_options = options}, &statistics);
    }
  }
  EXPECT_GT(statistics.rounded, 0U);
  EXPECT_GT(statistics.undecided, 0U);
}

/// Ground, and paths of which some end in vertices and on edges of it.
class GpuGroundTest : public GpuBufferBatchTest {
 protected:
  GpuGroundTest() {
    Random random(1);
    ground = rough_ground<float>(20, 0.1F, random);
    collider = Colliderf(ground.view());
  }
  std::vector<Segmentf> draw(std::size_t count, std::uint64_t share) {
    return draw_segments_to(ground, 1, count, share);
  }
  GeneratedMesh<float> ground;
  Colliderf collider;
};

/// Three dispatches. Those of the first batch list few paths, and those of the second one more than come back at once.
TEST_F(GpuGroundTest, dispatches_that_list_few_paths_and_many) {
  const GpuCollider on_gpu(device, collider);
  const Threads threads(2);
  const std::vector<Segmentf> few = draw(17'500, 1000);
  const Executor executor = threads;
  expect_same_in_buffers(device, on_gpu, collider, few, {.executor = executor}, &statistics);
  EXPECT_EQ(statistics.paths, 35'000U);
  EXPECT_EQ(statistics.dispatches, 6U);
  EXPECT_EQ(statistics.paths, statistics.hits + statistics.misses + statistics.undecided);
  EXPECT_GT(statistics.misses, 125U);
  EXPECT_GT(statistics.undecided, 0U);
  EXPECT_LT(statistics.undecided, 125U);
  EXPECT_GT(statistics.rounded, 1250U);
  EXPECT_LT(statistics.rounded_by_host, statistics.rounded / 100);
  statistics = {};
  const std::vector<Segmentf> many = draw(8750, 4);
  expect_same_in_buffers(device, on_gpu, collider, many, {}, &statistics);
  EXPECT_GT(statistics.undecided, 2500U);
}

/// The host answers all of them, and the device only carries paths and answers.
TEST_F(GpuGroundTest, filters_and_meshes_that_the_device_cannot_have) {
  const auto odd = [](const Hitf& hit) { return hit.triangle % 2 == 1; };
  const std::vector<Segmentf> paths = draw(8750, 10);
  const GpuCollider on_gpu(device, collider);
  expect_same_in_buffers(device, on_gpu, collider, paths, {.filter = odd}, &statistics);
  EXPECT_EQ(statistics.undecided, 17'500U);
  EXPECT_EQ(statistics.dispatches, 0U);
  const Colliderf empty;
  expect_same_in_buffers(device, GpuCollider(device, empty), empty, std::span(paths).first(100));
}

/// The last path is in a dispatch of its own, and only there the filter takes its hit.
TEST_F(GpuBufferBatchTest, filters_get_the_index_of_a_path_in_its_batch) {
  GeneratedMesh<float> mesh;
  mesh.add({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}});
  const Colliderf collider(mesh.view());
  const GpuCollider on_gpu(device, collider);
  constexpr std::size_t last = std::size_t{1} << 16;
  const std::vector<Segmentf> paths(last + 1, {{1, 1, 1}, {1, 1, -1}});
  const auto is_last = [](std::size_t path, const Hitf&) { return path == last; };
  expect_same_in_buffers(device, on_gpu, collider, paths, {.filter = is_last});
  EXPECT_EQ(expect_same_as_host(on_gpu, collider, paths, {.filter = is_last}), 1U);
}

TEST_F(GpuGroundTest, short_batches) {
  const GpuCollider on_gpu(device, collider);
  const std::vector<Segmentf> paths = draw(100, 10);
  EXPECT_TRUE(on_gpu.first_hits(GpuPaths(), GpuBufferPart()));
  const CallerVulkan vulkan(device.handles());
  const CallerBuffer given(vulkan, paths.size() * sizeof(float[6]));
  fill(given, 0, paths);
  const CallerBuffer blocked(vulkan, 256);
  const std::vector<QueryOptionsf> two(2);
  EXPECT_TRUE(on_gpu.any_hits({PathKind::segment, 100, given.part()}, blocked.part(), {.path_options = two}));
  std::uint32_t words[3];
  std::memcpy(words, blocked.data(), sizeof words);
  EXPECT_LE(words[0], 1U);
  EXPECT_LE(words[1], 1U);
  EXPECT_EQ(words[2], unset_word);
}

TEST_F(GpuGroundTest, bad_buffers_are_refused_with_the_reason) {
  const GpuCollider on_gpu(device, collider);
  const CallerVulkan vulkan(device.handles());
  const CallerBuffer buffer(vulkan, 1 << 16);
  const auto refused = [&](std::size_t count, const GpuBufferPart& paths, const GpuBufferPart& hits) {
    const GpuBatchResult result = on_gpu.first_hits({PathKind::ray, count, paths}, hits);
    EXPECT_FALSE(result);
    EXPECT_EQ(result.finished, 0U);
    if (!result.error) return std::string("not refused");
    EXPECT_EQ(result.error->reason, Reason::bad_buffer);
    return std::string(result.error->what());
  };
  const GpuBufferPart front = {buffer.part().buffer, 0, 4096};
  const GpuBufferPart back = {buffer.part().buffer, 4096, 4096};
  EXPECT_TRUE(on_gpu.first_hits({PathKind::ray, 100, front}, back));
  EXPECT_EQ(refused(100, {}, back), "the buffer of the paths is null");
  EXPECT_EQ(refused(100, front, {0, 4096, 4096}), "the buffer of the answers is null");
  EXPECT_EQ(refused(171, front, back), "the paths take 4104 bytes, and their part of a buffer has 4096");
  EXPECT_EQ(refused(100, front, {front.buffer, 4096, 1999}),
            "the answers take 2000 bytes, and their part of a buffer has 1999");
  EXPECT_NE(refused(100, front, {front.buffer, 1 << 20, 4096}).find("ends beyond their buffer"), std::string::npos);
  EXPECT_NE(refused(100, {front.buffer, 0, ~std::uint64_t{0}}, back).find("ends beyond their"), std::string::npos);
  EXPECT_EQ(refused(100, front, {front.buffer, 2048, 4096}), "the paths and the answers share bytes of a buffer");
  EXPECT_EQ(refused(100, {front.buffer, 1024, 4096}, {front.buffer, 0, 4096}),
            "the paths and the answers share bytes of a buffer");
  EXPECT_EQ(refused(~std::size_t{0}, front, back), "the paths take more than any buffer has");
  auto& alignment = state().report.properties.limits.minStorageBufferOffsetAlignment;
  const VkDeviceSize of_device = std::exchange(alignment, 256);
  EXPECT_EQ(refused(100, {front.buffer, 8192 + 64, 4096}, back),
            "the paths begin at byte 8256 of their buffer, and " + device.name() + " needs a multiple of 256");
  alignment = 1;
  EXPECT_EQ(refused(100, front, {front.buffer, 8192 + 2, 4096}),
            "the answers begin at byte 8194 of their buffer, and " + device.name() + " needs a multiple of 4");
  alignment = of_device;
  EXPECT_EQ(GpuCollider().first_hits({PathKind::ray, 100, front}, back).error->reason, Reason::not_updated);
}

TEST_F(GpuGroundTest, a_device_that_fails_says_how_many_answers_there_are) {
  const GpuCollider on_gpu(device, collider);
  expect_failures_of_works_are_told<DeviceHit>(device, on_gpu, draw(12'700, 4));
}

/// Lists that no sound device writes: too long, with a path twice, and with a path that was not asked about.
TEST_F(GpuGroundTest, faulty_lists_of_a_device_are_refused) {
  const GpuCollider on_gpu(device, collider);
  const SegmentsInBuffers<DeviceHit> in_buffers(device, draw(200, 4));
  faulty = &state();
  wait_for = std::exchange(state().vulkan.WaitForFences, changed_list);
  const auto set = [](std::size_t word, std::uint32_t value) {
    return [=](std::byte* list) { std::memcpy(list + 4 * word, &value, sizeof value); };
  };
  constexpr std::size_t first_listed = sizeof(detail::ListedCounts) / 4;
  const std::vector<std::function<void(std::byte*)>> odd_lists = {
      set(0, 201), set(0, 0xffffffff), set(1, 200), set(first_listed, 200), [&](std::byte* list) {
        std::memcpy(list + 4 * first_listed, list + 4 * first_listed + sizeof(detail::ListedPath),
                    sizeof(std::uint32_t));
      }};
  for (const auto& odd : odd_lists) {
    change = odd;
    const GpuBatchResult result = on_gpu.first_hits(in_buffers.paths, in_buffers.hits.part());
    ASSERT_TRUE(result.error);
    EXPECT_EQ(result.error->reason, Reason::failed);
    EXPECT_EQ(result.error->what(), device.name() + " has listed paths that it was not given");
  }
  state().vulkan.WaitForFences = wait_for;
}

TEST_F(GpuGroundTest, a_device_of_the_caller_is_adopted_and_stays_open) {
  const std::vector<Segmentf> paths = draw(100, 4);
  {
    GpuDevice adopted;
    const GpuResult result = adopted.try_adopt(device.handles());
    ASSERT_TRUE(result) << result.error().what();
    EXPECT_EQ(adopted.name(), device.name());
    EXPECT_EQ(adopted.handles().queue, device.handles().queue);
    expect_same_in_buffers(adopted, GpuCollider(adopted, collider), collider, paths);
  }
  expect_same_in_buffers(device, GpuCollider(device, collider), collider, paths);
  GpuDevice none;
  GpuHandles handles = device.handles();
  handles.queue = nullptr;
  const GpuResult refused = none.try_adopt(handles);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().reason, Reason::no_device);
  EXPECT_STREQ(refused.error().what(), "the handles of a device have no queue");
  handles = device.handles();
  handles.queue_family = 1000;
  const GpuResult strange = none.try_adopt(handles);
  ASSERT_FALSE(strange);
  EXPECT_EQ(strange.error().reason, Reason::missing_feature);
  EXPECT_EQ(strange.error().what(), device.name() + " cannot be used: it lacks a queue that computes in family 1000");
  EXPECT_FALSE(none.is_open());
}

TEST(GpuBufferValidationTest, the_validation_layer_has_nothing_to_say) {
  expect_nothing_from_validation([](const GpuDevice& device) {
    Random random(1);
    const auto ground = rough_ground<float>(20, 0.1F, random);
    const Colliderf collider(ground.view());
    const GpuCollider on_gpu(with_small_dispatches(device), collider);
    std::vector<Segmentf> paths(8750, {{0.25F, 0.5F, 1}, {0.25F, 0.5F, -1}});
    for (std::size_t i = 0; i < 4000; ++i) paths[2 * i].end = ground.vertices[i % ground.vertices.size()];
    expect_same_in_buffers(device, on_gpu, collider, paths);
    const auto odd = [](const Hitf& hit) { return hit.triangle % 2 == 1; };
    expect_same_in_buffers(device, on_gpu, collider, paths, {.filter = odd});
  });
}

}  // namespace
}  // namespace surehit::test::gpu_buffer_batch_test
