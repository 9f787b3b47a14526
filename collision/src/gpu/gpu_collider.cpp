#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "collider_state.hpp"
#include "filter/kernel_bound.hpp"
#include "gpu/gpu_device_state.hpp"
#include "gpu/triangle_tree.hpp"
#include "path_range.hpp"
#include "support/floating_point_environment.hpp"
#include "surehit/gpu.hpp"
#include "surehit/intersect.hpp"

namespace surehit {
namespace detail {

/// What an uploaded collider has behind its pointer.
struct GpuColliderState {
  std::shared_ptr<GpuDeviceState> device;
  const Colliderf* collider;
  std::uint64_t version;       ///< That of the collider when it was uploaded.
  std::uint64_t mask_version;  ///< The same of its masks.
  bool is_on_device;           ///< False if the host answers all paths, because the device could decide none.
  std::shared_ptr<GpuMesh> mesh;
};

}  // namespace detail

namespace {

using detail::GpuColliderState;
using detail::GpuDeviceState;
using detail::GpuSlot;
using detail::PathLimits;

/// The answer of `tree_walk.comp` that is a miss. Any other one that is no triangle is undecided.
constexpr std::uint32_t miss = 0xffffffff;

/// The number of paths in a task of the host.
constexpr std::size_t paths_in_a_task = 4096;

/// The device takes 2^100 for infinity. No t of a certain hit is as large (G5).
constexpr float beyond = 0x1p100F;

/// Returns true if a device could take the limit for zero (G2).
bool may_be_flushed(float limit) {
  const std::uint32_t size = std::bit_cast<std::uint32_t>(limit) & 0x7fffffffU;
  return size != 0 && size < std::bit_cast<std::uint32_t>(std::numeric_limits<float>::min());
}

PathLimits limits_of(PathKind kind, const QueryOptionsf& options) {
  PathLimits limits = {};
  limits.mask = options.mask;
  limits.ignored = options.ignored_triangle;
  if (options.culling == Culling::back) limits.flags |= PathLimits::keeps_front;
  if (options.culling == Culling::front) limits.flags |= PathLimits::keeps_back;
  const detail::PathRange<float> range(kind, options);
  if (range.is_empty()) limits.flags |= PathLimits::hits_nothing;
  const detail::RangeWeights<float> weights(range);
  if (!weights.decides || may_be_flushed(range.first) || may_be_flushed(range.last)) {
    limits.flags |= PathLimits::is_for_host;
  }
  if (weights.is_whole) limits.flags |= PathLimits::is_whole;
  limits.t_first = weights.t_first;
  limits.det_first = weights.det_first;
  limits.t_last = weights.t_last;
  limits.det_last = weights.det_last;
  limits.first = std::max(range.first, -beyond);
  limits.last = std::min(range.last, beyond);
  return limits;
}

/// Calls `work(first, last)` for parts of [0, count), in tasks of the executor if there is one.
template <typename Work>
void in_tasks(const std::optional<Executor>& executor, std::size_t count, const Work& work) {
  if (!executor || count <= paths_in_a_task) {
    work(std::size_t{0}, count);
    return;
  }
  executor->run((count + paths_in_a_task - 1) / paths_in_a_task, [&](std::size_t task) {
    const FloatingPointEnvironment environment;  // A thread has its own.
    work(task * paths_in_a_task, std::min(count, (task + 1) * paths_in_a_task));
  });
}

/// Returns a view of paths that are copied side by side.
PathSpanf span_of(PathKind kind, const std::vector<float>& numbers) {
  const std::size_t count = numbers.size() / 6;
  const float* const first = numbers.data();
  if (count == 0) return {};
  if (kind == PathKind::segment) {
    return std::span(reinterpret_cast<const Segmentf*>(first), count);
  }
  if (kind == PathKind::ray) return std::span(reinterpret_cast<const Rayf*>(first), count);
  return std::span(reinterpret_cast<const Linef*>(first), count);
}

void ask(const Colliderf& collider, const PathSpanf& paths, std::span<Hitf> hits, const BatchOptionsf& options) {
  collider.first_hits(paths, hits, options);
}
void ask(const Colliderf& collider, const PathSpanf& paths, std::span<std::uint8_t> blocked,
         const BatchOptionsf& options) {
  collider.any_hits(paths, blocked, options);
}

/// Sets the answer of a path that certainly misses.
void set_miss(Hitf& hit) { hit = Hitf{}; }
void set_miss(std::uint8_t& blocked) { blocked = 0; }

/// Sets the answer of a path that certainly hits this triangle, and certainly first if that was asked. The weights and
/// t do not depend on the options (G9). A faulty device may name a triangle that is not hit.
void set_hit(const Colliderf& collider, const Pathf& path, const QueryOptionsf& options, std::uint32_t triangle,
             Hitf& hit) {
  if (const auto found = intersect<float>(path, collider.triangle(triangle))) {
    hit = *found;
    hit.triangle = triangle;
  } else {
    hit = collider.first_hit(path, options).value_or(Hitf{});
  }
}
void set_hit(const Colliderf&, const Pathf&, const QueryOptionsf&, std::uint32_t, std::uint8_t& blocked) {
  blocked = 1;
}

/// A batch of one kind, on its way through the device and the host.
template <typename Answer>
class GpuBatch {
 public:
  GpuBatch(const GpuColliderState& state, const PathSpanf& paths, std::span<Answer> answers,
           const BatchOptionsf& options, const GpuBatchOptions& gpu)
      : state_(state), paths_(paths), answers_(answers), options_(options), gpu_(gpu) {
    const std::size_t count = std::min(paths.size(), answers.size());
    count_ = options.path_options.empty() ? count : std::min(count, options.path_options.size());
  }

