// What a device does at the same time, where it has queues of their own for copies.

#include "gpu/gpu_commands.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "faulty_vulkan.hpp"
#include "gpu/gpu_device_state.hpp"
#include "gpu_answers.hpp"
#include "lost_device.hpp"
#include "reused_device.hpp"
#include "simulated_copy_queues.hpp"
#include "small_dispatches.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/random.hpp"
#include "surehit/scene.hpp"
#include "validation_layer.hpp"

namespace surehit::test::gpu_commands_test {
namespace {

using detail::GpuDeviceState;

class GpuCopyQueuesTest : public testing::Test {
 protected:
  static void TearDownTestSuite() { device = GpuDevice(); }
  void SetUp() override {
    renew(device, SimulatedCopyQueues::open);
    SUREHIT_SKIP_WITHOUT(device);
    Random random(1);
    const GeneratedMesh<float> ground = rough_ground<float>(20, 0.1F, random);
    collider = std::make_shared<Colliderf>(ground.view());
    for (std::size_t i = 0; i < 3 * paths_in_small_dispatch - 2000; ++i) {
      const auto number = [&] { return random.symmetric<float>(); };
      Vector3f end(number(), number(), number());
      if (i % 16 == 0) end = ground.vertices[random.below(ground.vertices.size())];
      paths.push_back({{number(), number(), 1}, end});
    }
  }
  [[nodiscard]] GpuDeviceState& state() const { return *GpuDeviceState::of(device); }

  static inline GpuDevice device;
  std::shared_ptr<Colliderf> collider;
  std::vector<Segmentf> paths;
};

TEST_F(GpuCopyQueuesTest, answers_are_those_of_the_host) {
  ASSERT_TRUE(state().copies_apart());
  const GpuCollider on_gpu(device, *collider);
  std::vector<QueryOptionsf> options(paths.size());
  for (std::size_t i = 0; i < options.size(); i += 3) options[i].max_t = 0.75F;
  EXPECT_GT(expect_same_as_host(on_gpu, *collider, paths), 0U);
  EXPECT_GT(expect_same_as_host(on_gpu, *collider, paths, {.path_options = options}), 0U);
  Scenef scene;
  scene.add(collider, Posef::translated({0, 0, 0.125F}));
  scene.commit();
  EXPECT_GT(expect_same_as_host(GpuScene(device, scene.snapshot()), scene, paths), 0U);
}

std::vector<VkSubmitInfo> given;
std::vector<std::pair<VkSemaphore, VkSemaphore>> semaphores;
VKAPI_ATTR VkResult VKAPI_CALL noted_submit(VkQueue queue, std::uint32_t count, const VkSubmitInfo* work,
                                            VkFence fence) {
  given.push_back(*work);
  semaphores.emplace_back(work->waitSemaphoreCount == 0 ? VkSemaphore{} : *work->pWaitSemaphores,
                          work->signalSemaphoreCount == 0 ? VkSemaphore{} : *work->pSignalSemaphores);
  return submit(queue, count, work, fence);
}

/// Copies, computation and copies are given to their queues apart. Each waits for the one before, and for nothing else.
TEST_F(GpuCopyQueuesTest, each_part_waits_for_the_one_before) {
  const GpuCollider on_gpu(device, *collider);
  given.clear();
  semaphores.clear();
  submit = std::exchange(state().vulkan.QueueSubmit, noted_submit);
  std::vector<Hitf> hits(paths.size());
  EXPECT_TRUE(on_gpu.first_hits(paths, hits));
  state().vulkan.QueueSubmit = submit;
  ASSERT_EQ(semaphores.size(), 9U);
  for (std::size_t i = 0; i < semaphores.size(); i += 3) {
    EXPECT_EQ(semaphores[i].first, VkSemaphore{});
    EXPECT_NE(semaphores[i].second, VkSemaphore{});
    EXPECT_EQ(semaphores[i + 1].first, semaphores[i].second);
    EXPECT_NE(semaphores[i + 1].second, VkSemaphore{});
    EXPECT_NE(semaphores[i + 1].second, semaphores[i].second);
    EXPECT_EQ(semaphores[i + 2].first, semaphores[i + 1].second);
    EXPECT_EQ(semaphores[i + 2].second, VkSemaphore{});
  }
  // The next dispatch has semaphores of its own.
  EXPECT_NE(semaphores[0].second, semaphores[3].second);
}

TEST_F(GpuCopyQueuesTest, a_lost_device_is_told) {
  const GpuCollider on_gpu(device, *collider);
  std::vector<Hitf> expected(paths.size());
  collider->first_hits(paths, expected);
  for (const LossInBatch& loss : losses_in_batch) {
    expect_lost_in_batch(device, on_gpu, paths, expected, loss);
  }
}

/// The layer sees one family of queues, and how parts wait for each other.
TEST_F(GpuCopyQueuesTest, the_validation_layer_has_nothing_to_say) {
  expect_nothing_from_validation(
      [this](const GpuDevice& validated) {
        const GpuCollider on_gpu(with_small_dispatches(validated), *collider);
        expect_same_as_host(on_gpu, *collider, std::span(paths).first(paths_in_small_dispatch + 2000));
      },
      SimulatedCopyQueues::open);
}

/// A queue takes no part of a dispatch whose other parts are under way. No fence tells when those end.
TEST_F(GpuCopyQueuesTest, a_device_that_takes_a_part_alone_is_lost) {
  for (const int parts : {0, 1, 2}) {
    device = with_small_dispatches(SimulatedCopyQueues::open());
    const GpuCollider on_gpu(device, *collider);
    submit = std::exchange(state().vulkan.QueueSubmit, no_submit);
    submit_result = VK_ERROR_OUT_OF_DEVICE_MEMORY;
    calls_left = parts;
    std::vector<Hitf> hits(paths.size());
    const GpuBatchResult result = on_gpu.first_hits(paths, hits);
    state().vulkan.QueueSubmit = submit;
    ASSERT_TRUE(result.error);
    EXPECT_EQ(result.error->reason, GpuError::Reason::out_of_memory);
    EXPECT_EQ(result.finished, 0U);
    EXPECT_EQ(state().is_lost, parts > 0);
  }
}

}  // namespace
}  // namespace surehit::test::gpu_commands_test
