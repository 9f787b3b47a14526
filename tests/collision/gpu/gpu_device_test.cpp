#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "faulty_vulkan.hpp"
#include "gpu/device_answers.hpp"
#include "gpu/gpu_device_state.hpp"
#include "gpu_answers.hpp"
#include "lost_device.hpp"
#include "reused_device.hpp"
#include "small_dispatches.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/random.hpp"
#include "validation_layer.hpp"

namespace surehit::test::gpu_device_test {
namespace {

using detail::GpuDeviceState;
using Reason = GpuError::Reason;

class GpuDeviceTest : public testing::Test {
 protected:
  static void TearDownTestSuite() { device = GpuDevice(); }
  void SetUp() override {
    renew(device, [] { return any_gpu(); });
    SUREHIT_SKIP_WITHOUT(device);
    Random random(1);
    collider = Colliderf(rough_ground<float>(20, 0.1F, random).view());
    for (std::size_t i = 0; i < 17'500; ++i) {
      const auto x = random.symmetric<float>();
      const auto y = random.symmetric<float>();
      paths.push_back({{x, y, 1}, {x, y + 0.125F, random.unit<float>() - 0.5F}});
    }
    expected.resize(paths.size());
    collider.first_hits(paths, expected);
  }
  [[nodiscard]] GpuDeviceState& state() const { return *GpuDeviceState::of(device); }

  static inline GpuDevice device;
  Colliderf collider;
  std::vector<Segmentf> paths;
  std::vector<Hitf> expected;
};

TEST_F(GpuDeviceTest, devices_are_listed_and_opened_by_name) {
  bool is_listed = false;
  for (const GpuDescription& description : GpuDevice::list()) is_listed |= description.name == device.name();
  EXPECT_TRUE(is_listed);
  EXPECT_EQ(GpuDevice::open({.name = device.name()}).name(), device.name());
  GpuDevice other;
  const GpuResult opened = other.try_open({.name = "no device of this name"});
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().reason, Reason::no_device);
  EXPECT_NE(std::string(opened.error().what()).find(device.name()), std::string::npos);
  EXPECT_FALSE(other.is_open());
  GpuCollider on_gpu;
  const GpuResult uploaded = on_gpu.try_upload(other, collider);
  ASSERT_FALSE(uploaded);
  EXPECT_EQ(uploaded.error().reason, Reason::no_device);
}

PFN_vkGetDeviceProcAddr get_function = nullptr;
PFN_vkDestroyDevice destroy = nullptr;
int faulty_devices = 0;
int closed_devices = 0;
VKAPI_ATTR void VKAPI_CALL counted_close(VkDevice device, const VkAllocationCallbacks* callbacks) {
  ++closed_devices;
  destroy(device, callbacks);
}
VKAPI_ATTR VkResult VKAPI_CALL no_fence(VkDevice, const VkFenceCreateInfo*, const VkAllocationCallbacks*, VkFence*) {
  return VK_ERROR_OUT_OF_HOST_MEMORY;
}
/// Devices that make no fences, until enough of them were opened.
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL faulty_function(VkDevice device, const char* name) {
  const PFN_vkVoidFunction function = get_function(device, name);
  if (std::string(name) == "vkDestroyDevice") {
    destroy = reinterpret_cast<PFN_vkDestroyDevice>(function);
    return reinterpret_cast<PFN_vkVoidFunction>(counted_close);
  }
  if (std::string(name) == "vkCreateFence" && faulty_devices-- > 0) {
    return reinterpret_cast<PFN_vkVoidFunction>(no_fence);
  }
  return function;
}

TEST_F(GpuDeviceTest, devices_that_will_not_do_are_passed_over) {
  std::vector<detail::FoundDevice> found;
  GpuDeviceState several;
  ASSERT_FALSE(several.start());
  ASSERT_FALSE(several.find(found));
  std::erase_if(found, [&](const auto& one) { return one.second.properties.deviceName != device.name(); });
  ASSERT_FALSE(found.empty());
  const detail::FoundDevice sound = found.front();
  detail::FoundDevice old = sound;
  old.second.properties.apiVersion = VK_API_VERSION_1_0;
  get_function = std::exchange(several.vulkan.GetDeviceProcAddr, faulty_function);
  faulty_devices = 2;
  found = {old, sound, sound};
  const auto error = several.open_first(found);
  ASSERT_TRUE(error);
  EXPECT_EQ(error->reason, Reason::missing_feature);
  EXPECT_EQ(closed_devices, 2);
  faulty_devices = 1;
  EXPECT_FALSE(several.open_first(found));
  EXPECT_EQ(closed_devices, 3);
  EXPECT_EQ(several.name, device.name());
}

int waits_before_wrong_answers = 0;
GpuDeviceState* answering = nullptr;
/// The answers of one dispatch, and of no other, are words that no sound device writes.
VKAPI_ATTR VkResult VKAPI_CALL wrong_answers(VkDevice device, std::uint32_t count, const VkFence* fences, VkBool32 all,
                                             std::uint64_t timeout) {
  const VkResult result = wait_for(device, count, fences, all, timeout);
  if (waits_before_wrong_answers-- == 0) {
    std::memset(answering->pairs.front()->slots[0].host_answers.data(), 0x55, sizeof(detail::DeviceHit));
  }
  return result;
}
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL wrong_function(VkDevice device, const char* name) {
  const PFN_vkVoidFunction function = get_function(device, name);
  if (std::string(name) != "vkWaitForFences") return function;
  wait_for = reinterpret_cast<PFN_vkWaitForFences>(function);
  return reinterpret_cast<PFN_vkVoidFunction>(wrong_answers);
}

/// Devices that are asked for known answers, and give wrong ones after some waits.
class GpuDeviceTestOfAnswers : public GpuDeviceTest {
 protected:
  void SetUp() override {
    GpuDeviceTest::SetUp();
    if (IsSkipped()) return;
    ASSERT_FALSE(asked_.start());
    ASSERT_FALSE(asked_.find(found_));
    std::erase_if(found_, [&](const auto& one) { return one.second.properties.deviceName != device.name(); });
    ASSERT_FALSE(found_.empty());
    get_function = std::exchange(asked_.vulkan.GetDeviceProcAddr, wrong_function);
    answering = &asked_;
    detail::WalkCheck::is_on = true;
    waits_before_wrong_answers = many_waits;
  }

