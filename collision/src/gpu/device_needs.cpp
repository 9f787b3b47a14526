#include "gpu/device_needs.hpp"

#include <algorithm>

namespace surehit::detail {

std::string missing_of(const DeviceReport& report) {
  const VkPhysicalDeviceLimits& limits = report.properties.limits;
  if (report.properties.apiVersion < VK_API_VERSION_1_1) return "Vulkan 1.1";
  if (!computing_family(report)) return "a queue that computes";
  constexpr std::uint32_t any = ~std::uint32_t{0};
  constexpr auto visible = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  if (!memory_type(report.memory, any, visible)) return "memory that the host sees";
  if (!memory_type(report.memory, any, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT)) return "memory of its own";
  if (limits.maxComputeWorkGroupInvocations < threads_in_group ||
      limits.maxComputeWorkGroupSize[0] < threads_in_group ||
      limits.maxComputeWorkGroupCount[0] < DispatchSize::largest / threads_in_group) {
    return "work groups of 64 threads";
  }
  if (limits.maxPerStageDescriptorStorageBuffers < buffers_for_meshes) return "six buffers for a shader";
  return {};
}

bool has_buffers_for_scenes(const DeviceReport& report) {
  return report.properties.limits.maxPerStageDescriptorStorageBuffers >= buffers_for_scenes;
}

std::optional<std::uint32_t> computing_family(const DeviceReport& report) {
  for (std::uint32_t i = 0; i < report.families.size(); ++i) {
    if ((report.families[i].queueFlags & VK_QUEUE_COMPUTE_BIT) != 0 && report.families[i].queueCount > 0) return i;
  }
  return std::nullopt;
}

std::optional<std::uint32_t> copying_family(const DeviceReport& report) {
  constexpr VkQueueFlags copies = VK_QUEUE_TRANSFER_BIT;
  constexpr VkQueueFlags allowed = copies | VK_QUEUE_SPARSE_BINDING_BIT;
  for (std::uint32_t i = 0; i < report.families.size(); ++i) {
    const VkQueueFamilyProperties& family = report.families[i];
    if ((family.queueFlags & copies) != 0 && (family.queueFlags & ~allowed) == 0 && family.queueCount >= 2) return i;
  }
  return std::nullopt;
}

std::optional<std::uint32_t> memory_type(const VkPhysicalDeviceMemoryProperties& memory, std::uint32_t allowed,
                                         VkMemoryPropertyFlags needed, VkMemoryPropertyFlags wished) {
  for (const VkMemoryPropertyFlags flags : {needed | wished, needed}) {
    for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
      if ((allowed >> i & 1) != 0 && (memory.memoryTypes[i].propertyFlags & flags) == flags) return i;
    }
  }
  return std::nullopt;
}

GpuDescription description_of(const DeviceReport& report) {
  GpuDescription description;
  description.name = report.properties.deviceName;
  switch (report.properties.deviceType) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      description.kind = GpuKind::discrete;
      break;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      description.kind = GpuKind::integrated;
      break;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      description.kind = GpuKind::software;
      break;
    default:
      description.kind = GpuKind::other;
  }
  for (std::uint32_t i = 0; i < report.memory.memoryHeapCount; ++i) {
    const VkMemoryHeap& heap = report.memory.memoryHeaps[i];
    if ((heap.flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) != 0) {
      description.memory_bytes = std::max(description.memory_bytes, heap.size);
    }
  }
  description.missing = missing_of(report);
  return description;
}

}  // namespace surehit::detail
