#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "gpu/device_needs.hpp"
#include "gpu/dispatch_size.hpp"
#include "gpu/gpu_commands.hpp"
#include "gpu/gpu_slots.hpp"
#include "gpu/path_limits.hpp"
#include "gpu/rounding_check.hpp"
#include "gpu/vulkan_functions.hpp"
#include "surehit/gpu.hpp"

namespace surehit::detail {

/// A part of a buffer.
struct GpuRange {
  VkBuffer buffer = VK_NULL_HANDLE;
  VkDeviceSize offset = 0, size = VK_WHOLE_SIZE;
};

/// What the shader of a dispatch is.
enum class GpuTask : std::uint8_t { any_hits, first_hits, roundings, scene_any_hits, scene_first_hits };
inline constexpr std::size_t gpu_task_count = 5;

/// Some commands for a queue. They may wait for a part before, and let one after them begin.
struct GpuPart {
  VkQueue queue;
  VkCommandBuffer commands;
  VkSemaphore begins, ends;
};

/// What a device computes at a time.
struct GpuDispatch {
  GpuTask task;
  PushedWords words;
};

/// A device, and what its driver says of it.
using FoundDevice = std::pair<VkPhysicalDevice, DeviceReport>;

/// What an open device has behind its pointer.
struct GpuDeviceState {
  GpuDeviceState() = default;
  ~GpuDeviceState();
  GpuDeviceState(const GpuDeviceState&) = delete;
  GpuDeviceState& operator=(const GpuDeviceState&) = delete;

  /// Starts Vulkan by the first of these loaders that is there, without a device.
  [[nodiscard]] std::optional<GpuError> start(std::span<const char* const> loaders = vulkan_loaders);
  /// Sets `found` to what the drivers say of all devices.
  [[nodiscard]] std::optional<GpuError> find(std::vector<FoundDevice>& found) const;
  /// Returns what the driver says of a device.
  [[nodiscard]] DeviceReport report_of(VkPhysicalDevice one) const;
  /// Opens the first of these devices that will do. If none will, it returns the error of the first.
  [[nodiscard]] std::optional<GpuError> open_first(std::span<const FoundDevice> found);
  /// Opens a device, makes its pipelines, and checks how it rounds and how it answers.
  [[nodiscard]] std::optional<GpuError> open(VkPhysicalDevice chosen, const DeviceReport& its_report);
  /// Does the same with a device that the caller has opened. It is left open at the end.
  [[nodiscard]] std::optional<GpuError> adopt(const GpuHandles& given);
  /// Returns the handles of the device.
  [[nodiscard]] GpuHandles handles() const;