  GpuBatchResult run() {
    statistics_.paths = count_;
    GpuBatchResult result;
    if (!state_.is_on_device || options_.filter) {
      answer_on_host(0);
      result.finished = count_;
    } else {
      result.error = run_on_device();
      result.finished = finished_;
      if (result.error && gpu_.goes_on_without_device) {
        answer_on_host(finished_);
        result.finished = count_;
      }
    }
    result.is_complete = result.finished == count_;
    if (gpu_.statistics != nullptr) add(*gpu_.statistics);
    return result;
  }

 private:
  static constexpr std::size_t step = detail::paths_in_dispatch;

  /// While the device works on one slot, the host finishes the other.
  std::optional<GpuError> run_on_device() {
    GpuDeviceState& device = *state_.device;
    const std::lock_guard lock(device.mutex);
    if (device.is_lost) return GpuError(GpuError::Reason::device_lost, "the device was lost; it must be opened anew");
    detail::GpuWork work(device, state_.mesh);
    for (const GpuSlot& slot : device.slots) device.bind(slot, state_.mesh->nodes.get(), state_.mesh->triangles.get());
    std::size_t begun = 0;
    while (finished_ < count_) {
      if (begun < count_ && begun - finished_ < device.slots.size() * step) {
        if (auto error = begin(device.slots[begun / step % 2], begun)) return error;
        begun += std::min(step, count_ - begun);
        continue;
      }
      const GpuSlot& slot = device.slots[finished_ / step % 2];
      if (auto error = device.wait(slot)) return error;
      finish(slot, finished_);
      finished_ += std::min(step, count_ - finished_);
    }
    work.end();
    return std::nullopt;
  }

