#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

#include "gpu/device_needs.hpp"
#include "gpu/gpu_device_state.hpp"
#include "gpu_answers.hpp"

namespace surehit::test {

/// A device that seems to have two queues for copies. They are its only queue in truth. What waits for something is
/// given to it later than that, so it cannot wait for ever.
class SimulatedCopyQueues {
 public:
  /// Opens the best device. Returns a closed one where there is none.
  static GpuDevice open() {
    detail::WalkCheck::is_on = false;
    auto state = std::make_shared<detail::GpuDeviceState>();
    if (state->start()) return {};
    std::vector<detail::FoundDevice> found;
    if (state->find(found) || found.empty()) return {};
    auto& [physical, report] = found.front();
    family = detail::computing_family(report).value();
    for (VkQueueFamilyProperties& its_family : report.families) {
      if (its_family.queueFlags == VK_QUEUE_TRANSFER_BIT) its_family.queueFlags = 0;
    }
    report.families.push_back({VK_QUEUE_TRANSFER_BIT, 2, 0, {1, 1, 1}});
    create_device = std::exchange(state->vulkan.CreateDevice, create_with_one_queue);
    function_of = std::exchange(state->vulkan.GetDeviceProcAddr, simulated_function);
    if (const auto error = state->open(physical, report)) {
      ADD_FAILURE() << error->what();
      return {};
    }
    return detail::GpuDeviceState::device_of(std::move(state));
  }

 private:
  static VKAPI_ATTR VkResult VKAPI_CALL create_with_one_queue(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                                              const VkAllocationCallbacks* callbacks, VkDevice* made) {
    EXPECT_EQ(info->queueCreateInfoCount, 2U);
    EXPECT_EQ(info->pQueueCreateInfos[1].queueCount, 2U);
    VkDeviceCreateInfo one = *info;
    one.queueCreateInfoCount = 1;
    return create_device(physical, &one, callbacks, made);
  }
  static VKAPI_ATTR void VKAPI_CALL get_queue(VkDevice device, std::uint32_t, std::uint32_t, VkQueue* queue) {
    real<PFN_vkGetDeviceQueue>(device, "vkGetDeviceQueue")(device, family, 0, queue);
  }
  static VKAPI_ATTR VkResult VKAPI_CALL create_pool(VkDevice device, const VkCommandPoolCreateInfo* info,
                                                    const VkAllocationCallbacks* callbacks, VkCommandPool* made) {
    VkCommandPoolCreateInfo of_one = *info;
    of_one.queueFamilyIndex = family;
    return real<PFN_vkCreateCommandPool>(device, "vkCreateCommandPool")(device, &of_one, callbacks, made);
  }
  static VKAPI_ATTR VkResult VKAPI_CALL create_buffer(VkDevice device, const VkBufferCreateInfo* info,
                                                      const VkAllocationCallbacks* callbacks, VkBuffer* made) {
    EXPECT_EQ(info->sharingMode, VK_SHARING_MODE_CONCURRENT);
    EXPECT_EQ(info->queueFamilyIndexCount, 2U);
    VkBufferCreateInfo of_one = *info;
    of_one.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
    of_one.queueFamilyIndexCount = 0;
    return real<PFN_vkCreateBuffer>(device, "vkCreateBuffer")(device, &of_one, callbacks, made);
  }
  static VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL simulated_function(VkDevice device, const char* name) {
    const auto is = [&](const char* other) { return std::strcmp(name, other) == 0; };
    if (is("vkGetDeviceQueue")) return reinterpret_cast<PFN_vkVoidFunction>(get_queue);
    if (is("vkCreateCommandPool")) return reinterpret_cast<PFN_vkVoidFunction>(create_pool);
    if (is("vkCreateBuffer")) return reinterpret_cast<PFN_vkVoidFunction>(create_buffer);
    return function_of(device, name);
  }
  template <typename Function>
  static Function real(VkDevice device, const char* name) {
    return reinterpret_cast<Function>(function_of(device, name));
  }

  static inline std::uint32_t family = 0;
  static inline PFN_vkCreateDevice create_device = nullptr;
  static inline PFN_vkGetDeviceProcAddr function_of = nullptr;
};

}  // namespace surehit::test
