// Batches that are under way on one device at the same time. Each has slots of its own.

#include "gpu/gpu_slots.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <future>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include "faulty_vulkan.hpp"
#include "gpu/gpu_device_state.hpp"
#include "gpu_answers.hpp"
#include "reused_device.hpp"
#include "small_dispatches.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/random.hpp"

namespace surehit::test::gpu_slots_test {
namespace {

using detail::GpuDeviceState;
using Reason = GpuError::Reason;

class GpuSlotsTest : public testing::Test {
 protected:
  static void TearDownTestSuite() { device = GpuDevice(); }
  void SetUp() override {
    renew(device, [] { return any_gpu(); });
    SUREHIT_SKIP_WITHOUT(device);
    ground = rough_ground<float>(20, 0.1F, random);
    collider = Colliderf(ground.view());
    on_gpu = GpuCollider(device, collider);
    draw(8750);  // Two dispatches.
    others.assign(paths.rbegin(), paths.rend());
    expected_of_others.assign(expected.rbegin(), expected.rend());
  }
  /// Draws paths of which three quarters end in vertices, and begin where whole numbers of a device do not hold it. So
  /// the host has enough to answer for its executor.
  void draw(std::size_t count) {
    for (std::size_t i = paths.size(); i < count; ++i) {
      Vector3f end(random.symmetric<float>(), random.symmetric<float>(), random.unit<float>() - 0.5F);
      Vector3f start(random.symmetric<float>(), random.symmetric<float>(), 1);
      if (i % 4 != 0) {
        end = ground.vertices[random.below(ground.vertices.size())];
        start.x() = 0x1p-40F;
      }
      paths.push_back({start, end});
    }
    expected.resize(count);
    collider.first_hits(paths, expected);
  }
  [[nodiscard]] GpuDeviceState& state() const { return *GpuDeviceState::of(device); }

  /// Asks about all paths. The executor does this once, when it is called for the second time: the first dispatch is
  /// under way then, or is to be finished.
  GpuBatchResult ask_with(const std::function<void()>& work, std::vector<Hitf>& hits,
                          const GpuBatchOptions& gpu = {}) const {
    constexpr int busy_call = 2;
    int calls = 0;
    const auto run = [&](std::size_t count, const Executor::Task& task) {
      if (++calls == busy_call) work();
      for (std::size_t i = 0; i < count; ++i) task(i);
    };
    hits.assign(paths.size(), Hitf());
    GpuBatchResult result = on_gpu.first_hits(paths, hits, {.executor = run}, gpu);
    EXPECT_GE(calls, busy_call);
    return result;
  }
  /// Asks about the other paths.
  void expect_answers_to_others() const {
    std::vector<Hitf> hits(others.size());
    EXPECT_TRUE(on_gpu.first_hits(others, hits));
    EXPECT_EQ(hits, expected_of_others);
  }