  std::optional<GpuError> begin(const GpuSlot& slot, std::size_t first) {
    const std::size_t count = std::min(step, count_ - first);
    auto* const numbers = reinterpret_cast<float*>(slot.host_paths.data());
    if (paths_.is_packed()) {
      std::memcpy(numbers, paths_.packed(first), count * sizeof(float[6]));
    } else {
      for (std::size_t i = 0; i < count; ++i) paths_.copy(first + i, numbers + 6 * i);
    }
    auto* const limits = reinterpret_cast<PathLimits*>(slot.host_limits.data());
    const bool has_own = !options_.path_options.empty();
    const std::size_t limit_count = has_own ? count : 1;
    for (std::size_t i = 0; i < limit_count; ++i) {
      limits[i] = limits_of(paths_.kind(), options_of(first + i));
    }
    ++statistics_.dispatches;
    const detail::PushedWords pushed = {static_cast<std::uint32_t>(count), paths_.kind() == PathKind::segment ? 1U : 0U,
                                        has_own ? 1U : 0U, detail::max_path_steps};
    constexpr detail::GpuTask task =
        std::is_same_v<Answer, Hitf> ? detail::GpuTask::first_hits : detail::GpuTask::any_hits;
    return state_.device->submit(slot, task, pushed, count * sizeof(float[6]), limit_count * sizeof(PathLimits),
                                 count * sizeof(std::uint32_t));
  }

  [[nodiscard]] const QueryOptionsf& options_of(std::size_t path) const {
    return options_.path_options.empty() ? options_.options : options_.path_options[path];
  }

  void finish(const GpuSlot& slot, std::size_t first) {
    const std::span found(reinterpret_cast<const std::uint32_t*>(slot.host_answers.data()),
                          std::min(step, count_ - first));
    const std::size_t triangle_count = state_.collider->triangle_count();
    open_.clear();
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (found[i] == miss) {
        ++statistics_.misses;
      } else if (found[i] >= triangle_count) {  // Undecided, or no answer of a sound device.
        open_.push_back(first + i);
      }
    }
    statistics_.undecided += open_.size();
    statistics_.hits += static_cast<std::uint64_t>(
        std::count_if(found.begin(), found.end(), [&](std::uint32_t answer) { return answer < triangle_count; }));
    in_tasks(options_.executor, found.size(), [&](std::size_t from, std::size_t to) {
      for (std::size_t i = from; i < to; ++i) {
        if (found[i] == miss) {
          set_miss(answers_[first + i]);
        } else if (found[i] < triangle_count) {
          set_hit(*state_.collider, paths_[first + i], options_of(first + i), found[i], answers_[first + i]);
        }
      }
    });
    answer_open();
  }

  /// Lets the host's batch answer the open paths.
  void answer_open() {
    if (open_.empty()) return;
    numbers_.resize(6 * open_.size());
    for (std::size_t i = 0; i < open_.size(); ++i) paths_.copy(open_[i], numbers_.data() + 6 * i);
    BatchOptionsf options = options_;
    if (!options_.path_options.empty()) {
      own_options_.clear();
      for (const std::size_t path : open_) own_options_.push_back(options_.path_options[path]);
      options.path_options = own_options_;
    }
    found_.resize(open_.size());
    ask(*state_.collider, span_of(paths_.kind(), numbers_), found_, options);
    for (std::size_t i = 0; i < open_.size(); ++i) answers_[open_[i]] = found_[i];
  }

  void answer_on_host(std::size_t first) {
    BatchOptionsf options = options_;
    if (!options.path_options.empty()) options.path_options = options.path_options.subspan(first, count_ - first);
    statistics_.undecided += count_ - first;
    ask(*state_.collider, paths_.subspan(first, count_ - first), answers_.subspan(first, count_ - first), options);
  }

  void add(GpuStatistics& statistics) const {
    statistics.paths += statistics_.paths;
    statistics.misses += statistics_.misses;
    statistics.hits += statistics_.hits;
    statistics.undecided += statistics_.undecided;
    statistics.dispatches += statistics_.dispatches;
  }

