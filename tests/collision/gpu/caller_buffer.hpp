#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "gpu/vulkan_functions.hpp"
#include "surehit/gpu.hpp"

namespace surehit::test {

/// Vulkan as a caller uses it, who has nothing but the handles of a device.
class CallerVulkan {
 public:
  explicit CallerVulkan(const GpuHandles& given) : device(static_cast<VkDevice>(given.device)) {
    functions.GetInstanceProcAddr = reinterpret_cast<PFN_vkGetInstanceProcAddr>(given.get_instance_proc_addr);
    EXPECT_FALSE(functions.load(static_cast<VkInstance>(given.instance)));
    EXPECT_FALSE(functions.load(device));
    functions.GetPhysicalDeviceMemoryProperties(static_cast<VkPhysicalDevice>(given.physical_device), &memory);
  }

  detail::VulkanFunctions functions;
  VkDevice device;
  VkPhysicalDeviceMemoryProperties memory = {};
};

/// A buffer of a caller's, which the host sees. Each word has the same number at first.
class CallerBuffer {
 public:
  CallerBuffer(const CallerVulkan& vulkan, std::size_t size) : vulkan_(vulkan), size_(size) {
    VkBufferCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = size;
    info.usage =
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    const detail::VulkanFunctions& functions = vulkan.functions;
    EXPECT_EQ(functions.CreateBuffer(vulkan.device, &info, nullptr, &buffer_), VK_SUCCESS);
    VkMemoryRequirements needs = {};
    functions.GetBufferMemoryRequirements(vulkan.device, buffer_, &needs);
    VkMemoryAllocateInfo wanted = {};
    wanted.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    wanted.allocationSize = needs.size;
    constexpr auto visible = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    while ((needs.memoryTypeBits >> wanted.memoryTypeIndex & 1) == 0 ||
           (vulkan.memory.memoryTypes[wanted.memoryTypeIndex].propertyFlags & visible) != visible) {
      ++wanted.memoryTypeIndex;
    }
    EXPECT_EQ(functions.AllocateMemory(vulkan.device, &wanted, nullptr, &memory_), VK_SUCCESS);
    EXPECT_EQ(functions.BindBufferMemory(vulkan.device, buffer_, memory_, 0), VK_SUCCESS);
    void* data = nullptr;
    EXPECT_EQ(functions.MapMemory(vulkan.device, memory_, 0, VK_WHOLE_SIZE, 0, &data), VK_SUCCESS);
    data_ = static_cast<std::byte*>(data);
    std::memset(data_, 7, size);
  }
  ~CallerBuffer() {
    vulkan_.functions.DestroyBuffer(vulkan_.device, buffer_, nullptr);
    vulkan_.functions.FreeMemory(vulkan_.device, memory_, nullptr);
  }
  CallerBuffer(const CallerBuffer&) = delete;
  CallerBuffer& operator=(const CallerBuffer&) = delete;

  [[nodiscard]] GpuBufferPart part(std::size_t offset = 0) const {
    GpuBufferPart part = {0, offset, size_ - offset};
    std::memcpy(&part.buffer, &buffer_, sizeof buffer_);
    return part;
  }
  [[nodiscard]] std::byte* data() const { return data_; }

 private:
  const CallerVulkan& vulkan_;
  std::size_t size_;
  VkBuffer buffer_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  std::byte* data_ = nullptr;
};

}  // namespace surehit::test
