#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "surehit/batch_options.hpp"
#include "surehit/collider.hpp"
#include "surehit/hit.hpp"
#include "surehit/path_span.hpp"

namespace surehit {

namespace detail {
struct GpuDeviceState;
struct GpuColliderState;
}  // namespace detail

/// Why a GPU cannot be used, or has stopped. `what()` says the same in one line, and names what is missing.
class GpuError : public std::runtime_error {
 public:
  /// What is wrong.
  enum class Reason : std::uint8_t {
    no_loader,        ///< The Vulkan loader is not installed, or is too old.
    no_device,        ///< No device was found, or none that was chosen.
    missing_feature,  ///< The device lacks what the library needs, or computes otherwise than its proofs assume.
    too_large,        ///< The mesh does not fit into one buffer of the device.
    out_of_memory,    ///< There was too little memory, on the device or on the host.
    device_lost,      ///< The device has stopped, and must be opened anew.
    not_updated,      ///< The collider has changed since it was uploaded.
    bad_buffer,       ///< A buffer of the caller's is missing or too small, or begins at a bad place.
    failed,           ///< Vulkan has failed for another reason.
  };

  /// Sets the reason. `what()` returns the message. May throw std::bad_alloc.
  GpuError(Reason reason_given, const std::string& message) : std::runtime_error(message), reason(reason_given) {}

  Reason reason;  ///< What is wrong.
};

/// Success, or the reason of a failure. It is true on success.
class [[nodiscard]] GpuResult {
 public:
  /// Makes a success.
  GpuResult() noexcept = default;
  /// Makes a failure.
  GpuResult(GpuError error) : error_(std::move(error)) {}

  /// Returns true on success.
  [[nodiscard]] bool has_value() const noexcept { return !error_.has_value(); }
  /// Returns true on success.
  [[nodiscard]] explicit operator bool() const noexcept { return has_value(); }
  /// Returns what went wrong. Must not be called after a success.
  [[nodiscard]] const GpuError& error() const noexcept { return *error_; }

 private:
  std::optional<GpuError> error_;  ///< None after a success.
};

/// The kind of a device. The first kinds are chosen first.
enum class GpuKind : std::uint8_t {
  discrete,    ///< A card with memory of its own.
  integrated,  ///< A part of the processor.
  other,       ///< A virtual device, or one of an unknown kind.
  software,    ///< A program that runs on the processor, and is no faster than it.
};

/// What is known of a device before it is opened.
struct GpuDescription {
  std::string name;                ///< The name that the driver gives it.
  GpuKind kind = GpuKind::other;   ///< What it is.
  std::uint64_t memory_bytes = 0;  ///< The size of its own memory.
  std::string missing;             ///< What it lacks, or nothing if it may be opened.
};

/// Which device is opened.
struct GpuChoice {
  std::string name = {};        ///< A part of the device's name. If it is empty, devices of the best kind come first.
  bool takes_software = false;  ///< True if software will do. A device of that kind is opened by its name too.
};

/// The handles of an open device, as Vulkan has them.
struct GpuHandles {
  void (*get_instance_proc_addr)() = nullptr;  ///< `vkGetInstanceProcAddr`.
  void* instance = nullptr;                    ///< The `VkInstance`, of Vulkan 1.1 or later.
  void* physical_device = nullptr;             ///< The `VkPhysicalDevice`.
  void* device = nullptr;                      ///< The `VkDevice`.
  void* queue = nullptr;                       ///< A `VkQueue` of the device that computes.
  std::uint32_t queue_family = 0;              ///< The index of the queue's family.
};

/// A part of a buffer of the caller's, on a device. A buffer whose sharing mode is exclusive must belong to the queue
/// family of the device, which is `GpuHandles::queue_family`.
///
/// A batch refuses a part that ends beyond its buffer. It counts the memory that the buffer needs, because Vulkan does
/// not tell the size. So a part may end a little beyond its buffer unnoticed, by less than the granularity of that
/// memory.
struct GpuBufferPart {
  std::uint64_t buffer = 0;  ///< The `VkBuffer`, which storage and transfers in both directions may use.
  /// Where the part begins, in bytes: a multiple of 4 and of `minStorageBufferOffsetAlignment`.
  std::uint64_t offset = 0;
  std::uint64_t size = 0;  ///< How long the part is, in bytes.
};

/// Paths in a buffer of the caller's, on a device. Each has six floats: its start and its end, or its origin and its
/// direction.
struct GpuPaths {
  PathKind kind = PathKind::segment;  ///< The kind of all paths.
  std::size_t count = 0;              ///< The number of paths.
  GpuBufferPart part;                 ///< Where they are. A path takes 24 bytes.
};

/// An open device of Vulkan. Copies refer to the same device, which closes with the last of them and of its colliders.
///
/// Vulkan's loader is opened when a device is listed or opened, so a program starts without it. Any number of threads
/// may use a device. No batch holds it, so an executor or a filter may ask it anew. Each batch under way has
/// memory for two dispatches, at most a 32nd of that of the device. The memory of four batches is kept for later ones.
///
/// A program that has a device of its own lets the library adopt it, and so keeps paths and answers on the device.
class GpuDevice {
 public:
  /// Makes a device that is not open.
  GpuDevice() noexcept = default;

