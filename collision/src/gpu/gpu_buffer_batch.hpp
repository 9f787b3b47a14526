#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "gpu/device_answers.hpp"
#include "gpu/gpu_device_state.hpp"
#include "gpu/host_answers.hpp"
#include "gpu/in_dispatches.hpp"
#include "surehit/gpu.hpp"
#include "surehit/scene_hit.hpp"

namespace surehit::detail {

/// Returns what is wrong with the buffers of a batch, or nothing.
[[nodiscard]] std::optional<GpuError> buffer_fault(const GpuDeviceState& device, const GpuPaths& paths,
                                                   const GpuBufferPart& answers, std::uint64_t answer_size,
                                                   std::uint64_t count);
/// Returns a buffer of the caller's.
[[nodiscard]] VkBuffer buffer_of(const GpuBufferPart& part);

/// Returns an answer as it is in a buffer of the caller's.
[[nodiscard]] inline DeviceHit device_answer(const Hitf& hit) {
  return {hit.t, hit.u, hit.v, hit.triangle, static_cast<std::uint32_t>(hit.side)};
}
[[nodiscard]] inline DeviceSceneHit device_answer(const SceneHitf& hit) {
  return {device_answer(static_cast<const Hitf&>(hit)), hit.instance.index};
}
[[nodiscard]] inline DeviceAny device_answer(std::uint8_t blocked) { return blocked; }

/// A batch whose paths and answers are in buffers of the caller's. The device writes its answers there and lists what
/// is left to the host. The host's answers are copied over those of the device. The state is that of an uploaded
/// collider or scene.
template <typename State, typename Answer>
class GpuBufferBatch {
 public:
  using BatchOptions = typename State::BatchOptions;

  GpuBufferBatch(const State& state, const GpuPaths& paths, const GpuBufferPart& answers, const BatchOptions& options,
                 const GpuBatchOptions& gpu)
      : state_(state), device_(*state.device), paths_(paths), answers_(answers), options_(options), gpu_(gpu) {
    count_ = options.path_options.empty() ? paths.count : std::min(paths.count, options.path_options.size());
  }

  GpuBatchResult run() {
    statistics_.paths = count_;
    GpuBatchResult result;
    result.error = error_of_work(device_.no_memory,
                                 [&] { return buffer_fault(device_, paths_, answers_, sizeof(DeviceAnswer), count_); });
    if (!result.error) {
      is_for_host_ = !state_.is_on_device || options_.filter;
      result.error = error_of_work(device_.no_memory, [&] {
        return in_dispatches(
            device_, state_.mesh, count_, result.finished,
            [&](GpuSlot& slot, std::size_t first, std::size_t count) { return begin(slot, first, count); },
            [&](GpuSlot& slot, std::size_t first, std::size_t count) { return finish(slot, first, count); });
      });
      // Whatever failed first, the device may still use the buffers.
      if (result.error && device_.is_lost) result.error = device_.lost;
    }
    result.is_complete = !result.error && result.finished == count_;
    if (gpu_.statistics != nullptr) add(statistics_, *gpu_.statistics);
    return result;
  }

 private:
  static constexpr std::size_t path_size = sizeof(float[6]);
  static constexpr bool wants_first = std::is_same_v<Answer, typename State::FirstHit>;
  /// True if the host only rounds the hits that the device has found. A scene rounds while it answers.
  static constexpr bool rounds_on_host = std::is_same_v<Answer, Hitf>;
  using DeviceAnswer = std::conditional_t<wants_first, typename State::DeviceFirst, DeviceAny>;
  /// So much of the list comes back with the dispatch. The rest is fetched where there is more.
  static constexpr std::size_t listed_at_once = 1024;

  [[nodiscard]] GpuRange paths_from(std::size_t first, std::size_t count) const {
    return {buffer_of(paths_.part), paths_.part.offset + first * path_size, count * path_size};
  }
  [[nodiscard]] GpuRange answers_from(std::size_t first, std::size_t count) const {
    return {buffer_of(answers_), answers_.offset + first * sizeof(DeviceAnswer), count * sizeof(DeviceAnswer)};
  }
  [[nodiscard]] static std::size_t list_size(std::size_t listed) {
    return sizeof(ListedCounts) + listed * sizeof(ListedPath);
  }

