#include "gpu/gpu_buffer.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include "gpu/device_needs.hpp"
#include "gpu/gpu_device_state.hpp"

namespace surehit::detail {

GpuBuffer::~GpuBuffer() {
  if (device_ == nullptr) return;
  device_->vulkan.DestroyBuffer(device_->device, buffer_, nullptr);
  device_->vulkan.FreeMemory(device_->device, memory_, nullptr);
}

GpuBuffer& GpuBuffer::operator=(GpuBuffer&& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(buffer_, other.buffer_);
  std::swap(memory_, other.memory_);
  std::swap(size_, other.size_);
  std::swap(data_, other.data_);
  return *this;
}

std::optional<GpuError> GpuBuffer::make(const GpuDeviceState& device, std::size_t size, Place place, const char* what) {
  const VulkanFunctions& vulkan = device.vulkan;
  const std::string purpose = std::string("for ") + what;
  GpuBuffer made;
  made.device_ = &device;
  made.size_ = std::max<std::size_t>(size, 16);
  VkBufferCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = made.size_;
  info.usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  if (place == Place::device) info.usage |= VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
  // Queues for copies use buffers too.
  const std::span<const std::uint32_t> families = device.families();
  if (families.size() > 1) {
    info.sharingMode = VK_SHARING_MODE_CONCURRENT;
    info.queueFamilyIndexCount = static_cast<std::uint32_t>(families.size());
    info.pQueueFamilyIndices = families.data();
  }
  const VkResult created = vulkan.CreateBuffer(device.device, &info, nullptr, &made.buffer_);
  if (auto error = error_of(created, purpose, made.buffer_)) return error;

  VkMemoryRequirements needs = {};
  vulkan.GetBufferMemoryRequirements(device.device, made.buffer_, &needs);
  const auto type = place == Place::host
                        ? memory_type(device.report.memory, needs.memoryTypeBits,
                                      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT,
                                      VK_MEMORY_PROPERTY_HOST_CACHED_BIT)
                        : memory_type(device.report.memory, needs.memoryTypeBits, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  if (!type) return GpuError(GpuError::Reason::missing_feature, "the device has no memory " + purpose);
  // More than the heap has may not even be asked for.
  if (needs.size > device.report.memory.memoryHeaps[device.report.memory.memoryTypes[*type].heapIndex].size) {
    return error_of(VK_ERROR_OUT_OF_DEVICE_MEMORY, purpose);
  }
  VkMemoryAllocateInfo wanted = {};
  wanted.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  wanted.allocationSize = needs.size;
  wanted.memoryTypeIndex = *type;
  const VkResult allocated = vulkan.AllocateMemory(device.device, &wanted, nullptr, &made.memory_);
  if (auto error = error_of(allocated, purpose, made.memory_)) return error;
  if (auto error = error_of(vulkan.BindBufferMemory(device.device, made.buffer_, made.memory_, 0), purpose)) {
    return error;
  }
  if (place == Place::host) {
    void* data = nullptr;
    if (auto error = error_of(vulkan.MapMemory(device.device, made.memory_, 0, VK_WHOLE_SIZE, 0, &data), purpose)) {
      return error;
    }
    made.data_ = static_cast<std::byte*>(data);
  }
  *this = std::move(made);
  return std::nullopt;
}

}  // namespace surehit::detail