  /// Sets `descriptions` to all devices, those of the best kind first. Fails if there is no loader. No device is no
  /// failure.
  static GpuResult try_list(std::vector<GpuDescription>& descriptions);
  /// Becomes the first device of this choice that will do. Fails if there is none. A device will not do if it lacks
  /// something, or computes otherwise than the proofs assume. If all are like that, the error is that of the first.
  /// This device is then as before.
  GpuResult try_open(const GpuChoice& choice = {});
  /// Becomes a device that the caller has opened. Fails as `try_open` does, or if a handle is null.
  ///
  /// The caller closes the device, after the last copy of this and the last collider on it have gone. While one of them
  /// is made, asked or destroyed, nothing else may use the queue.
  GpuResult try_adopt(const GpuHandles& given);

#if defined(__cpp_exceptions)
  /// Returns what `try_list` finds. Throws its error.
  [[nodiscard]] static std::vector<GpuDescription> list() {
    std::vector<GpuDescription> descriptions;
    if (const GpuResult listed = try_list(descriptions); !listed) throw listed.error();
    return descriptions;
  }
  /// Returns the device of this choice. Throws the error of `try_open`.
  [[nodiscard]] static GpuDevice open(const GpuChoice& choice = {}) {
    GpuDevice device;
    if (const GpuResult opened = device.try_open(choice); !opened) throw opened.error();
    return device;
  }
#endif

  /// Returns true if it is open.
  [[nodiscard]] bool is_open() const noexcept { return state_ != nullptr; }
  /// Returns the name of an open device.
  [[nodiscard]] const std::string& name() const noexcept;
  /// Returns the handles of an open device, so that the caller can make buffers on it. They hold until it closes. The
  /// queue may not be used while the library uses it.
  [[nodiscard]] GpuHandles handles() const noexcept;

 private:
  friend struct detail::GpuDeviceState;
  std::shared_ptr<detail::GpuDeviceState> state_;
};

/// What batches on a device did. A batch adds to them, and never resets them.
struct GpuStatistics {
  std::uint64_t paths = 0;    ///< The number of paths. A batch that fails counts all of its paths.
  std::uint64_t misses = 0;   ///< The number of paths that the device found to miss.
  std::uint64_t hits = 0;     ///< The number of paths whose hit the device found.
  std::uint64_t rounded = 0;  ///< The number of first hits whose t, u and v the device rounded.
  /// The number of first hits that the device found, and whose t, u and v the host rounded.
  std::uint64_t rounded_by_host = 0;
  /// The number of paths that the host answered as a whole. The device left them to it, or failed before them. Or the
  /// batch has a filter, or the device cannot have the mesh.
  std::uint64_t undecided = 0;
  std::uint64_t dispatches = 0;  ///< The number of pieces of work that the device was given.
};

/// What a batch does besides.
struct GpuBatchOptions {
  /// If the device fails or memory runs out, the host answers the rest of the batch, for which it needs none. Otherwise
  /// the batch ends with the error. This plays no part where paths and answers are in buffers of the caller's.
  bool goes_on_without_device = false;
  /// The batch adds its work to these, unless this is null. Nothing else may use them while the batch runs.
  GpuStatistics* statistics = nullptr;
};

/// The result of a batch. It is true if all paths have their answers.
struct [[nodiscard]] GpuBatchResult {
  std::size_t finished = 0;  ///< So many paths, from the first one on, have their answers. The others are as before.
  /// Why the device failed, even if the host went on without it. `out_of_memory` may be the device's or the host's.
  std::optional<GpuError> error;
  bool is_complete = false;  ///< True if all paths have their answers.

