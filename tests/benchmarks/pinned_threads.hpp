#pragma once

#include <atomic>
#include <cstddef>
#include <surehit/executor.hpp>
#include <thread>
#include <vector>

#include "core_pin.hpp"

namespace surehit::benchmark {

/// As many threads for each batch, on cores of their own where there are enough, that take tasks as they come.
class PinnedThreads {
 public:
  explicit PinnedThreads(std::size_t count) : count_(count), cores_(CorePin::allowed_cores()) {}

  void operator()(std::size_t task_count, const Executor::Task& task) const {
    std::atomic<std::size_t> next = 0;
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < count_; ++i) {
      threads.emplace_back([&, i] {
        const CorePin pin(cores_[i % cores_.size()]);
        for (std::size_t index = next++; index < task_count; index = next++) task(index);
      });
    }
    for (std::thread& thread : threads) thread.join();
  }

 private:
  std::size_t count_;
  std::vector<int> cores_;
};

}  // namespace surehit::benchmark
