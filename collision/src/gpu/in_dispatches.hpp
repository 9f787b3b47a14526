#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <optional>

#include "gpu/gpu_device_state.hpp"
#include "gpu/path_limits.hpp"
#include "surehit/path.hpp"

namespace surehit::detail {

/// Cuts a batch of `count` paths into dispatches. While the device works on one slot, the host finishes the other.
/// Nothing is locked, so what runs in `begin` and `finish` may ask the device anew. `begin(slot, first, some)` and
/// `finish(slot, first, some)` are for `some` paths from `first` on, and return errors. `finished` is set to the number
/// of finished paths, even if there is an error.
template <typename Begin, typename Finish>
[[nodiscard]] std::optional<GpuError> in_dispatches(GpuDeviceState& device, const std::shared_ptr<GpuMesh>& mesh,
                                                    std::size_t count, std::size_t& finished, const Begin& begin,
                                                    const Finish& finish) {
  GpuWork work(device);
  if (auto error = work.begin(mesh)) return error;
  std::array<GpuSlot, 2>& slots = work.slots();
  std::array<std::size_t, 2> under_way = {};  // How many paths are in each slot.
  std::size_t begun = 0, next = 0;            // Dispatches begin and end in the slots by turns.
  std::size_t oldest = 0;
  while (finished < count) {
    if (begun < count && under_way[next] == 0) {
      const std::size_t some = std::min<std::size_t>(device.dispatch_size.paths(), count - begun);
      if (auto error = begin(slots[next], begun, some)) {
        const bool is_too_large = error->reason == GpuError::Reason::out_of_memory && !device.is_lost;
        if (is_too_large && device.dispatch_size.shrink_below(some)) continue;
        return error;
      }
      under_way[next] = some;
      begun += some;
      next = 1 - next;
      continue;
    }
    if (auto error = device.wait(slots[oldest])) return error;
    if (auto error = finish(slots[oldest], finished, under_way[oldest])) return error;
    finished += under_way[oldest];
    under_way[oldest] = 0;
    oldest = 1 - oldest;
  }
  return std::nullopt;
}

/// Returns for how many paths a slot gets room, so that it need not grow each time.
[[nodiscard]] inline std::size_t room_for(std::size_t count) {
  return std::max(std::bit_ceil(count), std::size_t{1024});
}

/// Returns what `work` returns, or `no_memory` where it finds no memory. A batch that throws could not say how many
/// paths have their answers.
template <typename Work>
[[nodiscard]] std::optional<GpuError> error_of_work(const GpuError& no_memory, const Work& work) {
#if defined(__cpp_exceptions)
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return no_memory;
  }
#else
  return work();
#endif
}

/// Returns the options of a path in a batch.
template <typename BatchOptions>
[[nodiscard]] const auto& options_of(const BatchOptions& options, std::size_t path) {
  return options.path_options.empty() ? options.options : options.path_options[path];
}

/// Writes the limits of some paths into a slot. Returns their number, which is 1 if all paths have the same.
template <typename State, typename BatchOptions>
[[nodiscard]] std::size_t write_limits(const State& state, const GpuSlot& slot, PathKind kind,
                                       const BatchOptions& options, std::size_t first, std::size_t count) {
  auto* const limits = reinterpret_cast<PathLimits*>(slot.host_limits.data());
  const std::size_t limit_count = options.path_options.empty() ? 1 : count;
  for (std::size_t i = 0; i < limit_count; ++i) limits[i] = state.limits(kind, options_of(options, first + i));
  return limit_count;
}

/// Returns what the shader is told of a dispatch.
[[nodiscard]] inline PushedWords pushed_words(PathKind kind, bool has_own_options, std::size_t count, bool lists) {
  return {static_cast<std::uint32_t>(count), kind == PathKind::segment ? 1U : 0U, has_own_options ? 1U : 0U,
          max_steps_of(count), lists ? 1U : 0U};
}

/// Returns a copy of the first bytes of a buffer to the beginning of another one.
[[nodiscard]] inline GpuCopy copy_of(const GpuBuffer& from, const GpuBuffer& to, std::size_t bytes) {
  return {from.get(), to.get(), {0, 0, bytes}};
}

/// Adds what a batch did.
inline void add(const GpuStatistics& of_batch, GpuStatistics& all) {
  all.paths += of_batch.paths;
  all.misses += of_batch.misses;
  all.hits += of_batch.hits;
  all.rounded += of_batch.rounded;
  all.rounded_by_host += of_batch.rounded_by_host;
  all.undecided += of_batch.undecided;
  all.dispatches += of_batch.dispatches;
}

}  // namespace surehit::detail
