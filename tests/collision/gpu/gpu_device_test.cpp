#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <limits>
#include <map>
#include <new>
#include <set>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "device_arithmetic.hpp"
#include "gpu/device_answers.hpp"
#include "gpu/gpu_device_state.hpp"
#include "gpu_answers.hpp"
#include "roundings.spv.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/random.hpp"
#include "tree_walk.spv.hpp"

namespace surehit::test {
namespace {

using detail::DeviceReport;
using detail::GpuDeviceState;
using detail::RoundingCase;
using detail::RoundingResult;
using Reason = GpuError::Reason;

/// A device that has all that is needed.
DeviceReport good_report() {
  DeviceReport report;
  report.properties.apiVersion = VK_API_VERSION_1_1;
  report.properties.limits.maxComputeWorkGroupInvocations = 128;
  report.properties.limits.maxComputeWorkGroupSize[0] = 128;
  report.properties.limits.maxComputeWorkGroupCount[0] = 65535;
  report.properties.limits.maxPerStageDescriptorStorageBuffers = 8;
  report.memory.memoryTypeCount = 2;
  report.memory.memoryTypes[0].propertyFlags = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
  report.memory.memoryTypes[1].propertyFlags =
      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  report.families.resize(2);
  report.families[0] = {VK_QUEUE_TRANSFER_BIT, 1, 0, {}};
  report.families[1] = {VK_QUEUE_COMPUTE_BIT, 1, 0, {}};
  return report;
}

TEST(GpuNeedsTest, a_device_that_lacks_something_is_refused_with_the_reason) {
  EXPECT_EQ(detail::missing_of(good_report()), "");
  EXPECT_EQ(detail::computing_family(good_report()), 1U);
  const auto missing = [](const auto& change) {
    DeviceReport report = good_report();
    change(report);
    return detail::missing_of(report);
  };
  EXPECT_EQ(missing([](DeviceReport& report) { report.properties.apiVersion = VK_API_VERSION_1_0; }), "Vulkan 1.1");
  EXPECT_EQ(missing([](DeviceReport& report) { report.families.pop_back(); }), "a queue that computes");
  EXPECT_EQ(missing([](DeviceReport& report) { report.families[1].queueCount = 0; }), "a queue that computes");
  EXPECT_EQ(missing([](DeviceReport& report) { report.memory.memoryTypeCount = 1; }), "memory that the host sees");
  EXPECT_EQ(missing([](DeviceReport& report) { report.memory.memoryTypes[0].propertyFlags = 0; }), "memory of its own");
  EXPECT_EQ(missing([](DeviceReport& report) { report.properties.limits.maxComputeWorkGroupInvocations = 63; }),
            "work groups of 64 threads");
  EXPECT_EQ(missing([](DeviceReport& report) { report.properties.limits.maxPerStageDescriptorStorageBuffers = 5; }),
            "six buffers for a shader");
}

/// What a simulated device computes.
std::vector<RoundingResult> rounded_on_device(const std::vector<RoundingCase>& cases) {
  DeviceArithmetic device;
  std::vector<RoundingResult> results;
  for (const RoundingCase& numbers : cases) {
    const DeviceFloat a = numbers[0];
    const DeviceFloat b = numbers[1];
    const DeviceFloat c = numbers[2];
    const auto sum = device.sum_of(a, b);
    const auto product = device.product_of(a, b);
    results.push_back({(a + b).value(), (a - b).value(), (a * b).value(), (a / b).value(), (a * b + c).value(),
                       sum.high.value(), sum.low.value(), product.high.value(), product.low.value()});
  }
  return results;
}

TEST(GpuRoundingTest, any_device_that_rounds_as_vulkan_says_will_do) {
  const std::vector<RoundingCase> cases = detail::rounding_cases();
  on_every_device([&] { EXPECT_EQ(detail::rounding_fault(cases, rounded_on_device(cases)).value_or(""), ""); });
}

TEST(GpuRoundingTest, a_device_that_rounds_otherwise_is_refused) {
  const std::vector<RoundingCase> cases = detail::rounding_cases();
  const auto fault = [&](const auto& change) {
    std::vector<RoundingResult> results = rounded_on_device(cases);
    for (std::size_t i = 0; i < cases.size(); ++i) change(cases[i], results[i]);
    return detail::rounding_fault(cases, results).value_or("");
  };
  constexpr float infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(fault([](const RoundingCase&, RoundingResult&) {}), "");
  // One ulp from the nearest number is not always a neighbour.
  EXPECT_NE(fault([](const RoundingCase&, RoundingResult& x) { x[0] = std::nextafter(x[0], infinity); }), "");
  EXPECT_NE(fault([](const RoundingCase&, RoundingResult& x) { x[1] = std::nextafter(x[1], -infinity); }), "");
  EXPECT_NE(fault([](const RoundingCase&, RoundingResult& x) { x[2] = std::nextafter(x[2], infinity); }), "");
  // A quotient may be off by 2.5 ulp, but not by more.
  const auto move = [](float x, int steps) {
    for (; steps > 0; --steps) x = std::nextafter(x, infinity);
    return x;
  };
  EXPECT_EQ(fault([&](const RoundingCase&, RoundingResult& x) { x[3] = move(x[3], 1); }), "");
  EXPECT_NE(fault([&](const RoundingCase&, RoundingResult& x) { x[3] = move(x[3], 4); }), "");
  for (const float lost : {0.0F, infinity, std::nanf("")}) {
    EXPECT_NE(fault([&](const RoundingCase&, RoundingResult& x) { x[3] = lost; }), "") << lost;
  }
  const std::string fused =
      fault([](const RoundingCase& of, RoundingResult& x) { x[4] = std::fma(of[0], of[1], of[2]); });
  EXPECT_EQ(fused.find("it computes the product and the sum of "), 0U) << fused;
  // A device that simplifies (x + y) - x to y finds nothing in the low part of a sum, and NaN is no low part.
  for (const float lost : {0.0F, std::nanf("")}) {
    const std::string sum = fault([&](const RoundingCase&, RoundingResult& x) { x[6] = lost; });
    EXPECT_EQ(sum.find("it computes the low part of the sum of "), 0U) << sum;
    const std::string product = fault([&](const RoundingCase&, RoundingResult& x) { x[8] = lost; });
    EXPECT_EQ(product.find("it computes the low part of the product of "), 0U) << product;
  }
  EXPECT_NE(fault([&](const RoundingCase&, RoundingResult& x) { x[8] = move(x[8], 1); }), "");
  // Denormals may be lost.
  const auto flushed = [](float x) { return std::fabs(x) < std::numeric_limits<float>::min() ? 0 : x; };
  EXPECT_EQ(fault([&](const RoundingCase& of, RoundingResult& x) {
              const float a = flushed(of[0]);
              const float b = flushed(of[1]);
              x[0] = flushed(a + b);
              x[1] = flushed(a - b);
              x[2] = flushed(a * b);
              x[4] = flushed(flushed(a * b) + flushed(of[2]));
            }),
            "");
  EXPECT_NE(detail::rounding_fault(cases, {}).value_or(""), "");
}

/// All sums, differences, products and quotients of floats that may be fused with another one (G1).
std::size_t fusible(std::span<const std::uint32_t> shader, std::size_t& all) {
  constexpr std::uint32_t decorate = 71;
  constexpr std::uint32_t no_contraction = 42;
  const std::set<std::uint32_t> arithmetic = {129, 131, 133, 136, 140, 141, 142, 143, 144, 145, 146, 148};
  std::set<std::uint32_t> kept;
  std::vector<std::uint32_t> results;
  for (std::size_t at = 5; at < shader.size(); at += shader[at] >> 16) {
    const std::uint32_t operation = shader[at] & 0xffff;
    if (operation == decorate && shader[at + 2] == no_contraction) kept.insert(shader[at + 1]);
    if (arithmetic.contains(operation)) results.push_back(shader[at + 2]);
  }
  all = results.size();
  std::size_t count = 0;
  for (const std::uint32_t result : results) count += kept.contains(result) ? 0 : 1;
  return count;
}

TEST(GpuShaderTest, no_operation_may_be_fused) {
  std::size_t all = 0;
  EXPECT_EQ(fusible(tree_walk_spirv, all), 0U);
  EXPECT_GT(all, 60U);
  EXPECT_EQ(fusible(roundings_spirv, all), 0U);
  EXPECT_GE(all, 20U);  // Six operations, 3 of a sum in two floats, and 11 of a product.
}

TEST(GpuLoaderTest, without_a_loader_there_is_an_error) {
  GpuDeviceState state;
  const auto error = state.start("libvulkan-that-is-not-there.so.1");
  ASSERT_TRUE(error);
  EXPECT_EQ(error->reason, Reason::no_loader);
  EXPECT_NE(std::string(error->what()).find("libvulkan-that-is-not-there.so.1"), std::string::npos);
  GpuDeviceState strange;
  const auto no_vulkan = strange.start("libc.so.6");
  ASSERT_TRUE(no_vulkan);
  EXPECT_EQ(no_vulkan->reason, Reason::no_loader);
}

TEST(GpuLoaderTest, without_a_driver_there_is_an_error) {
  setenv("VK_ICD_FILENAMES", "/no_driver.json", 1);
  setenv("VK_DRIVER_FILES", "/no_driver.json", 1);
  GpuDevice device;
  const GpuResult opened = device.try_open({.takes_software = true});
  ASSERT_FALSE(opened);
  const bool has_loader = opened.error().reason != Reason::no_loader;
  EXPECT_EQ(opened.error().reason, has_loader ? Reason::no_device : Reason::no_loader) << opened.error().what();
  EXPECT_FALSE(device.is_open());
  unsetenv("VK_ICD_FILENAMES");
  unsetenv("VK_DRIVER_FILES");
}

TEST(GpuLoaderTest, each_failure_has_its_reason) {
  const auto reason = [](VkResult result) { return detail::error_of(result, "while testing")->reason; };
  EXPECT_FALSE(detail::error_of(VK_SUCCESS, ""));
  EXPECT_EQ(reason(VK_ERROR_OUT_OF_HOST_MEMORY), Reason::out_of_memory);
  EXPECT_EQ(reason(VK_ERROR_INCOMPATIBLE_DRIVER), Reason::no_device);
  EXPECT_EQ(reason(VK_TIMEOUT), Reason::device_lost);
  EXPECT_EQ(reason(VK_ERROR_UNKNOWN), Reason::failed);
  EXPECT_STREQ(detail::error_of(VK_ERROR_DEVICE_LOST, "while testing")->what(),
               "the device was lost while testing; it must be opened anew");
}

class GpuDeviceTest : public testing::Test {
 protected:
  void SetUp() override {
    SUREHIT_SKIP_WITHOUT(device);
    Random random(1);
    collider = Colliderf(rough_ground<float>(20, 0.1F, random).view());
    for (std::size_t i = 0; i < 140'000; ++i) {
      const auto x = random.symmetric<float>();
      const auto y = random.symmetric<float>();
      paths.push_back({{x, y, 1}, {x, y + 0.125F, random.unit<float>() - 0.5F}});
    }
    expected.resize(paths.size());
    collider.first_hits(paths, expected);
  }
  [[nodiscard]] GpuDeviceState& state() const { return *GpuDeviceState::of(device); }
  /// No fence has been signaled, nor will be.
  void expect_idle() const {
    const detail::VulkanFunctions& vulkan = state().vulkan;
    for (const detail::GpuSlot& slot : state().slots) {
      EXPECT_FALSE(slot.is_under_way);
      EXPECT_EQ(vulkan.WaitForFences(state().device, 1, &slot.fence, VK_TRUE, 0), VK_TIMEOUT);
    }
  }

