#pragma once

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <cstddef>

#include "surehit/executor.hpp"

namespace surehit {

/// Spreads a batch over oneTBB's threads. Include this where oneTBB is at hand, and link to it; surehit itself does
/// neither.
class TbbExecutor {
 public:
  /// As many threads as oneTBB finds good, or as given.
  explicit TbbExecutor(int threads = tbb::task_arena::automatic) : arena_(threads) {}

  void operator()(std::size_t count, const Executor::Task& task) {
    arena_.execute([&] { tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) { task(i); }); });
  }

 private:
  tbb::task_arena arena_;
};

}  // namespace surehit