  /// Returns true if all paths have their answers.
  [[nodiscard]] explicit operator bool() const noexcept { return is_complete; }
};

/// A collider of floats whose batches run on a GPU. The answers have the same bits as those of the collider.
///
/// The device finds out which paths certainly miss, and which triangle a path certainly hits. It rounds t, u and v of
/// nearly all first hits. The host rounds the others, and answers the paths that the device leaves undecided.
/// `collision/src/gpu/GPU.md` proves that what the device is certain of is right.
///
/// It refers to the collider, which must outlive it and stay where it is. Batches may run in several threads at the
/// same time. None may run during an upload or an update, or while the collider changes.
class GpuCollider {
 public:
  /// Makes one that has no mesh. It must be uploaded before it is asked.
  GpuCollider() noexcept = default;

  /// Uploads a collider to an open device. Fails if the device is not open or was lost, if it has too little memory, or
  /// if the mesh is too large for one of its buffers. This is then as before. May throw std::bad_alloc.
  GpuResult try_upload(const GpuDevice& device, const Colliderf& collider);
  /// Uploads the collider anew, after it was rebuilt or its masks were changed. Fails as `try_upload` does.
  GpuResult try_update();

#if defined(__cpp_exceptions)
  /// Uploads a collider. Throws the error of `try_upload`.
  GpuCollider(const GpuDevice& device, const Colliderf& collider) {
    if (const GpuResult uploaded = try_upload(device, collider); !uploaded) throw uploaded.error();
  }
  /// Uploads the collider anew. Throws the error of `try_update`.
  void update() {
    if (const GpuResult updated = try_update(); !updated) throw updated.error();
  }
#endif

  /// Sets `hits[i]` to the first hit of path i, as `Collider::first_hits` does. Lengths are as there.
  ///
  /// If there is a filter, the host answers all paths, because the device cannot call it. An executor spreads the work
  /// of the host. `BatchOptions::statistics` count the work of the host alone.
  ///
  /// Fails if the device fails, or if the host finds no memory for its part of the batch. Work is cut into pieces of
  /// bounded length, so that a desktop stays alive. It is refused if the collider has changed since it was uploaded.
  /// Only a refusal may throw std::bad_alloc.
  GpuBatchResult first_hits(const PathSpanf& paths, std::span<Hitf> hits, const BatchOptionsf& options = {},
                            const GpuBatchOptions& gpu = {}) const;
  /// Sets `blocked[i]` to 1 if path i has a hit, and to 0 otherwise, as `Collider::any_hits` does. All else is as in
  /// `first_hits`.
  GpuBatchResult any_hits(const PathSpanf& paths, std::span<std::uint8_t> blocked, const BatchOptionsf& options = {},
                          const GpuBatchOptions& gpu = {}) const;

  /// Does the same with paths and hits in buffers of the caller's, on the collider's device. Each hit takes 20 bytes:
  /// t, u and v as floats, then the triangle and the number of the side as words of 32 bits. No bit differs from that
  /// of `Collider::first_hits`.
  ///
  /// Paths are read after all work that the device's queue has been given. All hits are in their buffer when this
  /// returns, those that the host finished too. The device sends the host only paths that it leaves to it, and the host
  /// sends it their hits. If there is a filter, or if the host answers all paths for another reason, all paths and hits
  /// go through the host.
  ///
  /// Fails too if a buffer is null or too small, if its part begins at a bad place, or if both parts overlap. The host
  /// does not go on without the device. After a failure, what comes after the first `finished` hits has no meaning. If
  /// the device was lost, both buffers must stay until the device is closed.
  GpuBatchResult first_hits(const GpuPaths& paths, const GpuBufferPart& hits, const BatchOptionsf& options = {},
                            const GpuBatchOptions& gpu = {}) const;
  /// Sets a word of 32 bits for each path: to 1 if it has a hit, and to 0 otherwise. All else is as in `first_hits`.
  GpuBatchResult any_hits(const GpuPaths& paths, const GpuBufferPart& blocked, const BatchOptionsf& options = {},
                          const GpuBatchOptions& gpu = {}) const;

  /// Returns the memory on the device that the mesh takes, in bytes.
  [[nodiscard]] std::size_t memory_bytes() const noexcept;

 private:
  std::shared_ptr<detail::GpuColliderState> state_;
};

}  // namespace surehit
