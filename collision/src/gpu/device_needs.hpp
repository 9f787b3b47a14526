#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gpu/dispatch_size.hpp"
#include "gpu/vulkan_functions.hpp"

namespace surehit::detail {

/// What a driver says of a device.
struct DeviceReport {
  VkPhysicalDeviceProperties properties = {};
  VkPhysicalDeviceMemoryProperties memory = {};
  std::vector<VkQueueFamilyProperties> families;
};

/// The maximum number of steps of a path before it is left to the host. A node of the
/// tree takes one, and a decision in pairs as many as the shader says.
inline constexpr std::uint32_t max_path_steps = std::uint32_t{1} << 12;
/// The maximum number of steps of all paths in a dispatch, so that none takes long.
inline constexpr std::uint32_t max_dispatch_steps = std::uint32_t{1} << 30;
/// Returns the maximum number of steps of each of so many paths.
[[nodiscard]] constexpr std::uint32_t max_steps_of(std::size_t paths) {
  return static_cast<std::uint32_t>(std::min<std::size_t>(max_path_steps, max_dispatch_steps / paths));
}
/// The number of threads that work together on a device, as in the shaders.
inline constexpr std::uint32_t threads_in_group = 64;
/// The number of buffers that the shader of meshes has, and that of the shader of scenes.
inline constexpr std::uint32_t buffers_for_meshes = 6, buffers_for_scenes = 8;

/// Returns what the device lacks, as a part of a sentence, or nothing.
[[nodiscard]] std::string missing_of(const DeviceReport& report);
/// Returns true if the device has enough buffers for the shader of scenes.
[[nodiscard]] bool has_buffers_for_scenes(const DeviceReport& report);
/// Returns the first queue family that computes.
[[nodiscard]] std::optional<std::uint32_t> computing_family(const DeviceReport& report);
/// Returns the first queue family that has two queues for copies and for nothing else.
[[nodiscard]] std::optional<std::uint32_t> copying_family(const DeviceReport& report);
/// Returns a type of memory that has all of these properties and is one of `allowed`, those with `wished` first.
[[nodiscard]] std::optional<std::uint32_t> memory_type(const VkPhysicalDeviceMemoryProperties& memory,
                                                       std::uint32_t allowed, VkMemoryPropertyFlags needed,
                                                       VkMemoryPropertyFlags wished = 0);
/// Returns what is known of the device.
[[nodiscard]] GpuDescription description_of(const DeviceReport& report);

}  // namespace surehit::detail
