#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "gpu/device_answers.hpp"
#include "gpu/gpu_device_state.hpp"
#include "gpu/host_answers.hpp"
#include "gpu/in_dispatches.hpp"
#include "surehit/gpu.hpp"

namespace surehit::detail {

/// A batch of one kind, on its way through the device and the host. The state is that of an uploaded collider or scene.
template <typename State, typename Answer>
class GpuBatch {
 public:
  using BatchOptions = typename State::BatchOptions;

  GpuBatch(const State& state, const PathSpanf& paths, std::span<Answer> answers, const BatchOptions& options,
           const GpuBatchOptions& gpu)
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
  static constexpr bool wants_first = std::is_same_v<Answer, typename State::FirstHit>;
  using DeviceAnswer = std::conditional_t<wants_first, typename State::DeviceFirst, DeviceAny>;

  std::optional<GpuError> run_on_device() {
    return in_dispatches(
        *state_.device, state_.mesh, count_, finished_,
        [&](GpuSlot& slot, std::size_t first) { return begin(slot, first); },
        [&](GpuSlot& slot, std::size_t first) {
          finish(slot, first);
          return std::optional<GpuError>();
        });
  }

  std::optional<GpuError> begin(GpuSlot& slot, std::size_t first) {
    const std::size_t count = std::min(step, count_ - first);
    auto* const numbers = reinterpret_cast<float*>(slot.host_paths.data());
    if (paths_.is_packed()) {
      std::memcpy(numbers, paths_.packed(first), count * sizeof(float[6]));
    } else {
      for (std::size_t i = 0; i < count; ++i) paths_.copy(first + i, numbers + 6 * i);
    }
    const std::size_t limits = write_limits(state_, slot, paths_.kind(), options_, first, count);
    const GpuCopy there[] = {copy_of(slot.host_paths, slot.paths, count * sizeof(float[6])),
                             copy_of(slot.host_limits, slot.limits, limits * sizeof(PathLimits))};
    const GpuDispatch dispatch = {wants_first ? State::first_task : State::any_task,
                                  pushed_words(paths_.kind(), !options_.path_options.empty(), count, false)};
    const GpuCopy back = copy_of(slot.answers, slot.host_answers, count * sizeof(DeviceAnswer));
    state_.device->bind(slot, state_.mesh->buffers(), {slot.paths.get()}, {slot.answers.get()});
    auto error = state_.device->submit(slot, there, &dispatch, {&back, 1});
    if (!error) ++statistics_.dispatches;
    return error;
  }

  void finish(GpuSlot& slot, std::size_t first) {
    const std::span found(reinterpret_cast<const DeviceAnswer*>(slot.host_answers.data()),
                          std::min(step, count_ - first));
    open_.clear();
    unrounded_.clear();
    for (std::size_t i = 0; i < found.size(); ++i) {
      switch (state_.leftover_of(found[i])) {
        case Leftover::nothing_of_miss:
          ++statistics_.misses;
          answers_[first + i] = answer_on_device(found[i]);
          break;
        case Leftover::nothing_of_hit:
          ++statistics_.hits;
          if (wants_first) ++statistics_.rounded;
          answers_[first + i] = answer_on_device(found[i]);
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
    if constexpr (std::is_same_v<Answer, Hitf>) {
      in_tasks(options_.executor, unrounded_.size(), [&](std::size_t from, std::size_t to) {
        for (const std::size_t i : std::span(unrounded_).subspan(from, to - from)) {
          round_on_host(state_.asked(), paths_[first + i], options_of(options_, first + i), found[i].triangle,
                        answers_[first + i]);
        }
      });
    } else {
      for (const std::size_t i : unrounded_) open_.push_back(first + i);  // A scene rounds while it answers.
    }
    if (open_.empty()) return;
    numbers_.resize(6 * open_.size());
    for (std::size_t i = 0; i < open_.size(); ++i) paths_.copy(open_[i], numbers_.data() + 6 * i);
    answer_open(state_.asked(), paths_.kind(), numbers_, open_, options_, found_);
    for (std::size_t i = 0; i < open_.size(); ++i) answers_[open_[i]] = found_[i];
  }

  /// Returns an answer that has left nothing to the host.
  Answer answer_on_device(const DeviceAnswer& answer) const {
    if constexpr (wants_first) {
      return state_.answer_of(answer);
    } else {
      return answer_of(answer);
    }
  }

  void answer_on_host(std::size_t first) {
    BatchOptions options = options_;
    if (!options.path_options.empty()) options.path_options = options.path_options.subspan(first, count_ - first);
    statistics_.undecided += count_ - first;
    ask(state_.asked(), paths_.subspan(first, count_ - first), answers_.subspan(first, count_ - first), options);
  }

  const State& state_;
  const PathSpanf& paths_;
  std::span<Answer> answers_;
  const BatchOptions& options_;
  const GpuBatchOptions& gpu_;
  std::size_t count_ = 0;
  std::size_t finished_ = 0;
  GpuStatistics statistics_;
  std::vector<std::size_t> unrounded_;  ///< The paths of a dispatch that the host rounds.
  std::vector<std::size_t> open_;       ///< The paths that the host answers.
  std::vector<float> numbers_;          ///< Their numbers.
  std::vector<Answer> found_;
};

}  // namespace surehit::detail
