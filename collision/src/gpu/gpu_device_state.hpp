#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "gpu/device_needs.hpp"
#include "gpu/gpu_buffer.hpp"
#include "gpu/rounding_check.hpp"
#include "gpu/vulkan_functions.hpp"
#include "surehit/gpu.hpp"

namespace surehit::detail {

/// The words that a dispatch pushes.
struct PushedWords {
  std::uint32_t path_count, is_segment, limits_step, max_steps, lists;
};

/// A part of a buffer.
struct GpuRange {
  VkBuffer buffer = VK_NULL_HANDLE;
  VkDeviceSize offset = 0, size = VK_WHOLE_SIZE;
};

/// A copy from one buffer to another.
struct GpuCopy {
  VkBuffer from, to;
  VkBufferCopy region;
};

/// The work on one dispatch: its buffers on both sides, its commands, and a fence. A device has two of them, so that
/// it works on one while the host finishes the other.
struct GpuSlot {
  GpuBuffer host_paths, host_limits, host_answers, host_list;  ///< Where the host writes and reads.
  GpuBuffer paths, limits, answers, list;                      ///< Where the device does.
  VkCommandBuffer commands = VK_NULL_HANDLE;
  VkDescriptorSet buffers = VK_NULL_HANDLE;
  VkFence fence = VK_NULL_HANDLE;
  bool is_under_way = false;  ///< True from when work begins until it has been waited for.
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

/// What the shader of a dispatch is.
enum class GpuTask : std::uint8_t { any_hits, first_hits, roundings, scene_any_hits, scene_first_hits };
inline constexpr std::size_t gpu_task_count = 5;

/// What a device computes at a time.
struct GpuDispatch {
  GpuTask task;
  PushedWords words;
};

/// What an open device has behind its pointer.
struct GpuDeviceState {
  GpuDeviceState() = default;
  ~GpuDeviceState();
  GpuDeviceState(const GpuDeviceState&) = delete;
  GpuDeviceState& operator=(const GpuDeviceState&) = delete;

  /// Starts Vulkan, without a device.
  [[nodiscard]] std::optional<GpuError> start(const char* loader = "libvulkan.so.1");
  /// Sets `found` to what the drivers say of all devices.
  [[nodiscard]] std::optional<GpuError> find(std::vector<std::pair<VkPhysicalDevice, DeviceReport>>& found) const;
  /// Returns what the driver says of a device.
  [[nodiscard]] DeviceReport report_of(VkPhysicalDevice one) const;
  /// Opens a device, makes its pipelines, and checks how it rounds.
  [[nodiscard]] std::optional<GpuError> open(VkPhysicalDevice chosen, const DeviceReport& its_report);
  /// Does the same with a device that the caller has opened. It is left open at the end.
  [[nodiscard]] std::optional<GpuError> adopt(const GpuHandles& given);
  /// Returns the handles of the device.
  [[nodiscard]] GpuHandles handles() const;

  /// Makes what batches of scenes need, unless it is there. Fails if the device has too few buffers for them.
  [[nodiscard]] std::optional<GpuError> prepare_scenes();
  /// Sets the buffers of a slot. The first ones are those of a mesh or of a scene.
  void bind(const GpuSlot& slot, const std::array<VkBuffer, 4>& of_mesh, const GpuRange& paths,
            const GpuRange& answers) const;
  /// Begins some work: copies, then a dispatch unless there is none, then more copies. Each waits for what is before
  /// it. With `waits_for_all`, the first one waits for all that the queue was given.
  [[nodiscard]] std::optional<GpuError> submit(GpuSlot& slot, std::span<const GpuCopy> before,
                                               const GpuDispatch* dispatch, std::span<const GpuCopy> after,
                                               bool waits_for_all = false);
  /// Waits until the work in a slot has ended.
  [[nodiscard]] std::optional<GpuError> wait(GpuSlot& slot);
  /// Waits until no work is under way, after a failure. A device that cannot be waited for counts as lost.
  void abandon() noexcept;
  /// Makes a buffer of the device, and fills it. `what` is what it is for.
  [[nodiscard]] std::optional<GpuError> upload(std::span<const std::byte> bytes, const char* what, GpuBuffer& buffer);
  /// Fills a buffer of the device.
  [[nodiscard]] std::optional<GpuError> upload(std::span<const std::byte> bytes, const GpuBuffer& to);
  /// Computes the cases of `rounding_check.hpp`.
  [[nodiscard]] std::optional<GpuError> round(std::span<const RoundingCase> cases, std::span<RoundingResult> results);

  /// Returns the state of an open device. Tests use it to let devices fail.
  [[nodiscard]] static const std::shared_ptr<GpuDeviceState>& of(const GpuDevice& device) { return device.state_; }
  /// Returns the device of a state.
  [[nodiscard]] static GpuDevice device_of(std::shared_ptr<GpuDeviceState> state) {
    GpuDevice device;
    device.state_ = std::move(state);
    return device;
  }

  VulkanFunctions vulkan;
  VkInstance instance = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  DeviceReport report;
  std::string name;
  bool is_adopted = false;  ///< True if the caller has opened the device, and closes it.
  bool is_lost = false;     ///< Nothing more is asked of a device that was lost.
  std::array<GpuSlot, 2> slots;
  std::mutex mutex;  ///< Held by a batch and by an upload.
  /// What work under way reads or fills. A device that was lost may still do so, and keeps it until it is closed.
  std::shared_ptr<GpuMesh> mesh;

 private:
  /// Waits a little for work that is under way. Returns false if some of it still is.
  [[nodiscard]] bool has_returned() noexcept;
  /// Leaves all memory to a device that has not returned from its work.
  void forget() noexcept;
  /// Makes all that batches need on an open device, and checks how it rounds.
  [[nodiscard]] std::optional<GpuError> prepare();
  /// Returns the number of buffers that the shaders of this device may have.
  [[nodiscard]] std::uint32_t buffer_count() const;
  [[nodiscard]] std::optional<GpuError> make_layouts();
  [[nodiscard]] std::optional<GpuError> make_pipeline(GpuTask task, std::span<const std::uint32_t> shader);
  [[nodiscard]] std::optional<GpuError> make_slots();
  /// Returns the error of a result, and notes that the device was lost.
  [[nodiscard]] std::optional<GpuError> noted(VkResult result, const char* what);

  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  std::uint32_t family_ = 0;
  VkQueue queue_ = VK_NULL_HANDLE;
  VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  std::array<VkPipeline, gpu_task_count> pipelines_ = {};
  VkCommandPool commands_ = VK_NULL_HANDLE;
  VkDescriptorPool sets_ = VK_NULL_HANDLE;
};

/// A batch or an upload, which holds the mutex of the device. Unless `end` was called, it leaves the device only when
/// that has nothing to do. So neither an error nor an exception leaves work under way.
class GpuWork {
 public:
  GpuWork(GpuDeviceState& device, std::shared_ptr<GpuMesh> mesh) : device_(device) { device_.mesh = std::move(mesh); }
  ~GpuWork() {
    if (!has_ended_) device_.abandon();
    if (!device_.is_lost) device_.mesh.reset();
  }
  GpuWork(const GpuWork&) = delete;
  GpuWork& operator=(const GpuWork&) = delete;

  /// Says that all work has ended.
  void end() { has_ended_ = true; }

 private:
  GpuDeviceState& device_;
  bool has_ended_ = false;
};

}  // namespace surehit::detail
