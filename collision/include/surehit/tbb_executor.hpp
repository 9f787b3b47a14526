#pragma once

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <cstddef>

#include "surehit/executor.hpp"

namespace surehit {

/// Spreads a batch or a build over the threads of oneTBB. `Executor` refers to it, so give it a name.
///
/// A program that includes this header must link to oneTBB. surehit itself does not use oneTBB.
class TbbExecutor {
 public:
  /// Uses at most this number of threads. The default lets oneTBB choose the number.
  explicit TbbExecutor(int threads = tbb::task_arena::automatic) : arena_(threads) {}

  /// Calls `task(i)` once for each i in [0, count), and returns after all calls have returned.
  void operator()(std::size_t count, const Executor::Task& task) {
    arena_.execute([&] { tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) { task(i); }); });
  }

 private:
  tbb::task_arena arena_;  ///< Limits the number of threads.
};

}  // namespace surehit
