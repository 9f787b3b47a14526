#pragma once

#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

#include "surehit/executor.hpp"

namespace surehit::test {

/// An executor of as many new threads for each batch, which take tasks as they come.
class Threads {
 public:
  explicit Threads(std::size_t count) : count_(count) {}

  void operator()(std::size_t task_count, const Executor::Task& task) const {
    std::atomic<std::size_t> next = 0;
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < count_; ++i) {
      threads.emplace_back([&] {
        for (std::size_t index = next++; index < task_count; index = next++) task(index);
      });
    }
    for (std::thread& thread : threads) thread.join();
  }

 private:
  std::size_t count_;
};

}  // namespace surehit::test
