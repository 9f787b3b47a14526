#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <mutex>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "gpu/device_answers.hpp"
#include "gpu/gpu_collider_state.hpp"
#include "gpu/host_answers.hpp"
#include "gpu/path_limits.hpp"
#include "surehit/gpu.hpp"

namespace surehit::detail {

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
    if (gpu_.statistics != nullptr) add(statistics_, *gpu_.statistics);
    return result;
  }

 private:
  static constexpr std::size_t step = paths_in_dispatch;
  static constexpr bool wants_first = std::is_same_v<Answer, Hitf>;
  using DeviceAnswer = std::conditional_t<wants_first, DeviceHit, DeviceAny>;

  /// While the device works on one slot, the host finishes the other.
  std::optional<GpuError> run_on_device() {
    GpuDeviceState& device = *state_.device;
    const std::lock_guard lock(device.mutex);
    if (device.is_lost) return GpuError(GpuError::Reason::device_lost, "the device was lost; it must be opened anew");
    GpuWork work(device, state_.mesh);
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
    for (std::size_t i = 0; i < limit_count; ++i) limits[i] = path_limits(paths_.kind(), options_of(first + i));
    ++statistics_.dispatches;
    const PushedWords pushed = {static_cast<std::uint32_t>(count), paths_.kind() == PathKind::segment ? 1U : 0U,
                                has_own ? 1U : 0U, max_path_steps};
    return state_.device->submit(slot, wants_first ? GpuTask::first_hits : GpuTask::any_hits, pushed,
                                 count * sizeof(float[6]), limit_count * sizeof(PathLimits),
                                 count * sizeof(DeviceAnswer));
  }

  [[nodiscard]] const QueryOptionsf& options_of(std::size_t path) const {
    return options_.path_options.empty() ? options_.options : options_.path_options[path];
  }

  void finish(const GpuSlot& slot, std::size_t first) {
    const std::span found(reinterpret_cast<const DeviceAnswer*>(slot.host_answers.data()),
                          std::min(step, count_ - first));
    const std::size_t triangle_count = state_.collider->triangle_count();
    open_.clear();
    unrounded_.clear();
    for (std::size_t i = 0; i < found.size(); ++i) {
      switch (leftover_of(found[i], triangle_count)) {
        case Leftover::nothing_of_miss:
          ++statistics_.misses;
          answers_[first + i] = answer_of(found[i]);
          break;
        case Leftover::nothing_of_hit:
          ++statistics_.hits;
          if (wants_first) ++statistics_.rounded;
          answers_[first + i] = answer_of(found[i]);
          break;
        case Leftover::rounding:
          unrounded_.push_back(i);
          break;
        case Leftover::all:
          open_.push_back(first + i);
      }
    }
    statistics_.undecided += open_.size();
    statistics_.hits += unrounded_.size();
    statistics_.rounded_by_host += unrounded_.size();
    if constexpr (wants_first) {
      in_tasks(options_.executor, unrounded_.size(), [&](std::size_t from, std::size_t to) {
        for (const std::size_t i : std::span(unrounded_).subspan(from, to - from)) {
          round_on_host(*state_.collider, paths_[first + i], options_of(first + i), found[i].triangle,
                        answers_[first + i]);
        }
      });
    }
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

  const GpuColliderState& state_;
  const PathSpanf& paths_;
  std::span<Answer> answers_;
  const BatchOptionsf& options_;
  const GpuBatchOptions& gpu_;
  std::size_t count_ = 0;
  std::size_t finished_ = 0;
  GpuStatistics statistics_;
  std::vector<std::size_t> unrounded_;  ///< The paths of a dispatch that the host rounds.
  std::vector<std::size_t> open_;       ///< The paths that the host answers.
  std::vector<float> numbers_;          ///< Their numbers.
  std::vector<QueryOptionsf> own_options_;
  std::vector<Answer> found_;
};

}  // namespace surehit::detail
