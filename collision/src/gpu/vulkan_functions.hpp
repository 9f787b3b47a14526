#pragma once

#define VK_NO_PROTOTYPES
#include <vulkan/vulkan_core.h>

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "gpu/shared_library.hpp"
#include "surehit/gpu.hpp"

namespace surehit::detail {

// The functions of Vulkan that are used, without `vk`: those of no object, of an instance, and of a device.
#define SUREHIT_VULKAN_GLOBAL_FUNCTIONS(X) X(CreateInstance) X(EnumerateInstanceVersion)

#define SUREHIT_VULKAN_INSTANCE_FUNCTIONS(X) \
  X(DestroyInstance)                         \
  X(EnumeratePhysicalDevices)                \
  X(GetPhysicalDeviceProperties)             \
  X(GetPhysicalDeviceQueueFamilyProperties) X(GetPhysicalDeviceMemoryProperties) X(CreateDevice) X(GetDeviceProcAddr)

#define SUREHIT_VULKAN_DEVICE_FUNCTIONS(X) \
  X(DestroyDevice)                         \
  X(GetDeviceQueue)                        \
  X(CreateBuffer)                          \
  X(DestroyBuffer)                         \
  X(GetBufferMemoryRequirements)           \
  X(AllocateMemory)                        \
  X(FreeMemory)                            \
  X(BindBufferMemory)                      \
  X(MapMemory)                             \
  X(CreateShaderModule)                    \
  X(DestroyShaderModule)                   \
  X(CreateDescriptorSetLayout)             \
  X(DestroyDescriptorSetLayout)            \
  X(CreatePipelineLayout)                  \
  X(DestroyPipelineLayout)                 \
  X(CreateComputePipelines)                \
  X(DestroyPipeline)                       \
  X(CreateDescriptorPool)                  \
  X(DestroyDescriptorPool)                 \
  X(AllocateDescriptorSets)                \
  X(UpdateDescriptorSets)                  \
  X(CreateCommandPool)                     \
  X(DestroyCommandPool)                    \
  X(AllocateCommandBuffers)                \
  X(BeginCommandBuffer)                    \
  X(EndCommandBuffer)                      \
  X(CmdBindPipeline)                       \
  X(CmdBindDescriptorSets)                 \
  X(CmdPushConstants)                      \
  X(CmdDispatch)                           \
  X(CmdDispatchIndirect)                   \
  X(CmdCopyBuffer)                         \
  X(CmdPipelineBarrier)                    \
  X(CreateSemaphore) X(DestroySemaphore) X(CreateFence) X(DestroyFence) X(ResetFences) X(WaitForFences) X(QueueSubmit)

/// The names of Vulkan's loader on this platform. On macOS, the loader shows no device of MoltenVK to programs that do
/// not ask for it, so MoltenVK itself is opened where it is there.
#if defined(_WIN32)
inline constexpr std::array vulkan_loaders = {"vulkan-1.dll"};
#elif defined(__APPLE__)
inline constexpr std::array vulkan_loaders = {"libMoltenVK.dylib", "libvulkan.1.dylib"};
#else
inline constexpr std::array vulkan_loaders = {"libvulkan.so.1"};
#endif

/// The functions of Vulkan, and the loader that they come from.
struct VulkanFunctions {
  /// Opens the first of these loaders that is there, and gets the functions of no object.
  [[nodiscard]] std::optional<GpuError> open_loader(std::span<const char* const> names);
  /// Gets the functions of an instance.
  [[nodiscard]] std::optional<GpuError> load(VkInstance instance);
  /// Gets the functions of a device.
  [[nodiscard]] std::optional<GpuError> load(VkDevice device);

  SharedLibrary library;                                    ///< The loader.
  PFN_vkGetInstanceProcAddr GetInstanceProcAddr = nullptr;  // NOLINT(readability-identifier-naming): as Vulkan has it
#define SUREHIT_MEMBER(name) PFN_vk##name name = nullptr;
  SUREHIT_VULKAN_GLOBAL_FUNCTIONS(SUREHIT_MEMBER)
  SUREHIT_VULKAN_INSTANCE_FUNCTIONS(SUREHIT_MEMBER)
  SUREHIT_VULKAN_DEVICE_FUNCTIONS(SUREHIT_MEMBER)
#undef SUREHIT_MEMBER
};

/// Returns a structure of Vulkan with all members zero, except for its type.
template <typename Structure>
[[nodiscard]] Structure of_type(VkStructureType type) {
  Structure structure = {};
  structure.sType = type;
  return structure;
}

/// Returns what a result means, or nothing if it is a success. `what` says when it failed, such as "while opening
/// a device", or for what. A success allocates nothing.
[[nodiscard]] std::optional<GpuError> error_of(VkResult result, std::string_view what);
/// Returns what making an object failed with. Vulkan leaves the handle undefined then, so it becomes null, and nothing
/// destroys it.
template <typename Handle>
[[nodiscard]] std::optional<GpuError> error_of(VkResult result, std::string_view what, Handle& made) {
  if (result != VK_SUCCESS) made = VK_NULL_HANDLE;
  return error_of(result, what);
}

}  // namespace surehit::detail
