#include "gpu/vulkan_functions.hpp"

#include <algorithm>

namespace surehit::detail {
namespace {

std::optional<GpuError> missing_function(const char* name) {
  return GpuError(GpuError::Reason::no_loader, std::string("the Vulkan loader has no function vk") + name);
}

}  // namespace

std::optional<GpuError> VulkanFunctions::open_loader(std::span<const char* const> names) {
  const auto opened = std::find_if(names.begin(), names.end(), [&](const char* name) { return library.open(name); });
  if (opened == names.end()) {
    return GpuError(GpuError::Reason::no_loader,
                    std::string("the Vulkan loader ") + names.back() + " cannot be opened; it may not be installed");
  }
  GetInstanceProcAddr = reinterpret_cast<PFN_vkGetInstanceProcAddr>(library.find("vkGetInstanceProcAddr"));
  if (GetInstanceProcAddr == nullptr) return missing_function("GetInstanceProcAddr");
#define SUREHIT_LOAD(name)                                                                  \
  (name) = reinterpret_cast<PFN_vk##name>(GetInstanceProcAddr(VK_NULL_HANDLE, "vk" #name)); \
  if ((name) == nullptr) return missing_function(#name);
  SUREHIT_VULKAN_GLOBAL_FUNCTIONS(SUREHIT_LOAD)
#undef SUREHIT_LOAD
  return std::nullopt;
}

std::optional<GpuError> VulkanFunctions::load(VkInstance instance) {
#define SUREHIT_LOAD(name)                                                            \
  (name) = reinterpret_cast<PFN_vk##name>(GetInstanceProcAddr(instance, "vk" #name)); \
  if ((name) == nullptr) return missing_function(#name);
  SUREHIT_VULKAN_INSTANCE_FUNCTIONS(SUREHIT_LOAD)
#undef SUREHIT_LOAD
  return std::nullopt;
}

std::optional<GpuError> VulkanFunctions::load(VkDevice device) {
#define SUREHIT_LOAD(name)                                                        \
  (name) = reinterpret_cast<PFN_vk##name>(GetDeviceProcAddr(device, "vk" #name)); \
  if ((name) == nullptr) return missing_function(#name);
  SUREHIT_VULKAN_DEVICE_FUNCTIONS(SUREHIT_LOAD)
#undef SUREHIT_LOAD
  return std::nullopt;
}

std::optional<GpuError> error_of(VkResult result, std::string_view what) {
  using Reason = GpuError::Reason;
  const auto error = [&](Reason reason, std::string before, const char* after = "") {
    return GpuError(reason, before.append(" ").append(what).append(after));
  };
  switch (result) {
    case VK_SUCCESS:
      return std::nullopt;
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      return error(Reason::out_of_memory, "too little memory on the host");
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return error(Reason::out_of_memory, "too little memory on the device");
    case VK_ERROR_TOO_MANY_OBJECTS:
      return error(Reason::out_of_memory, "too many objects on the device");
    case VK_ERROR_DEVICE_LOST:
      return error(Reason::device_lost, "the device was lost", "; it must be opened anew");
    case VK_TIMEOUT:
      return error(Reason::device_lost, "the device has not answered for two minutes", "; it must be opened anew");
    case VK_ERROR_INCOMPATIBLE_DRIVER:
      return error(Reason::no_device, "no driver of Vulkan was found", "; a driver may not be installed");
    case VK_ERROR_INITIALIZATION_FAILED:
      return error(Reason::failed, "a driver of Vulkan could not start");
    default:
      return error(Reason::failed, "Vulkan failed with " + std::to_string(static_cast<int>(result)));
  }
}

}  // namespace surehit::detail
