#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "support/floating_point_environment.hpp"
#include "surehit/batch_options.hpp"
#include "surehit/collider.hpp"
#include "surehit/intersect.hpp"

namespace surehit::detail {

// What the host does for the paths that a device leaves to it.

/// The number of paths in a task of the host.
inline constexpr std::size_t paths_in_a_task = 4096;

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

/// Returns a view of paths whose numbers lie side by side.
[[nodiscard]] inline PathSpanf span_of(PathKind kind, std::span<const float> numbers) {
  const std::size_t count = numbers.size() / 6;
  const float* const first = numbers.data();
  if (count == 0) return {};
  if (kind == PathKind::segment) return std::span(reinterpret_cast<const Segmentf*>(first), count);
  if (kind == PathKind::ray) return std::span(reinterpret_cast<const Rayf*>(first), count);
  return std::span(reinterpret_cast<const Linef*>(first), count);
}

/// Asks a collider or a scene.
template <typename Asked, typename Hit, typename BatchOptions>
void ask(const Asked& asked, const PathSpanf& paths, std::span<Hit> hits, const BatchOptions& options) {
  asked.first_hits(paths, hits, options);
}
template <typename Asked, typename BatchOptions>
void ask(const Asked& asked, const PathSpanf& paths, std::span<std::uint8_t> blocked, const BatchOptions& options) {
  asked.any_hits(paths, blocked, options);
}

/// Sets the answer of a path that certainly hits this triangle, and certainly first. The weights and t do not depend on
/// the options (G9). A faulty device may name a triangle that is not hit.
inline void round_on_host(const Colliderf& collider, const Pathf& path, const QueryOptionsf& options,
                          std::uint32_t triangle, Hitf& hit) {
  if (const auto found = intersect<float>(path, collider.triangle(triangle))) {
    hit = *found;
    hit.triangle = triangle;
  } else {
    hit = collider.first_hit(path, options).value_or(Hitf{});
  }
}

/// Answers some paths by the host's batch, with the options that they have in theirs. Their numbers lie side by side,
/// and `open` has their indices in the batch of the caller, which a filter takes.
template <typename Asked, typename BatchOptions, typename Answer>
void answer_open(const Asked& asked, PathKind kind, const std::vector<float>& numbers,
                 const std::vector<std::size_t>& open, const BatchOptions& options, std::vector<Answer>& found) {
  BatchOptions own = options;
  std::vector<decltype(options.options)> own_options;
  if (!options.path_options.empty()) {
    for (const std::size_t path : open) own_options.push_back(options.path_options[path]);
    own.path_options = own_options;
  }
  const auto of_batch = [&](std::size_t path, const auto& hit) { return (*options.filter)(open[path], hit); };
  if (options.filter) own.filter = of_batch;
  found.resize(open.size());
  ask(asked, span_of(kind, numbers), std::span<Answer>(found), own);
}

}  // namespace surehit::detail
