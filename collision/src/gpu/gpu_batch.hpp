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
    const bool asks_device = state_.is_on_device && !options_.filter;
    if (asks_device) {
      result.error = error_of_work(state_.device->no_memory, [&] { return run_on_device(); });
    }
    // The queries of the host need no memory, and throw nothing.
    if (!asks_device || (result.error && gpu_.goes_on_without_device)) answer_on_host();
    result.finished = finished_;
    result.is_complete = finished_ == count_;
    if (gpu_.statistics != nullptr) add(statistics_, *gpu_.statistics);
    return result;
  }

 private:
  static constexpr bool wants_first = std::is_same_v<Answer, typename State::FirstHit>;
  using DeviceAnswer = std::conditional_t<wants_first, typename State::DeviceFirst, DeviceAny>;

  std::optional<GpuError> run_on_device() {
    return in_dispatches(
        *state_.device, state_.mesh, count_, finished_,
        [&](GpuSlot& slot, std::size_t first, std::size_t count) { return begin(slot, first, count); },
        [&](GpuSlot& slot, std::size_t first, std::size_t count) {
          finish(slot, first, count);
          return std::optional<GpuError>();
        });
  }

  std::optional<GpuError> begin(GpuSlot& slot, std::size_t first, std::size_t count) {
    const std::size_t room = room_for(count);
    const std::size_t limit_room = options_.path_options.empty() ? 1 : room;
    if (auto error = state_.device->make_room(
            slot.rooms(room * sizeof(float[6]), limit_room * sizeof(PathLimits), room * sizeof(DeviceAnswer), room))) {
      return error;
    }
    auto* const numbers = reinterpret_cast<float*>(slot.host_paths.data());
    in_tasks(options_.executor, count, [&](std::size_t from, std::size_t to) {
      if (paths_.is_packed()) {
        std::memcpy(numbers + 6 * from, paths_.packed(first + from), (to - from) * sizeof(float[6]));
      } else {
        for (std::size_t i = from; i < to; ++i) paths_.copy(first + i, numbers + 6 * i);
      }
    });
    const std::size_t limits = write_limits(state_, slot, paths_.kind(), options_, first, count);
    slot.clear_list();
    const GpuCopy there[] = {copy_of(slot.host_paths, slot.paths, count * sizeof(float[6])),
                             copy_of(slot.host_limits, slot.limits, limits * sizeof(PathLimits)),
                             copy_of(slot.host_list, slot.list, sizeof(ListedCounts))};
    const GpuDispatch dispatch = {wants_first ? State::first_task : State::any_task,
                                  pushed_words(paths_.kind(), !options_.path_options.empty(), count, false)};
    const GpuCopy back = copy_of(slot.answers, slot.host_answers, count * sizeof(DeviceAnswer));
    state_.device->bind(slot, state_.mesh->buffers(), {slot.paths.get()}, {slot.answers.get()});
    auto error = state_.device->submit_apart(slot, there, dispatch, {&back, 1});
    if (!error) ++statistics_.dispatches;
    return error;
  }

  /// Answers the paths of a dispatch. All that may find no memory comes before the first answer.
  void finish(GpuSlot& slot, std::size_t first, std::size_t count) {
    const std::span found(reinterpret_cast<const DeviceAnswer*>(slot.host_answers.data()), count);
    const LeftCounts left = find_leftovers(found, first);
    if constexpr (std::is_same_v<Answer, Hitf>) {
      rounded_.resize(unrounded_.size());
      in_tasks(options_.executor, unrounded_.size(), [&](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i < to; ++i) {
          const std::size_t path = first + unrounded_[i];
          round_on_host(state_.asked(), paths_[path], options_of(options_, path), found[unrounded_[i]].triangle,
                        rounded_[i]);
        }
      });
    } else {
      for (const std::size_t i : unrounded_) open_.push_back(first + i);  // A scene rounds while it answers.
    }
    if (!open_.empty()) {
      numbers_.resize(6 * open_.size());
      for (std::size_t i = 0; i < open_.size(); ++i) paths_.copy(open_[i], numbers_.data() + 6 * i);
      answer_open(state_.asked(), paths_.kind(), numbers_, open_, options_, found_);
    }

    in_tasks(options_.executor, found.size(), [&](std::size_t from, std::size_t to) {
      for (std::size_t i = from; i < to; ++i) {
        const Leftover leftover = state_.leftover_of(found[i]);
        if (leftover == Leftover::nothing_of_miss || leftover == Leftover::nothing_of_hit) {
          answers_[first + i] = answer_on_device(found[i]);
        }
      }
    });
    for (std::size_t i = 0; i < rounded_.size(); ++i) answers_[first + unrounded_[i]] = rounded_[i];
    for (std::size_t i = 0; i < open_.size(); ++i) answers_[open_[i]] = found_[i];
    const std::size_t hits = found.size() - left.misses - left.open;
    statistics_.misses += left.misses;
    statistics_.undecided += left.open;
    statistics_.hits += hits;
    statistics_.rounded_by_host += left.unrounded;
    if (wants_first) statistics_.rounded += hits - left.unrounded;
  }

  /// What a dispatch, or a task of the host for it, has to do with how many paths.
  struct LeftCounts {
    std::size_t misses = 0, unrounded = 0, open = 0;
  };

  /// Lists what is left to the host. Tasks count first, so that none of them needs memory.
  LeftCounts find_leftovers(std::span<const DeviceAnswer> found, std::size_t first) {
    of_tasks_.assign(found.size() / paths_in_a_task + 1, {});
    in_tasks(options_.executor, found.size(), [&](std::size_t from, std::size_t to) {
      LeftCounts counts;
      for (std::size_t i = from; i < to; ++i) {
        const Leftover leftover = state_.leftover_of(found[i]);
        counts.misses += leftover == Leftover::nothing_of_miss ? 1 : 0;
        counts.unrounded += leftover == Leftover::rounding ? 1 : 0;
        counts.open += leftover == Leftover::all ? 1 : 0;
      }
      of_tasks_[from / paths_in_a_task] = counts;
    });
    LeftCounts all;
    for (LeftCounts& counts : of_tasks_) {  // Each becomes where the lists of its task begin.
      const LeftCounts before = all;
      all.misses += counts.misses;
      all.unrounded += counts.unrounded;
      all.open += counts.open;
      counts = before;
    }
    unrounded_.resize(all.unrounded);
    open_.resize(all.open);
    if (all.unrounded + all.open == 0) return all;
    in_tasks(options_.executor, found.size(), [&](std::size_t from, std::size_t to) {
      LeftCounts next = of_tasks_[from / paths_in_a_task];
      for (std::size_t i = from; i < to; ++i) {
        const Leftover leftover = state_.leftover_of(found[i]);
        if (leftover == Leftover::rounding) unrounded_[next.unrounded++] = i;
        if (leftover == Leftover::all) open_[next.open++] = first + i;
      }
    });
    return all;
  }

  /// Returns an answer that has left nothing to the host.
  Answer answer_on_device(const DeviceAnswer& answer) const {
    if constexpr (wants_first) {
      return state_.answer_of(answer);
    } else {
      return answer_of(answer);
    }
  }

  /// Answers all paths that are not finished.
  void answer_on_host() {
    const std::size_t count = count_ - finished_;
    BatchOptions options = options_;
    if (!options.path_options.empty()) options.path_options = options.path_options.subspan(finished_, count);
    ask(state_.asked(), paths_.subspan(finished_, count), answers_.subspan(finished_, count), options);
    statistics_.undecided += count;
    finished_ = count_;
  }

  const State& state_;
  const PathSpanf& paths_;
  std::span<Answer> answers_;
  const BatchOptions& options_;
  const GpuBatchOptions& gpu_;
  std::size_t count_ = 0;
  std::size_t finished_ = 0;
  GpuStatistics statistics_;
  std::vector<LeftCounts> of_tasks_;
  std::vector<std::size_t> unrounded_;  ///< The paths of a dispatch that the host rounds.
  std::vector<Answer> rounded_;         ///< Their answers.
  std::vector<std::size_t> open_;       ///< The paths that the host answers.
  std::vector<float> numbers_;          ///< Their numbers.
  std::vector<Answer> found_;
};

}  // namespace surehit::detail