  static inline GpuDevice device;
  Random random{1};
  GeneratedMesh<float> ground;
  Colliderf collider;
  GpuCollider on_gpu;
  std::vector<Segmentf> paths, others;
  std::vector<Hitf> expected, expected_of_others;
};

TEST_F(GpuSlotsTest, executors_may_ask_the_same_device) {
  const auto ask_twice = [&] {
    expect_answers_to_others();
    std::thread([&] { expect_answers_to_others(); }).join();
  };
  std::vector<Hitf> hits;
  EXPECT_TRUE(ask_with(ask_twice, hits));
  EXPECT_EQ(hits, expected);
  EXPECT_EQ(state().pairs.size(), 2U);
  expect_idle(state());
}

/// Both batches are in their executors at the same time.
TEST_F(GpuSlotsTest, executors_may_wait_for_each_other) {
  std::promise<void> began[2];
  std::future<void> begins[2] = {began[0].get_future(), began[1].get_future()};
  const auto ask = [&](std::size_t own) {
    const auto meet = [&] {
      began[own].set_value();
      EXPECT_EQ(begins[1 - own].wait_for(std::chrono::seconds(50)), std::future_status::ready);
    };
    std::vector<Hitf> hits;
    EXPECT_TRUE(ask_with(meet, hits));
    EXPECT_EQ(hits, expected);
  };
  std::thread other([&] { ask(1); });
  ask(0);
  other.join();
}

TEST_F(GpuSlotsTest, batches_in_turn_have_the_same_slots) {
  for (int i = 0; i < 10; ++i) {
    std::vector<Hitf> hits(100);
    EXPECT_TRUE(on_gpu.first_hits(std::span(paths).first(100), hits));
  }
  EXPECT_EQ(state().pairs.size(), 1U);
}

TEST_F(GpuSlotsTest, slots_of_few_batches_are_kept) {
  expect_answers_to_others();  // The slots that are there grow.
  give_back = std::exchange(state().vulkan.FreeMemory, counted_free);
  freed = 0;
  const std::function<void(int)> nest = [&](int depth) {
    std::vector<Hitf> hits;
    EXPECT_TRUE(ask_with([&] { depth > 1 ? nest(depth - 1) : expect_answers_to_others(); }, hits));
    EXPECT_EQ(hits, expected);
  };
  nest(5);
  EXPECT_EQ(state().pairs.size(), 4U);
  EXPECT_EQ(freed, 2 * 16);
  expect_idle(state());
  state().vulkan.FreeMemory = give_back;
}

/// The memory ends while the second slot of an inner batch grows, and the first one is under way.
TEST_F(GpuSlotsTest, a_batch_without_memory_for_slots_fails_alone) {
  const auto ask_without_memory = [&] {
    allocate = std::exchange(state().vulkan.AllocateMemory, no_memory);
    calls_left = 9;
    std::vector<Hitf> hits(others.size());
    const GpuBatchResult refused = on_gpu.first_hits(others, hits);
    EXPECT_FALSE(refused);
    EXPECT_EQ(refused.finished, 0U);
    ASSERT_TRUE(refused.error);
    EXPECT_EQ(refused.error->reason, Reason::out_of_memory);
    EXPECT_STREQ(refused.error->what(), "too little memory on the device for a batch");
    EXPECT_TRUE(on_gpu.first_hits(others, hits, {}, {.goes_on_without_device = true}));
    EXPECT_EQ(hits, expected_of_others);
    state().vulkan.AllocateMemory = allocate;
  };
  std::vector<Hitf> hits;
  EXPECT_TRUE(ask_with(ask_without_memory, hits));
  EXPECT_EQ(hits, expected);
  EXPECT_EQ(state().pairs.size(), 2U);
  expect_idle(state());
}

std::uint64_t largest_allocation = 0;
VKAPI_ATTR VkResult VKAPI_CALL allocate_small(VkDevice on, const VkMemoryAllocateInfo* info,
                                              const VkAllocationCallbacks* callbacks, VkDeviceMemory* memory) {
  if (info->allocationSize <= largest_allocation) return allocate(on, info, callbacks, memory);
  *memory = VK_NULL_HANDLE;
  return VK_ERROR_OUT_OF_DEVICE_MEMORY;
}

/// Dispatches begin with 65,536 paths, whose list takes more than the device has. The last one begins anew too.
TEST_F(GpuSlotsTest, dispatches_for_which_there_is_no_memory_become_smaller) {
  draw(25'000);
  device = any_gpu();
  on_gpu = GpuCollider(device, collider);
  const std::uint32_t initial = state().dispatch_size.paths();
  allocate = std::exchange(state().vulkan.AllocateMemory, allocate_small);
  largest_allocation = std::uint64_t{10'000} * sizeof(detail::ListedPath);
  std::vector<Hitf> hits(paths.size());
  GpuStatistics statistics;
  EXPECT_TRUE(on_gpu.first_hits(paths, hits, {}, {.statistics = &statistics}));
  EXPECT_EQ(hits, expected);
  EXPECT_LE(state().dispatch_size.paths(), 8192U);
  EXPECT_LT(state().dispatch_size.paths(), initial);
  EXPECT_GE(statistics.dispatches, 4U);
  largest_allocation = 1000;
  state().pairs.clear();
  const GpuBatchResult refused = on_gpu.first_hits(paths, hits);
  ASSERT_TRUE(refused.error);
  EXPECT_EQ(refused.error->reason, Reason::out_of_memory);
  EXPECT_EQ(refused.finished, 0U);
  state().vulkan.AllocateMemory = allocate;
}

/// The batch has a dispatch under way by then. It gives the device no more, or does not wait for what it has.
TEST_F(GpuSlotsTest, a_batch_sees_that_another_has_lost_the_device) {
  for (const std::size_t count : {std::size_t{8750}, std::size_t{17'500}}) {
    draw(count);
    device = with_small_dispatches(any_gpu());
    on_gpu = GpuCollider(device, collider);
    const auto lose = [&] {
      submit = std::exchange(state().vulkan.QueueSubmit, no_submit);
      submit_result = VK_ERROR_DEVICE_LOST;
      calls_left = 0;
      std::vector<Hitf> hits(others.size());
      EXPECT_EQ(on_gpu.first_hits(others, hits).error->reason, Reason::device_lost);
      calls_left = 100;  // The device would work again.
    };
    std::vector<Hitf> hits;
    const GpuBatchResult result = ask_with(lose, hits, {.goes_on_without_device = true});
    EXPECT_TRUE(result);
    EXPECT_EQ(hits, expected);
    ASSERT_TRUE(result.error);
    EXPECT_EQ(result.error->reason, Reason::device_lost);
    EXPECT_EQ(calls_left, 100);
  }
}

/// While both slots of the inner batch are under way, an allocation fails.
TEST_F(GpuSlotsTest, a_batch_without_memory_leaves_others_their_answers) {
  const auto ask_and_throw = [&] {
    wait_for = std::exchange(state().vulkan.WaitForFences, no_wait);
    wait_result = VK_SUCCESS;
    calls_left = 0;
    failures_left = 1;
    std::vector<Hitf> hits(others.size());
    const GpuBatchResult result = on_gpu.first_hits(others, hits);
    ASSERT_TRUE(result.error);
    EXPECT_EQ(result.error->reason, Reason::out_of_memory);
    EXPECT_EQ(result.finished, 0U);
    state().vulkan.WaitForFences = wait_for;
  };
  std::vector<Hitf> hits;
  EXPECT_TRUE(ask_with(ask_and_throw, hits));
  EXPECT_EQ(hits, expected);
  expect_idle(state());
}

std::atomic<bool> is_in_queue = false;
std::atomic<bool> have_met = false;
VKAPI_ATTR VkResult VKAPI_CALL slow_submit(VkQueue queue, std::uint32_t count, const VkSubmitInfo* work,
                                           VkFence fence) {
  if (is_in_queue.exchange(true)) have_met = true;
  std::this_thread::sleep_for(std::chrono::milliseconds(2));
  const VkResult result = submit(queue, count, work, fence);
  is_in_queue = false;
  return result;
}

/// Vulkan allows no more.
TEST_F(GpuSlotsTest, one_thread_at_a_time_gives_work_to_the_queue) {
  submit = std::exchange(state().vulkan.QueueSubmit, slow_submit);
  const auto ask = [&] {
    std::vector<std::uint8_t> blocked(100);
    for (int i = 0; i < 10; ++i) EXPECT_TRUE(on_gpu.any_hits(std::span(paths).first(100), blocked));
  };
  std::thread other(ask);
  ask();
  other.join();
  EXPECT_FALSE(have_met);
  state().vulkan.QueueSubmit = submit;
}

}  // namespace
}  // namespace surehit::test::gpu_slots_test