  /// Makes what batches of scenes need, unless it is there, and then checks how the device answers in a scene. Fails if
  /// it answers wrongly, or has too few buffers for scenes.
  [[nodiscard]] std::optional<GpuError> prepare_scenes();
  /// Sets `pair` to slots that no one else has. If all are taken, it makes more, since the one that has them may wait
  /// for this one. Fails if the device was lost, or has too little memory.
  [[nodiscard]] std::optional<GpuError> take(GpuSlotPair*& pair);
  /// Lets others take slots, once the device has nothing more to do with them. If that cannot be waited for, the device
  /// keeps them, and counts as lost.
  void give_back(GpuSlotPair& pair) noexcept;
  /// Lets buffers of a slot that is not under way have room for so many bytes. What they had is lost.
  [[nodiscard]] std::optional<GpuError> make_room(std::span<const GpuRoom> rooms) const;
  /// Sets the buffers of a slot. The first ones are those of a mesh or of a scene.
  void bind(const GpuSlot& slot, const std::array<VkBuffer, 4>& of_mesh, const GpuRange& paths,
            const GpuRange& answers) const;
  /// Begins some work: copies, then a dispatch unless there is none, then more copies. Each waits for what is before
  /// it. With `waits_for_all`, the first one waits for all that the queue was given.
  [[nodiscard]] std::optional<GpuError> submit(GpuSlot& slot, std::span<const GpuCopy> before,
                                               const GpuDispatch* dispatch, std::span<const GpuCopy> after,
                                               bool waits_for_all = false);
  /// Does the same with a dispatch. If the device has queues of their own for copies, it goes on with them while it
  /// computes for another slot.
  [[nodiscard]] std::optional<GpuError> submit_apart(GpuSlot& slot, std::span<const GpuCopy> before,
                                                     const GpuDispatch& dispatch, std::span<const GpuCopy> after);
  /// Returns true if the device has queues of their own for copies there and back.
  [[nodiscard]] bool copies_apart() const { return copy_queues_[0] != VK_NULL_HANDLE; }
  /// Returns the families of the queues that use buffers.
  [[nodiscard]] std::span<const std::uint32_t> families() const {
    return std::span(families_).first(copies_apart() ? 2 : 1);
  }
  /// Waits until the work in a slot has ended.
  [[nodiscard]] std::optional<GpuError> wait(GpuSlot& slot);
  /// Makes a buffer of the device, and fills it through a slot. `what` is what it is for.
  [[nodiscard]] std::optional<GpuError> upload(GpuSlot& slot, std::span<const std::byte> bytes, const char* what,
                                               GpuBuffer& buffer);
  /// Fills a buffer of the device through a slot.
  [[nodiscard]] std::optional<GpuError> upload(GpuSlot& slot, std::span<const std::byte> bytes, const GpuBuffer& to);

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
  bool is_adopted = false;            ///< True if the caller has opened the device, and closes it.
  std::atomic<bool> is_lost = false;  ///< Nothing more is asked of a device that was lost.
  // These errors are made while there is memory, and copied where there may be none.
  const GpuError lost = {GpuError::Reason::device_lost, "the device was lost; it must be opened anew"};
  const GpuError no_memory = {GpuError::Reason::out_of_memory, "too little memory on the host during a batch"};
  static_assert(std::is_nothrow_copy_constructible_v<GpuError>);
  /// The slots of all batches and uploads under way, and a few that are free.
  std::vector<std::unique_ptr<GpuSlotPair>> pairs;
  static constexpr std::ptrdiff_t max_free_pairs = 4;
  DispatchSize dispatch_size;