  std::optional<GpuError> begin(GpuSlot& slot, std::size_t first, std::size_t count) {
    const GpuRange paths = paths_from(first, count);
    if (auto error = make_room(slot, room_for(count))) return error;
    const bool waits_for_all = first == 0;  // All work of the caller's comes before the first dispatch.
    if (is_for_host_) {
      const GpuCopy back = {paths.buffer, slot.host_paths.get(), {paths.offset, 0, paths.size}};
      return device_.submit(slot, {&back, 1}, nullptr, {}, waits_for_all);
    }
    const std::size_t limits = write_limits(state_, slot, paths_.kind, options_, first, count);
    slot.clear_list();
    const GpuCopy there[] = {copy_of(slot.host_limits, slot.limits, limits * sizeof(PathLimits)),
                             copy_of(slot.host_list, slot.list, sizeof(ListedCounts))};
    const GpuDispatch dispatch = {wants_first ? State::first_task : State::any_task,
                                  pushed_words(paths_.kind, !options_.path_options.empty(), count, true)};
    const GpuCopy back = copy_of(slot.list, slot.host_list, list_size(std::min(count, listed_at_once)));
    device_.bind(slot, state_.mesh->buffers(), paths, answers_from(first, count));
    auto error = device_.submit(slot, there, &dispatch, {&back, 1}, waits_for_all);
    if (!error) ++statistics_.dispatches;
    return error;
  }

  /// Lets a slot have room for so many paths. That for long lists of the host is made where there are some.
  std::optional<GpuError> make_room(GpuSlot& slot, std::size_t count) const {
    constexpr auto on_host = GpuBuffer::Place::host;
    constexpr auto on_device = GpuBuffer::Place::device;
    if (is_for_host_) {
      const GpuRoom room = {&slot.host_paths, on_host, count * path_size};
      return device_.make_room({&room, 1});
    }
    const std::size_t limits = (options_.path_options.empty() ? 1 : count) * sizeof(PathLimits);
    const GpuRoom rooms[] = {{&slot.host_limits, on_host, limits},
                             {&slot.limits, on_device, limits},
                             {&slot.host_list, on_host, list_size(std::min(count, listed_at_once))},
                             {&slot.list, on_device, list_size(count)}};
    return device_.make_room(rooms);
  }

  std::optional<GpuError> finish(GpuSlot& slot, std::size_t first, std::size_t count) {
    if (is_for_host_) {
      take_all(slot, count);
    } else if (auto error = take_list(slot, count)) {
      return error;
    }
    if (listed_.empty()) return std::nullopt;
    answer_listed(first);
    return write_back(slot, answers_from(first, count));
  }

  /// Takes all paths of a dispatch, which the host answers.
  void take_all(GpuSlot& slot, std::size_t count) {
    statistics_.undecided += count;
    listed_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      listed_[i].path = static_cast<std::uint32_t>(i);
      listed_[i].triangle = no_triangle;
      std::memcpy(listed_[i].numbers.data(), slot.host_paths.data() + i * path_size, path_size);
    }
  }

  /// Takes the list of a dispatch, by the order of paths.
  std::optional<GpuError> take_list(GpuSlot& slot, std::size_t count) {
    ListedCounts counts;
    std::memcpy(&counts, slot.host_list.data(), sizeof counts);
    if (counts.leftovers > count || counts.misses > count - counts.leftovers) return odd_list();
    if (counts.leftovers > listed_at_once) {
      const std::size_t bytes = list_size(counts.leftovers);
      const GpuRoom room = {&slot.host_list, GpuBuffer::Place::host, bytes};
      if (auto error = device_.make_room({&room, 1})) return error;
      const GpuCopy rest = copy_of(slot.list, slot.host_list, bytes);
      if (auto error = device_.submit(slot, {&rest, 1}, nullptr, {})) return error;
      if (auto error = device_.wait(slot)) return error;
    }
    listed_.resize(counts.leftovers);
    if (!listed_.empty()) {
      std::memcpy(listed_.data(), slot.host_list.data() + sizeof counts, listed_.size() * sizeof(ListedPath));
    }
    std::sort(listed_.begin(), listed_.end(), [](const ListedPath& x, const ListedPath& y) { return x.path < y.path; });
    std::size_t unrounded = 0;
    for (std::size_t i = 0; i < listed_.size(); ++i) {
      if (listed_[i].path >= count || (i > 0 && listed_[i].path == listed_[i - 1].path)) return odd_list();
      if (is_unrounded(listed_[i])) ++unrounded;
    }
    const std::size_t undecided = listed_.size() - unrounded;
    const std::size_t hits = count - counts.misses - undecided;
    statistics_.misses += counts.misses;
    statistics_.undecided += undecided;
    statistics_.hits += hits;
    statistics_.rounded_by_host += unrounded;
    if (wants_first) statistics_.rounded += hits - unrounded;
    return std::nullopt;
  }

