#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "gpu/vulkan_functions.hpp"

namespace surehit::detail {

struct GpuSlot;

/// A copy from one buffer to another.
struct GpuCopy {
  VkBuffer from, to;
  VkBufferCopy region;
};

/// The words that a dispatch pushes.
struct PushedWords {
  std::uint32_t path_count, is_segment, limits_step, max_steps, lists;
};

/// The shader of a dispatch, for each of its two parts.
struct GpuPipelines {
  VkPipeline quick = VK_NULL_HANDLE;  ///< Decides in floats alone. Null if there is one part only.
  VkPipeline whole = VK_NULL_HANDLE;  ///< Decides what the first part has left open.
};

/// Writes work into a command buffer. What is written waits for what is before it.
class GpuCommands {
 public:
  /// What the queue of a command buffer can do.
  enum class Queue : std::uint8_t { computes, only_copies };

  GpuCommands(const VulkanFunctions& vulkan, VkCommandBuffer commands, Queue queue = Queue::computes)
      : vulkan_(vulkan), commands_(commands), queue_(queue) {}

  [[nodiscard]] VkResult begin() const;
  /// Waits for all that the queue was given before.
  void wait_for_queue() const;
  void copy(std::span<const GpuCopy> copies) const;
  /// Computes, after copies to what it reads.
  void dispatch(const GpuSlot& slot, const GpuPipelines& pipelines, VkPipelineLayout layout,
                const PushedWords& words) const;
  /// Lets copies wait for what was computed.
  void wait_for_shader() const;
  /// Lets the host read what was copied to it, and the caller's work on the queue what is in the caller's buffers.
  [[nodiscard]] VkResult end() const;

 private:
  void wait_for(VkPipelineStageFlags stages, VkAccessFlags written, VkPipelineStageFlags next_stages,
                VkAccessFlags used) const;

  const VulkanFunctions& vulkan_;
  VkCommandBuffer commands_;
  Queue queue_;
};

}  // namespace surehit::detail