  GpuDevice device = any_gpu();
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

/// Functions of Vulkan that fail after some calls.
int calls_left = 0;
PFN_vkAllocateMemory allocate = nullptr;
VKAPI_ATTR VkResult VKAPI_CALL no_memory(VkDevice device, const VkMemoryAllocateInfo* info,
                                         const VkAllocationCallbacks* callbacks, VkDeviceMemory* memory) {
  if (calls_left-- > 0) return allocate(device, info, callbacks, memory);
  std::memset(memory, 0x55, sizeof *memory);  // Vulkan leaves it undefined.
  return VK_ERROR_OUT_OF_DEVICE_MEMORY;
}
PFN_vkQueueSubmit submit = nullptr;
VkResult submit_result = VK_SUCCESS;
VKAPI_ATTR VkResult VKAPI_CALL no_submit(VkQueue queue, std::uint32_t count, const VkSubmitInfo* work, VkFence fence) {
  return calls_left-- > 0 ? submit(queue, count, work, fence) : submit_result;
}

PFN_vkWaitForFences wait_for = nullptr;
VkResult wait_result = VK_SUCCESS;
int failures_left = 0;
VKAPI_ATTR VkResult VKAPI_CALL no_wait(VkDevice device, std::uint32_t count, const VkFence* fences, VkBool32 all,
                                       std::uint64_t timeout) {
  if (calls_left-- > 0 || failures_left-- <= 0) return wait_for(device, count, fences, all, timeout);
  if (wait_result == VK_SUCCESS) throw std::bad_alloc();
  return wait_result;
}
PFN_vkResetFences reset = nullptr;
VKAPI_ATTR VkResult VKAPI_CALL no_reset(VkDevice device, std::uint32_t count, const VkFence* fences) {
  return calls_left-- > 0 ? reset(device, count, fences) : VK_ERROR_OUT_OF_DEVICE_MEMORY;
}
GpuDeviceState* faulty = nullptr;
detail::DeviceHit faulty_answer = {};
VKAPI_ATTR VkResult VKAPI_CALL faulty_answers(VkDevice device, std::uint32_t count, const VkFence* fences, VkBool32 all,
                                              std::uint64_t timeout) {
  const VkResult result = wait_for(device, count, fences, all, timeout);
  for (const detail::GpuSlot& slot : faulty->slots) {
    if (slot.fence != *fences) continue;
    for (std::size_t i = 0; i < 1000; ++i) {
      std::memcpy(slot.host_answers.data() + i * sizeof faulty_answer, &faulty_answer, sizeof faulty_answer);
    }
  }
  return result;
}
PFN_vkFreeMemory give_back = nullptr;
int freed = 0;
VKAPI_ATTR void VKAPI_CALL counted_free(VkDevice device, VkDeviceMemory memory,
                                        const VkAllocationCallbacks* callbacks) {
  ++freed;
  give_back(device, memory, callbacks);
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
  calls_left = 2;
  std::vector<Hitf> hits(paths.size(), unset);
  const GpuBatchResult result = on_gpu.first_hits(paths, hits);
  EXPECT_FALSE(result);
  ASSERT_TRUE(result.error);
  EXPECT_EQ(result.error->reason, Reason::out_of_memory);
  EXPECT_EQ(result.finished, std::size_t{1} << 16);
  for (std::size_t i = 0; i < hits.size(); ++i) ASSERT_EQ(hits[i], i < result.finished ? expected[i] : unset) << i;

  calls_left = 1;
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

/// While two dispatches are under way, an allocation fails. The next batch has other paths, and gets its own answers.
TEST_F(GpuDeviceTest, a_batch_that_throws_leaves_no_work_under_way) {
  const GpuCollider on_gpu(device, collider);
  std::vector<Hitf> hits(paths.size());
  wait_for = std::exchange(state().vulkan.WaitForFences, no_wait);
  wait_result = VK_SUCCESS;
  calls_left = 1;
  failures_left = 1;
  EXPECT_THROW(static_cast<void>(on_gpu.first_hits(paths, hits)), std::bad_alloc);
  state().vulkan.WaitForFences = wait_for;
  expect_idle();
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
  expect_idle();
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
    std::vector<Hitf> hits(paths.size());
    wait_for = std::exchange(state().vulkan.WaitForFences, no_wait);
    give_back = std::exchange(state().vulkan.FreeMemory, counted_free);
    wait_result = result;
    calls_left = 0;
    failures_left = answers_at_last ? 1 : 1000;
    EXPECT_EQ(on_gpu.first_hits(paths, hits).error->reason, reason);
    freed = 0;
    on_gpu = GpuCollider();
    EXPECT_EQ(freed, 0);
    device = GpuDevice();
    EXPECT_EQ(freed, answers_at_last ? 18 : 0);  // Those of the mesh and of two slots.
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
                                       std::pair(0U, 3U), std::pair(0U, 4U), std::pair(0U, odd)}) {
    faulty_answer = {0.5F, 0.5F, 0.5F, triangle, side};
    EXPECT_TRUE(on_gpu.first_hits(paths, hits));
    EXPECT_EQ(hits, expected);
  }
  const auto number = std::bit_cast<float>(odd);
  faulty_answer = {number, number, number, odd, odd};  // Words that are no answer to `any_hits` either.
  EXPECT_TRUE(on_gpu.any_hits(paths, blocked));
  EXPECT_EQ(blocked, expected_blocked);
  // Nearly all paths miss the first triangle. The host finds out where it rounds.
  faulty_answer = {0, 0, 0, 0, 1 + detail::DeviceHit::is_not_rounded};
  EXPECT_TRUE(on_gpu.first_hits(paths, hits));
  EXPECT_EQ(hits, expected);
  state().vulkan.WaitForFences = wait_for;
}

/// An executor of the host's batch may use the device.
TEST_F(GpuDeviceTest, a_batch_that_goes_on_without_its_device_does_not_hold_it) {
  const GpuCollider on_gpu(device, collider);
  state().is_lost = true;
  std::vector<Hitf> hits(paths.size());
  bool is_free = false;
  const auto run = [&](std::size_t count, const Executor::Task& task) {
    std::thread([&] {
      is_free = state().mutex.try_lock();
      if (is_free) state().mutex.unlock();
    }).join();
    for (std::size_t i = 0; i < count; ++i) task(i);
  };
  EXPECT_TRUE(on_gpu.first_hits(paths, hits, {.executor = run}, {.goes_on_without_device = true}));
  EXPECT_EQ(hits, expected);
  EXPECT_TRUE(is_free);
}

/// Khronos's layer looks at each call. It writes what it finds to standard output.
TEST(GpuValidationTest, the_validation_layer_has_nothing_to_say) {
  if (!std::filesystem::exists("/usr/share/vulkan/explicit_layer.d/VkLayer_khronos_validation.json")) {
    GTEST_SKIP() << "no validation layer here";
  }
  setenv("VK_INSTANCE_LAYERS", "VK_LAYER_KHRONOS_validation", 1);
  testing::internal::CaptureStdout();
  bool is_open = false;
  {
    Random random(1);
    Colliderf collider(rough_ground<float>(20, 0.1F, random).view());
    const GpuDevice device = any_gpu();
    is_open = device.is_open();
    if (is_open) {
      GpuCollider on_gpu(device, collider);
      collider.set_mask(1, 2);
      on_gpu.update();
      const std::vector<Segmentf> paths(150'000, {{0.25F, 0.5F, 1}, {0.25F, 0.5F, -1}});
      expect_same_as_host(on_gpu, collider, paths);
    }
  }
  unsetenv("VK_INSTANCE_LAYERS");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  if (!is_open) GTEST_SKIP() << "no Vulkan device here";
}

}  // namespace
}  // namespace surehit::test
