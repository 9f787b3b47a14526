#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <memory>

#include "gpu/device_answers.hpp"
#include "gpu/gpu_buffer.hpp"
#include "gpu/path_limits.hpp"
#include "gpu/vulkan_functions.hpp"

namespace surehit::detail {

struct GpuDeviceState;

/// How large a buffer has to be at least.
struct GpuRoom {
  GpuBuffer* buffer;
  GpuBuffer::Place place;
  std::size_t bytes;
};

/// The work on one dispatch: its buffers on both sides, its commands, and a fence. The buffers grow with the work.
struct GpuSlot {
  /// The most that a path takes on the device.
  static constexpr std::size_t bytes_for_path =
      sizeof(float[6]) + sizeof(PathLimits) + sizeof(DeviceSceneHit) + sizeof(ListedPath);

  /// Returns the rooms for a dispatch whose paths and answers come from the host and go back. `listed` is the number of
  /// paths that the device may list.
  [[nodiscard]] std::array<GpuRoom, 8> rooms(std::size_t path_bytes, std::size_t limit_bytes, std::size_t answer_bytes,
                                             std::size_t listed);
  /// Sets what stands before the list on the host to what a device begins with.
  void clear_list() const;

  GpuBuffer host_paths, host_limits, host_answers, host_list;  ///< Where the host writes and reads.
  GpuBuffer paths, limits, answers, list;                      ///< Where the device does.
  VkCommandBuffer commands = VK_NULL_HANDLE;
  /// Copies to the device and back, where it has queues for them, and what says that the part before has ended.
  VkCommandBuffer commands_there = VK_NULL_HANDLE, commands_back = VK_NULL_HANDLE;
  VkSemaphore is_there = VK_NULL_HANDLE, is_computed = VK_NULL_HANDLE;
  VkDescriptorSet buffers = VK_NULL_HANDLE;
  VkFence fence = VK_NULL_HANDLE;
  bool is_under_way = false;                    ///< True from when work begins until it has been waited for.
  std::size_t dispatched = 0;                   ///< The paths that the device was given last.
  std::chrono::steady_clock::time_point begun;  ///< When that was.
};

/// The buffers of a mesh on a device, or those of a scene. Other versions of a scene may share those of its meshes.
struct GpuMesh {
  std::shared_ptr<GpuBuffer> nodes = std::make_shared<GpuBuffer>();
  std::shared_ptr<GpuBuffer> triangles = std::make_shared<GpuBuffer>();
  GpuBuffer scene_nodes, instances;  ///< Those of a scene alone.

  /// Returns the buffers that a shader reads. That of a mesh reads the first two.
  [[nodiscard]] std::array<VkBuffer, 4> buffers() const {
    const bool is_scene = scene_nodes.get() != VK_NULL_HANDLE;
    return {nodes->get(), triangles->get(), is_scene ? scene_nodes.get() : nodes->get(),
            is_scene ? instances.get() : nodes->get()};
  }
  [[nodiscard]] std::size_t size() const {
    return nodes->size() + triangles->size() + scene_nodes.size() + instances.size();
  }
};

/// What a batch or an upload has of a device while it runs: two slots, so that the device works on one while the host
/// finishes the other. Pools are for one thread at a time, so each pair has its own.
struct GpuSlotPair {
  explicit GpuSlotPair(const GpuDeviceState& its_device) : device(&its_device) {}
  ~GpuSlotPair();
  GpuSlotPair(const GpuSlotPair&) = delete;
  GpuSlotPair& operator=(const GpuSlotPair&) = delete;

  /// Returns true if the device may still work on one of the slots.
  [[nodiscard]] bool is_under_way() const noexcept { return slots[0].is_under_way || slots[1].is_under_way; }
  /// Leaves all memory to a device that has not returned from its work.
  void forget() noexcept;

  std::array<GpuSlot, 2> slots;
  /// What work under way reads or fills. A device that was lost may still do so, and keeps it until it is closed.
  std::shared_ptr<GpuMesh> mesh;
  bool is_taken = true;          ///< True while a batch or an upload has it.
  const GpuDeviceState* device;  ///< Null after `forget`.
  VkCommandPool commands = VK_NULL_HANDLE;
  VkCommandPool copies = VK_NULL_HANDLE;  ///< Null where the device has no queues for copies.
  VkDescriptorPool sets = VK_NULL_HANDLE;
};

}  // namespace surehit::detail
