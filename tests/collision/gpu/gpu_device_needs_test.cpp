// What the library asks of a device, of its driver and of its shaders. No device is asked.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "device_arithmetic.hpp"
#include "gpu/device_answers.hpp"
#include "gpu/device_needs.hpp"
#include "gpu/gpu_device_state.hpp"
#include "gpu/rounding_check.hpp"
#include "gpu/scene_check.hpp"
#include "gpu/walk_check.hpp"
#include "roundings.spv.hpp"
#include "scene_walk.spv.hpp"
#include "surehit/gpu.hpp"
#include "tree_walk.spv.hpp"

namespace surehit::test::gpu_device_needs_test {
namespace {

using detail::DeviceHit;
using detail::DeviceReport;
using detail::DeviceSceneHit;
using detail::GpuDeviceState;
using detail::RoundingCase;
using detail::RoundingResult;
using detail::SceneCheck;
using detail::WalkCheck;
using Reason = GpuError::Reason;

/// A device that has all that is needed.
DeviceReport good_report() {
  DeviceReport report;
  report.properties.apiVersion = VK_API_VERSION_1_1;
  report.properties.limits.maxComputeWorkGroupInvocations = 128;
  report.properties.limits.maxComputeWorkGroupSize[0] = 128;
  report.properties.limits.maxComputeWorkGroupCount[0] = 65535;
  report.properties.limits.maxPerStageDescriptorStorageBuffers = 6;
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
  EXPECT_EQ(missing([](DeviceReport& report) { report.properties.limits.maxComputeWorkGroupSize[0] = 63; }),
            "work groups of 64 threads");
  EXPECT_EQ(missing([](DeviceReport& report) { report.properties.limits.maxComputeWorkGroupCount[0] = 16383; }),
            "work groups of 64 threads");
  EXPECT_EQ(missing([](DeviceReport& report) { report.properties.limits.maxPerStageDescriptorStorageBuffers = 5; }),
            "six buffers for a shader");
}

TEST(GpuNeedsTest, two_queues_copy_if_they_do_nothing_else) {
  DeviceReport report = good_report();
  EXPECT_EQ(detail::copying_family(report), std::nullopt);  // It has one.
  report.families[0].queueCount = 2;
  EXPECT_EQ(detail::copying_family(report), 0U);
  report.families[0].queueFlags |= VK_QUEUE_SPARSE_BINDING_BIT;
  EXPECT_EQ(detail::copying_family(report), 0U);
  constexpr VkQueueFlags decodes_video = 0x20;
  for (const VkQueueFlags other :
       {VkQueueFlags{VK_QUEUE_COMPUTE_BIT}, VkQueueFlags{VK_QUEUE_GRAPHICS_BIT}, decodes_video}) {
    DeviceReport busy = report;
    busy.families[0].queueFlags |= other;
    EXPECT_EQ(detail::copying_family(busy), std::nullopt) << other;
  }
}

TEST(GpuNeedsTest, paths_of_large_dispatches_take_fewer_steps) {
  EXPECT_EQ(detail::max_steps_of(1), 4096U);
  EXPECT_EQ(detail::max_steps_of(std::size_t{1} << 18), 4096U);
  EXPECT_EQ(detail::max_steps_of(std::size_t{1} << 20), 1024U);
}

TEST(GpuNeedsTest, scenes_need_eight_buffers) {
  DeviceReport report = good_report();
  EXPECT_FALSE(detail::has_buffers_for_scenes(report));
  report.properties.limits.maxPerStageDescriptorStorageBuffers = 7;
  EXPECT_FALSE(detail::has_buffers_for_scenes(report));
  report.properties.limits.maxPerStageDescriptorStorageBuffers = 8;
  EXPECT_TRUE(detail::has_buffers_for_scenes(report));
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

/// What a device answers that decides and rounds all.
DeviceHit sound_hit(const Hitf& hit) {
  if (hit.triangle == no_triangle) return {hit.t, hit.u, hit.v, hit.triangle, 0};
  const std::uint32_t side = hit.side == Side::edge_on ? DeviceHit::edge_on : static_cast<std::uint32_t>(hit.side);
  return {hit.t, hit.u, hit.v, hit.triangle, side};
}
std::vector<DeviceHit> sound_hits(const WalkCheck& check) {
  std::vector<DeviceHit> hits;
  for (const Hitf& hit : check.expected) hits.push_back(sound_hit(hit));
  return hits;
}
std::vector<DeviceSceneHit> sound_hits(const SceneCheck& check) {
  std::vector<DeviceSceneHit> hits;
  for (const SceneHitf& hit : check.expected) hits.push_back({sound_hit(hit), hit.instance.index});
  return hits;
}
template <typename Check>
std::vector<detail::DeviceAny> sound_blocked(const Check& check) {
  std::vector<detail::DeviceAny> blocked;
  for (const auto& hit : check.expected) blocked.push_back(hit.triangle != no_triangle ? 1 : 0);
  return blocked;
}

TEST(GpuWalkCheck, paths_miss_and_hit_and_lie_in_planes) {
  const WalkCheck check;
  EXPECT_EQ(check.fault(sound_hits(check), sound_blocked(check)).value_or(""), "");
  const auto count = [&](const auto& counts) {
    return std::count_if(check.expected.begin(), check.expected.end(), counts);
  };
  EXPECT_GT(count([](const Hitf& hit) { return hit.triangle == no_triangle; }), 80);
  EXPECT_GT(count([](const Hitf& hit) { return hit.triangle < 24; }), 40) << "needles";
  EXPECT_GT(count([](const Hitf& hit) { return hit.triangle != no_triangle && hit.triangle >= 24; }), 80) << "the box";
  EXPECT_GT(count([](const Hitf& hit) { return hit.triangle != no_triangle && hit.side == Side::edge_on; }), 8);
  EXPECT_GT(count([](const Hitf& hit) {
              return hit.triangle != no_triangle && (hit.u == 0 || hit.v == 0 || hit.u + hit.v == 1);
            }),
            20);
}

/// Each field counts. A device may be undecided, or leave the rounding to the host.
TEST(GpuWalkCheck, a_device_that_answers_wrongly_is_found) {
  const WalkCheck check;
  const auto fault_of_hit = [&](const auto& change) {
    std::vector<DeviceHit> hits = sound_hits(check);
    const auto hit = std::find_if(hits.rbegin(), hits.rend(), [](const DeviceHit& one) { return one.side == 1; });
    change(*hit);
    return check.fault(hits, sound_blocked(check)).value_or("");
  };
  constexpr std::uint32_t unrounded = DeviceHit::is_not_rounded;
  EXPECT_EQ(fault_of_hit([](DeviceHit&) {}), "");
  EXPECT_EQ(fault_of_hit([](DeviceHit& hit) { hit = {0, 0, 0, no_triangle, DeviceHit::undecided}; }), "");
  EXPECT_EQ(fault_of_hit([](DeviceHit& hit) { hit = {0, 0, 0, hit.triangle, hit.side + unrounded}; }), "");
  EXPECT_NE(fault_of_hit([](DeviceHit& hit) { hit.t = std::nextafter(hit.t, 2.0F); }), "");
  EXPECT_NE(fault_of_hit([](DeviceHit& hit) { hit.u = std::nextafter(hit.u, 2.0F); }), "");
  EXPECT_NE(fault_of_hit([](DeviceHit& hit) { hit.v = std::nextafter(hit.v, 2.0F); }), "");
  EXPECT_NE(fault_of_hit([](DeviceHit& hit) { --hit.triangle; }), "");
  EXPECT_NE(fault_of_hit([](DeviceHit& hit) { hit = {0, 0, 0, hit.triangle - 1, hit.side + unrounded}; }), "");
  EXPECT_NE(fault_of_hit([](DeviceHit& hit) { hit.side = 3 - hit.side; }), "");
  EXPECT_NE(fault_of_hit([](DeviceHit& hit) { hit = {0, 0, 0, no_triangle, 0}; }), "");
  EXPECT_NE(fault_of_hit([](DeviceHit& hit) { hit = {0, 0, 0, 0, 0}; }), "") << "memory that was never written";
  const auto fault_of_any = [&](bool is_hit, detail::DeviceAny answer) {
    std::vector<detail::DeviceAny> blocked = sound_blocked(check);
    *std::find(blocked.begin(), blocked.end(), is_hit ? 1U : 0U) = answer;
    return check.fault(sound_hits(check), blocked).value_or("");
  };
  EXPECT_EQ(fault_of_any(true, 2), "");
  EXPECT_EQ(fault_of_any(false, 2), "");
  EXPECT_NE(fault_of_any(true, 0), "");
  EXPECT_NE(fault_of_any(false, 1), "");
  EXPECT_NE(fault_of_any(true, 3), "");
  EXPECT_NE(check.fault({}, {}).value_or(""), "");
}

TEST(GpuSceneCheck, paths_miss_and_hit_each_instance) {
  const SceneCheck check;
  EXPECT_EQ(check.fault(sound_hits(check), sound_blocked(check)).value_or(""), "");
  EXPECT_EQ(check.tree.instances.size(), 4U);
  for (const detail::DeviceInstance& instance : check.tree.instances) {
    EXPECT_EQ(instance.flags & detail::DeviceInstance::is_left_to_host, 0U);
  }
  const auto count = [&](const auto& counts) {
    return std::count_if(check.expected.begin(), check.expected.end(), counts);
  };
  EXPECT_GT(count([](const SceneHitf& hit) { return hit.triangle == no_triangle; }), 60);
  for (std::uint32_t index = 0; index < 4; ++index) {
    const auto is_of_it = [&](const SceneHitf& hit) {
      return hit.triangle != no_triangle && hit.instance.index == index;
    };
    EXPECT_GT(count(is_of_it), 20) << index;
  }
}

/// The instance counts too.
TEST(GpuSceneCheck, a_device_that_answers_wrongly_is_found) {
  const SceneCheck check;
  const auto fault_of_hit = [&](const auto& change) {
    std::vector<DeviceSceneHit> hits = sound_hits(check);
    const auto hit = std::find_if(hits.rbegin(), hits.rend(), [](const auto& one) { return one.hit.side == 1; });
    change(*hit);
    return check.fault(hits, sound_blocked(check)).value_or("");
  };
  EXPECT_EQ(fault_of_hit([](DeviceSceneHit&) {}), "");
  EXPECT_EQ(fault_of_hit([](DeviceSceneHit& one) { one = {{0, 0, 0, no_triangle, DeviceHit::undecided}, 9}; }), "");
  EXPECT_EQ(fault_of_hit([](DeviceSceneHit& one) { one.hit.side += DeviceHit::is_not_rounded; }), "");
  EXPECT_NE(fault_of_hit([](DeviceSceneHit& one) { one.hit.t = std::nextafter(one.hit.t, 2.0F); }), "");
  EXPECT_NE(fault_of_hit([](DeviceSceneHit& one) { one.instance ^= 1; }), "");
  EXPECT_NE(fault_of_hit([](DeviceSceneHit& one) { one.hit.side += DeviceHit::is_not_rounded, one.instance ^= 1; }),
            "");
  EXPECT_NE(fault_of_hit([](DeviceSceneHit& one) { one = {{0, 0, 0, no_triangle, 0}, 0}; }), "");
  std::vector<detail::DeviceAny> blocked = sound_blocked(check);
  blocked.back() ^= 1;
  EXPECT_NE(check.fault(sound_hits(check), blocked).value_or(""), "");
  EXPECT_NE(check.fault({}, {}).value_or(""), "");
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
  EXPECT_EQ(fusible(scene_walk_spirv, all), 0U);
  EXPECT_GT(all, 150U);
  EXPECT_EQ(fusible(roundings_spirv, all), 0U);
  // Six operations, 3 of a sum in two floats, and 11 of a product. The optimizer joins equal sums and equal products.
  EXPECT_GE(all, 18U);
}

TEST(GpuLoaderTest, without_a_loader_there_is_an_error) {
  GpuDeviceState state;
  const std::array missing = {"libvulkan-that-is-not-there.so.1"};
  const auto error = state.start(missing);
  ASSERT_TRUE(error);
  EXPECT_EQ(error->reason, Reason::no_loader);
  EXPECT_NE(std::string(error->what()).find("libvulkan-that-is-not-there.so.1"), std::string::npos);
  GpuDeviceState strange;
  const std::array no_loader = {"libc.so.6"};
  const auto no_vulkan = strange.start(no_loader);
  ASSERT_TRUE(no_vulkan);
  EXPECT_EQ(no_vulkan->reason, Reason::no_loader);
}

TEST(GpuLoaderTest, the_first_loader_that_is_there_is_opened) {
  const char* const loader = detail::vulkan_loaders.back();
  GpuDeviceState alone;
  const auto error = alone.start(std::array{loader});
  if (error && error->reason == Reason::no_loader) GTEST_SKIP() << error->what();
  GpuDeviceState among_others;
  const auto same_error = among_others.start(std::array{"libvulkan-that-is-not-there.so.1", loader, "libc.so.6"});
  EXPECT_EQ(same_error.has_value(), error.has_value());
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
  std::vector<GpuDescription> descriptions(1);
  EXPECT_EQ(GpuDevice::try_list(descriptions).has_value(), has_loader);  // No device is no failure.
  EXPECT_TRUE(descriptions.empty());
  unsetenv("VK_ICD_FILENAMES");
  unsetenv("VK_DRIVER_FILES");
}

TEST(GpuLoaderTest, each_failure_has_its_reason) {
  const auto reason = [](VkResult result) { return detail::error_of(result, "while testing")->reason; };
  EXPECT_FALSE(detail::error_of(VK_SUCCESS, ""));
  EXPECT_EQ(reason(VK_ERROR_OUT_OF_HOST_MEMORY), Reason::out_of_memory);
  EXPECT_EQ(reason(VK_ERROR_OUT_OF_DEVICE_MEMORY), Reason::out_of_memory);
  EXPECT_EQ(reason(VK_ERROR_TOO_MANY_OBJECTS), Reason::out_of_memory);
  EXPECT_EQ(reason(VK_ERROR_INCOMPATIBLE_DRIVER), Reason::no_device);
  EXPECT_EQ(reason(VK_TIMEOUT), Reason::device_lost);
  EXPECT_EQ(reason(VK_ERROR_UNKNOWN), Reason::failed);
  EXPECT_STREQ(detail::error_of(VK_ERROR_DEVICE_LOST, "while testing")->what(),
               "the device was lost while testing; it must be opened anew");
  EXPECT_EQ(reason(VK_ERROR_INITIALIZATION_FAILED), Reason::failed);
  EXPECT_STREQ(detail::error_of(VK_ERROR_INITIALIZATION_FAILED, "while testing")->what(),
               "a driver of Vulkan could not start while testing");
}

}  // namespace
}  // namespace surehit::test::gpu_device_needs_test
