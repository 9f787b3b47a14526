#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>

#include "support/floating_point_environment.hpp"
#include "surehit/executor.hpp"

namespace surehit::detail {

/// Returns null if there is no executor.
[[nodiscard]] inline const Executor* address_of(const std::optional<Executor>& executor) {
  return executor ? &*executor : nullptr;
}

/// Calls `work(first, last)` for parts of [0, count), each of this `size`, in tasks of the executor. Without an
/// executor it calls `work` once, for all. Each call has its own FloatingPointEnvironment, because a task may run on
/// another thread.
template <typename Work>
void in_parts(const Executor* executor, std::size_t count, std::size_t size, const Work& work) {
  if (executor == nullptr || count <= size) {
    const FloatingPointEnvironment environment;
    work(std::size_t{0}, count);
    return;
  }
  executor->run((count + size - 1) / size, [&](std::size_t part) {
    const FloatingPointEnvironment environment;
    work(part * size, std::min(count, (part + 1) * size));
  });
}

}  // namespace surehit::detail