  const GpuColliderState& state_;
  const PathSpanf& paths_;
  std::span<Answer> answers_;
  const BatchOptionsf& options_;
  const GpuBatchOptions& gpu_;
  std::size_t count_ = 0;
  std::size_t finished_ = 0;
  GpuStatistics statistics_;
  std::vector<std::size_t> open_;  ///< The paths that the host answers.
  std::vector<float> numbers_;     ///< Their numbers.
  std::vector<QueryOptionsf> own_options_;
  std::vector<Answer> found_;
};

template <typename Answer>
GpuBatchResult answer(const GpuColliderState* state, const PathSpanf& paths, std::span<Answer> answers,
                      const BatchOptionsf& options, const GpuBatchOptions& gpu) {
  const FloatingPointEnvironment environment;
  GpuBatchResult refused;
  if (state == nullptr) {
    refused.error = GpuError(GpuError::Reason::not_updated, "no collider was uploaded");
    return refused;
  }
  const auto& now = detail::ColliderState<float>::of(*state->collider);
  if (now.version != state->version || now.mask_version != state->mask_version) {
    refused.error = GpuError(GpuError::Reason::not_updated,
                             "the collider was rebuilt or has other masks since it was uploaded; update it first");
    return refused;
  }
  return GpuBatch<Answer>(*state, paths, answers, options, gpu).run();
}

std::optional<GpuError> upload(GpuDeviceState& device, std::span<const std::byte> bytes, const char* what,
                               detail::GpuBuffer& buffer) {
  const std::uint64_t max = device.report.properties.limits.maxStorageBufferRange;
  if (bytes.size() > max) {
    return GpuError(GpuError::Reason::too_large, std::string(what) + " take " + std::to_string(bytes.size()) +
                                                     " bytes, and a buffer of " + device.name + " has at most " +
                                                     std::to_string(max));
  }
  if (auto error = buffer.make(device, bytes.size(), detail::GpuBuffer::Place::device, what)) return error;
  return device.upload(bytes, buffer);
}

}  // namespace

GpuResult GpuCollider::try_upload(const GpuDevice& device, const Colliderf& collider) {
  if (!device.is_open()) return GpuError(GpuError::Reason::no_device, "the device is not open");
  const FloatingPointEnvironment environment;
  const detail::TriangleTree tree(collider);
  const auto& now = detail::ColliderState<float>::of(collider);
  auto state = std::make_shared<GpuColliderState>();
  state->device = GpuDeviceState::of(device);
  state->collider = &collider;
  state->version = now.version;
  state->mask_version = now.mask_version;
  state->is_on_device = !tree.nodes.empty();
  state->mesh = std::make_shared<detail::GpuMesh>();
  if (state->is_on_device) {
    GpuDeviceState& on = *state->device;
    detail::GpuMesh& mesh = *state->mesh;
    const std::lock_guard lock(on.mutex);
    if (on.is_lost) return GpuError(GpuError::Reason::device_lost, "the device was lost; it must be opened anew");
    detail::GpuWork work(on, state->mesh);
    if (auto error = upload(on, std::as_bytes(std::span(tree.nodes)), "the nodes of a mesh", mesh.nodes)) {
      return *error;
    }
    if (auto error = upload(on, std::as_bytes(std::span(tree.triangles)), "the triangles of a mesh", mesh.triangles)) {
      return *error;
    }
    work.end();
  }
  state_ = std::move(state);
  return {};
}

GpuResult GpuCollider::try_update() {
  if (state_ == nullptr) return GpuError(GpuError::Reason::not_updated, "no collider was uploaded");
  return try_upload(GpuDeviceState::device_of(state_->device), *state_->collider);
}

GpuBatchResult GpuCollider::first_hits(const PathSpanf& paths, std::span<Hitf> hits, const BatchOptionsf& options,
                                       const GpuBatchOptions& gpu) const {
  return answer(state_.get(), paths, hits, options, gpu);
}

GpuBatchResult GpuCollider::any_hits(const PathSpanf& paths, std::span<std::uint8_t> blocked,
                                     const BatchOptionsf& options, const GpuBatchOptions& gpu) const {
  return answer(state_.get(), paths, blocked, options, gpu);
}

std::size_t GpuCollider::memory_bytes() const noexcept {
  return state_ == nullptr ? 0 : state_->mesh->nodes.size() + state_->mesh->triangles.size();
}

}  // namespace surehit
