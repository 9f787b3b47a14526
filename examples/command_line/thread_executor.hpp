#pragma once

#include <cstddef>
#include <surehit/executor.hpp>

namespace surehit::example {

/// Spreads batches and commits over threads. `Executor` refers to it, so give it a name.
class ThreadExecutor {
 public:
  explicit ThreadExecutor(unsigned threads) : threads_(threads) {}

  /// Calls `task(i)` once for each i in [0, count), and returns after all calls have returned.
  void operator()(std::size_t count, const Executor::Task& task) const;

 private:
  unsigned threads_;
};

}  // namespace surehit::example
