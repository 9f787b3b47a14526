#pragma once

#include <algorithm>
#include <cstddef>

#include "support/floating_point_environment.hpp"
#include "surehit/executor.hpp"

namespace surehit::detail {

/// Calls `work(first, last)` for parts of [0, count), each of this `size`, in tasks of the executor. Each task sets its
/// own FloatingPointEnvironment, because it may run on another thread. Without an executor it calls `work` once, for
/// all.
template <typename Work>
void in_parts(const Executor* executor, std::size_t count, std::size_t size, const Work& work) {
  if (executor == nullptr || count <= size) {
    work(std::size_t{0}, count);
    return;
  }
  executor->run((count + size - 1) / size, [&](std::size_t part) {
    const FloatingPointEnvironment environment;
    work(part * size, std::min(count, (part + 1) * size));
  });
}

}  // namespace surehit::detail