 private:
  [[nodiscard]] GpuPipelines& pipelines_of(GpuTask task) { return pipelines_[static_cast<std::size_t>(task)]; }
  /// Gives the commands of a slot to queues. Fails if one of them does not take its part.
  [[nodiscard]] std::optional<GpuError> begin_work(GpuSlot& slot, const GpuDispatch* dispatch,
                                                   std::span<const GpuPart> parts);
  /// Makes the slots of a pair.
  [[nodiscard]] std::optional<GpuError> make(GpuSlotPair& pair) const;
  [[nodiscard]] std::optional<GpuError> make(GpuSlot& slot, const GpuSlotPair& pair) const;
  /// Waits until work has ended. It waits longer than two minutes only while the device ends work of other batches.
  [[nodiscard]] VkResult wait_for_end(const GpuSlot& slot);
  /// Waits for work after a failure. A device that cannot be waited for counts as lost.
  void abandon(GpuSlot& slot) noexcept;
  /// Closes the device, so that another one can be opened. Returns false if it has not returned from its work, and must
  /// be left as it is.
  [[nodiscard]] bool close() noexcept;
  /// Waits a little for work that is under way. Returns false if some of it still is.
  [[nodiscard]] bool has_returned() noexcept;
  /// Leaves all memory to a device that has not returned from its work.
  void forget() noexcept;
  /// Makes all that batches need on an open device, and checks how it rounds and how it answers.
  [[nodiscard]] std::optional<GpuError> prepare();
  /// Fails if the device rounds otherwise than it must.
  [[nodiscard]] std::optional<GpuError> check_roundings();
  /// Fails if the device answers known paths wrongly.
  [[nodiscard]] std::optional<GpuError> check_walk();
  /// Fails if the device answers known paths through a scene wrongly.
  [[nodiscard]] std::optional<GpuError> check_scenes();
  /// Asks the device about the paths of a check, which are in a mesh or in a scene.
  template <typename Check>
  [[nodiscard]] std::optional<GpuError> check_answers(const Check& check, const GpuMesh& mesh, GpuSlot& slot,
                                                      GpuTask first_hits, GpuTask any_hits);
  /// Returns the number of buffers that the shaders of this device may have.
  [[nodiscard]] std::uint32_t buffer_count() const;
  [[nodiscard]] std::optional<GpuError> make_layouts();
  /// Makes the pipelines of a task, unless they are there.
  [[nodiscard]] std::optional<GpuError> make_pipelines(GpuTask task, std::span<const std::uint32_t> shader);
  [[nodiscard]] std::optional<GpuError> make_pipeline(GpuTask task, std::span<const std::uint32_t> shader,
                                                      bool is_quick, VkPipeline& pipeline);
  /// Computes the cases of `rounding_check.hpp`.
  [[nodiscard]] std::optional<GpuError> round(GpuSlot& slot, std::span<const RoundingCase> cases,
                                              std::span<RoundingResult> results);
  /// Answers segments that all have the same options.
  [[nodiscard]] std::optional<GpuError> walk(GpuSlot& slot, const GpuMesh& mesh, std::span<const Segmentf> paths,
                                             const PathLimits& limits, GpuTask task, std::span<std::byte> answers);
  /// Returns the error of a result, and notes that the device was lost.
  [[nodiscard]] std::optional<GpuError> noted(VkResult result, const char* what);

  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  std::array<std::uint32_t, 2> families_ = {};  ///< That of the queue which computes, and that of copies.
  VkQueue queue_ = VK_NULL_HANDLE;
  std::array<VkQueue, 2> copy_queues_ = {};  ///< One for copies to the device, and one for those to the host.
  std::atomic<std::uint64_t> ended_ = 0;     ///< The number of times that work was seen to end.
  std::mutex queue_mutex_;                   ///< Held while work is given to a queue.
  std::mutex pairs_mutex_;                   ///< Held while slots are taken or given back.
  std::mutex scenes_mutex_;                  ///< Held while what scenes need is made and checked.
  bool takes_scenes_ = false;                ///< True once it is made and checked.
  VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  std::array<GpuPipelines, gpu_task_count> pipelines_ = {};
};

/// A batch or an upload on a device. In the end it waits until the device has nothing to do for it. So neither an error
/// nor an exception leaves work under way.
class GpuWork {
 public:
  explicit GpuWork(GpuDeviceState& device) : device_(device) {}
  ~GpuWork() {
    if (pair_ != nullptr) device_.give_back(*pair_);
  }
  GpuWork(const GpuWork&) = delete;
  GpuWork& operator=(const GpuWork&) = delete;

  /// Takes two slots for work on this mesh. Fails as `GpuDeviceState::take` does.
  [[nodiscard]] std::optional<GpuError> begin(std::shared_ptr<GpuMesh> mesh) {
    if (auto error = device_.take(pair_)) return error;
    pair_->mesh = std::move(mesh);
    return std::nullopt;
  }
  /// Returns the slots.
  [[nodiscard]] std::array<GpuSlot, 2>& slots() const { return pair_->slots; }
  /// Makes a buffer of the device, and fills it. `what` is what it is for.
  [[nodiscard]] std::optional<GpuError> upload(std::span<const std::byte> bytes, const char* what, GpuBuffer& buffer) {
    return device_.upload(pair_->slots[0], bytes, what, buffer);
  }

 private:
  GpuDeviceState& device_;
  GpuSlotPair* pair_ = nullptr;
};

}  // namespace surehit::detail