  /// Calls `ask`, whose answers are wrong after so many waits, and expects this fault.
  template <typename Ask>
  void expect_fault(int waits, const std::string& fault, const Ask& ask) {
    waits_before_wrong_answers = waits;
    const std::optional<GpuError> error = ask();
    ASSERT_TRUE(error) << waits;
    EXPECT_EQ(error->reason, Reason::missing_feature);
    EXPECT_EQ(std::string(error->what()).find(device.name() + " cannot be used: " + fault), 0U) << error->what();
    waits_before_wrong_answers = many_waits;
  }

  static constexpr int many_waits = 100;
  GpuDeviceState asked_;
  std::vector<detail::FoundDevice> found_;
};

/// A device is waited for when it has rounded numbers, when it has the nodes and the triangles of a mesh, and when it
/// has answered with first hits and with any hits.
TEST_F(GpuDeviceTestOfAnswers, a_device_that_answers_wrongly_is_refused) {
  const auto open = [&] { return asked_.open_first(found_); };
  expect_fault(0, "it computes the sum of ", open);
  expect_fault(3, "it answers path 0 of a check by ", open);
  expect_fault(4, "it answers 1431655765 whether path 0 of a check ", open);
  EXPECT_FALSE(open());
  EXPECT_EQ(waits_before_wrong_answers, many_waits - 5);
}

/// A device is waited for when it has the four buffers of a scene, and when it has answered with first hits and with
/// any hits.
TEST_F(GpuDeviceTestOfAnswers, a_device_that_answers_wrongly_in_a_scene_takes_none) {
  ASSERT_FALSE(asked_.open_first(found_));
  const auto prepare = [&] { return asked_.prepare_scenes(); };
  expect_fault(4, "it answers path 0 of a check of scenes by ", prepare);
  expect_fault(5, "it answers 1431655765 whether path 0 of a check of scenes ", prepare);
  EXPECT_FALSE(prepare());
  EXPECT_EQ(waits_before_wrong_answers, many_waits - 6);
  EXPECT_FALSE(prepare()) << "it is asked once";
  EXPECT_EQ(waits_before_wrong_answers, many_waits - 6);
}

TEST_F(GpuDeviceTest, an_upload_without_memory_changes_nothing) {
  GpuCollider on_gpu(device, collider);
  allocate = std::exchange(state().vulkan.AllocateMemory, no_memory);
  for (const int calls : {0, 1}) {
    calls_left = calls;
    const GpuResult updated = on_gpu.try_update();
    ASSERT_FALSE(updated);
    EXPECT_EQ(updated.error().reason, Reason::out_of_memory);
    EXPECT_NE(std::string(updated.error().what()).find(calls == 0 ? "nodes" : "triangles"), std::string::npos);
  }
  calls_left = 100;
  const auto memory = state().report.memory;
  for (VkMemoryHeap& heap : state().report.memory.memoryHeaps) heap.size = 1000;
  const GpuResult too_much = on_gpu.try_update();
  ASSERT_FALSE(too_much);
  EXPECT_EQ(too_much.error().reason, Reason::out_of_memory);
  EXPECT_EQ(calls_left, 100);  // The driver is not asked for more than there is.
  state().report.memory = memory;
  state().vulkan.AllocateMemory = allocate;
  std::vector<Hitf> hits(paths.size());
  EXPECT_TRUE(on_gpu.first_hits(paths, hits));
  EXPECT_EQ(hits, expected);
  const auto max = std::exchange(state().report.properties.limits.maxStorageBufferRange, 1000);
  const GpuResult updated = on_gpu.try_update();
  ASSERT_FALSE(updated);
  EXPECT_EQ(updated.error().reason, Reason::too_large);
  state().report.properties.limits.maxStorageBufferRange = max;
}

/// A batch of three dispatches ends before its last one. What has no answer is as before, unless the host goes on.
TEST_F(GpuDeviceTest, a_device_that_fails_in_the_middle_leaves_the_rest) {
  const GpuCollider on_gpu(device, collider);
  const Hitf unset{.t = 7, .triangle = 7};
  submit = std::exchange(state().vulkan.QueueSubmit, no_submit);
  submit_result = VK_ERROR_OUT_OF_DEVICE_MEMORY;
  calls_left = 2 * submissions_of_dispatch(state());
  std::vector<Hitf> hits(paths.size(), unset);
  const GpuBatchResult result = on_gpu.first_hits(paths, hits);
  EXPECT_FALSE(result);
  ASSERT_TRUE(result.error);
  EXPECT_EQ(result.error->reason, Reason::out_of_memory);
  EXPECT_EQ(result.finished, paths_in_small_dispatch);
  for (std::size_t i = 0; i < hits.size(); ++i) ASSERT_EQ(hits[i], i < result.finished ? expected[i] : unset) << i;

  calls_left = submissions_of_dispatch(state());
  GpuStatistics statistics;
  const GpuBatchResult rest =
      on_gpu.first_hits(paths, hits, {}, {.goes_on_without_device = true, .statistics = &statistics});
  EXPECT_TRUE(rest);
  EXPECT_TRUE(rest.error);
  EXPECT_EQ(rest.finished, paths.size());
  EXPECT_EQ(hits, expected);
  EXPECT_EQ(statistics.paths, paths.size());

  calls_left = 100;  // The device works again.
  hits.assign(paths.size(), unset);
  EXPECT_TRUE(on_gpu.first_hits(paths, hits));
  EXPECT_EQ(hits, expected);

  submit_result = VK_ERROR_DEVICE_LOST;
  calls_left = 0;
  EXPECT_EQ(on_gpu.first_hits(paths, hits).error->reason, Reason::device_lost);
  calls_left = 100;  // Nothing more is asked of a lost device.
  EXPECT_EQ(on_gpu.first_hits(paths, hits).error->reason, Reason::device_lost);
  GpuCollider later;
  const GpuResult uploaded = later.try_upload(device, collider);
  ASSERT_FALSE(uploaded);
  EXPECT_EQ(uploaded.error().reason, Reason::device_lost);
  EXPECT_EQ(calls_left, 100);
  EXPECT_TRUE(on_gpu.first_hits(paths, hits, {}, {.goes_on_without_device = true}));
  EXPECT_EQ(hits, expected);
}

/// Whichever call says that the device was lost, the answers of the dispatches before are there, and no others.
TEST_F(GpuDeviceTest, a_device_that_is_lost_in_the_middle_leaves_the_rest) {
  const GpuCollider on_gpu(device, collider);
  for (const LossInBatch& loss : losses_in_batch) {
    expect_lost_in_batch(device, on_gpu, paths, expected, loss);
    ASSERT_FALSE(HasFailure());
  }
}

/// While two dispatches are under way, an allocation fails. The next batch has other paths, and gets its own answers.
TEST_F(GpuDeviceTest, a_batch_without_memory_leaves_no_work_under_way) {
  const GpuCollider on_gpu(device, collider);
  std::vector<Hitf> hits(paths.size());
  wait_for = std::exchange(state().vulkan.WaitForFences, no_wait);
  wait_result = VK_SUCCESS;
  calls_left = 1;
  failures_left = 1;
  const GpuBatchResult result = on_gpu.first_hits(paths, hits);
  ASSERT_TRUE(result.error);
  EXPECT_EQ(result.error->reason, Reason::out_of_memory);
  EXPECT_EQ(result.finished, paths_in_small_dispatch);
  state().vulkan.WaitForFences = wait_for;
  expect_idle(state());
  std::reverse(paths.begin(), paths.end());
  std::reverse(expected.begin(), expected.end());
  EXPECT_TRUE(on_gpu.first_hits(paths, hits));
  EXPECT_EQ(hits, expected);
}

/// A fence that stays signaled would end the next wait at once, before the device has answered.
TEST_F(GpuDeviceTest, a_fence_that_cannot_be_reset_is_not_used_again) {
  const GpuCollider on_gpu(device, collider);
  const std::span<const Segmentf> few = std::span(paths).first(100);
  std::vector<Hitf> hits(few.size());
  reset = std::exchange(state().vulkan.ResetFences, no_reset);
  calls_left = 0;
  const GpuBatchResult failed = on_gpu.first_hits(few, hits);
  state().vulkan.ResetFences = reset;
  ASSERT_TRUE(failed.error);
  EXPECT_EQ(failed.error->reason, Reason::out_of_memory);
  const GpuBatchResult next = on_gpu.first_hits(few, hits);
  ASSERT_TRUE(next.error);
  EXPECT_EQ(next.error->reason, Reason::device_lost);
  EXPECT_EQ(next.finished, 0U);
}

TEST_F(GpuDeviceTest, an_upload_that_fails_leaves_no_work_under_way) {
  GpuCollider on_gpu(device, collider);
  wait_for = std::exchange(state().vulkan.WaitForFences, no_wait);
  wait_result = VK_ERROR_OUT_OF_HOST_MEMORY;
  calls_left = 0;
  failures_left = 1;
  const GpuResult updated = on_gpu.try_update();
  state().vulkan.WaitForFences = wait_for;
  ASSERT_FALSE(updated);
  EXPECT_EQ(updated.error().reason, Reason::out_of_memory);
  expect_idle(state());
  std::vector<Hitf> hits(paths.size());
  EXPECT_TRUE(on_gpu.first_hits(paths, hits));
  EXPECT_EQ(hits, expected);
}

/// A device that has not answered may still read the mesh, so it keeps the mesh until it is closed. Where it still has
/// not answered then, all memory is left to it, and nothing waits for it.
TEST_F(GpuDeviceTest, a_device_that_does_not_answer_keeps_the_mesh) {
  struct Case {
    VkResult result;
    bool answers_at_last;
    Reason reason;
  };
  for (const auto& [result, answers_at_last, reason] :
       {Case{VK_TIMEOUT, false, Reason::device_lost}, Case{VK_TIMEOUT, true, Reason::device_lost},
        Case{VK_ERROR_OUT_OF_HOST_MEMORY, false, Reason::out_of_memory}}) {
    device = any_gpu();
    GpuCollider on_gpu(device, collider);
    // At its end, a device is waited for a second. So it has little to do, and the driver has compiled the shader.
    const std::span<const Segmentf> few = std::span(paths).first(100);
    std::vector<Hitf> hits(few.size());
    ASSERT_TRUE(on_gpu.first_hits(few, hits));
    wait_for = std::exchange(state().vulkan.WaitForFences, no_wait);
    give_back = std::exchange(state().vulkan.FreeMemory, counted_free);
    wait_result = result;
    calls_left = 0;
    failures_left = answers_at_last ? 1 : 1000;
    EXPECT_EQ(on_gpu.first_hits(few, hits).error->reason, reason);
    freed = 0;
    on_gpu = GpuCollider();
    EXPECT_EQ(freed, 0);
    device = GpuDevice();
    EXPECT_EQ(freed, answers_at_last ? 10 : 0);  // Those of the mesh and of one slot.
  }
}

/// The host answers the paths whose answers no sound device gives: ids beyond the last, and triangles that are not hit.
TEST_F(GpuDeviceTest, faulty_answers_of_a_device_are_left_to_the_host) {
  const GpuCollider on_gpu(device, collider);
  faulty = &state();
  wait_for = std::exchange(state().vulkan.WaitForFences, faulty_answers);
  std::vector<Hitf> hits(paths.size());
  std::vector<std::uint8_t> blocked(paths.size());
  std::vector<std::uint8_t> expected_blocked(paths.size());
  collider.any_hits(paths, expected_blocked);
  const auto beyond_the_last = static_cast<std::uint32_t>(collider.triangle_count());
  constexpr std::uint32_t odd = 0xfffffffd;
  for (const auto& [triangle, side] : {std::pair(beyond_the_last, 1U), std::pair(odd, 2U), std::pair(0U, 0U),
                                       std::pair(0U, 4U), std::pair(0U, 7U), std::pair(0U, odd)}) {
    set_faulty_answer(detail::DeviceHit{0.5F, 0.5F, 0.5F, triangle, side});
    EXPECT_TRUE(on_gpu.first_hits(paths, hits));
    EXPECT_EQ(hits, expected);
  }
  const auto number = std::bit_cast<float>(odd);
  set_faulty_answer(
      detail::DeviceHit{number, number, number, odd, odd});  // Words that are no answer to `any_hits` either.
  EXPECT_TRUE(on_gpu.any_hits(paths, blocked));
  EXPECT_EQ(blocked, expected_blocked);
  // Nearly all paths miss the first triangle. The host finds out where it rounds.
  set_faulty_answer(detail::DeviceHit{0, 0, 0, 0, 1 + detail::DeviceHit::is_not_rounded});
  EXPECT_TRUE(on_gpu.first_hits(paths, hits));
  EXPECT_EQ(hits, expected);
  state().vulkan.WaitForFences = wait_for;
}

TEST(GpuValidationTest, the_validation_layer_has_nothing_to_say) {
  expect_nothing_from_validation([](const GpuDevice& device) {
    Random random(1);
    Colliderf collider(rough_ground<float>(20, 0.1F, random).view());
    GpuCollider on_gpu(with_small_dispatches(device), collider);
    collider.set_mask(1, 2);
    on_gpu.update();
    const std::vector<Segmentf> paths(18'000, {{0.25F, 0.5F, 1}, {0.25F, 0.5F, -1}});
    std::thread other([&] { expect_same_as_host(on_gpu, collider, paths); });
    expect_same_as_host(on_gpu, collider, paths);
    other.join();
    Scenef scene;
    const auto shared = std::make_shared<Colliderf>(std::move(collider));
    const InstanceId id = scene.add(shared);
    scene.commit();
    GpuScene scene_on_gpu(device, scene.snapshot());
    expect_same_as_host(scene_on_gpu, scene, paths);
    scene.set_pose(id, Posef::translated({0.125F, 0, 0.25F}));
    scene.commit();
    scene_on_gpu.update(scene.snapshot());
    expect_same_as_host(scene_on_gpu, scene, paths);
  });
}

}  // namespace
}  // namespace surehit::test::gpu_device_test