  [[nodiscard]] GpuError odd_list() const {
    return {GpuError::Reason::failed, device_.name + " has listed paths that it was not given"};
  }
  [[nodiscard]] bool is_unrounded(const ListedPath& listed) const { return wants_first && state_.has_hit(listed); }

  /// Sets `written_[i]` to the answer of `listed_[i]`.
  void answer_listed(std::size_t first) {
    written_.resize(listed_.size());
    open_.clear();
    open_paths_.clear();
    numbers_.clear();
    for (std::size_t i = 0; i < listed_.size(); ++i) {
      if (rounds_on_host && is_unrounded(listed_[i])) continue;
      open_.push_back(i);
      open_paths_.push_back(first + listed_[i].path);
      numbers_.insert(numbers_.end(), listed_[i].numbers.begin(), listed_[i].numbers.end());
    }
    if constexpr (rounds_on_host) {
      in_tasks(options_.executor, listed_.size(), [&](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i < to; ++i) {
          if (!is_unrounded(listed_[i])) continue;
          const std::array<float, 6>& x = listed_[i].numbers;
          const Pathf path(paths_.kind, Vector3f(x[0], x[1], x[2]), Vector3f(x[3], x[4], x[5]));
          Hitf hit;
          round_on_host(state_.asked(), path, options_of(options_, first + listed_[i].path), listed_[i].triangle, hit);
          written_[i] = device_answer(hit);
        }
      });
    }
    if (open_.empty()) return;
    answer_open(state_.asked(), paths_.kind, numbers_, open_paths_, options_, found_);
    for (std::size_t i = 0; i < open_.size(); ++i) written_[open_[i]] = device_answer(found_[i]);
  }

  /// Copies the answers of the host into the caller's buffer: those that lie side by side at once.
  std::optional<GpuError> write_back(GpuSlot& slot, const GpuRange& answers) {
    const std::size_t bytes = written_.size() * sizeof(DeviceAnswer);
    const GpuRoom room = {&slot.host_answers, GpuBuffer::Place::host, room_for(written_.size()) * sizeof(DeviceAnswer)};
    if (auto error = device_.make_room({&room, 1})) return error;
    std::memcpy(slot.host_answers.data(), written_.data(), bytes);
    copies_.clear();
    for (std::size_t i = 0; i < listed_.size();) {
      std::size_t end = i + 1;
      while (end < listed_.size() && listed_[end].path == listed_[end - 1].path + 1) ++end;
      copies_.push_back({slot.host_answers.get(),
                         answers.buffer,
                         {i * sizeof(DeviceAnswer), answers.offset + listed_[i].path * sizeof(DeviceAnswer),
                          (end - i) * sizeof(DeviceAnswer)}});
      i = end;
    }
    if (auto error = device_.submit(slot, copies_, nullptr, {})) return error;
    return device_.wait(slot);
  }

  const State& state_;
  GpuDeviceState& device_;
  const GpuPaths& paths_;
  const GpuBufferPart& answers_;
  const BatchOptions& options_;
  const GpuBatchOptions& gpu_;
  std::size_t count_ = 0;
  bool is_for_host_ = false;
  GpuStatistics statistics_;
  std::vector<ListedPath> listed_;       ///< What the host finishes of a dispatch.
  std::vector<DeviceAnswer> written_;    ///< The answers to it.
  std::vector<std::size_t> open_;        ///< Where the paths are in the list that the host answers.
  std::vector<std::size_t> open_paths_;  ///< Which paths of the batch they are.
  std::vector<float> numbers_;           ///< Their numbers.
  std::vector<Answer> found_;
  std::vector<GpuCopy> copies_;
};

}  // namespace surehit::detail
