#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <memory>
#include <new>
#include <optional>

#include "c/arguments.hpp"
#include "surehit/c/options.h"
#include "surehit/executor.hpp"

namespace surehit::c {

/// The tasks of one call of an executor of C. Each is done exactly once, whatever the executor does.
class TaskRun {
 public:
  TaskRun(std::size_t count, const Executor::Task& task)
      : count_(count), task_(task), is_begun_(new (std::nothrow) std::atomic<bool>[count]()) {}

  /// Does all tasks, by the executor where memory allows it. Throws what a task has thrown.
  void run(const surehit_executor& executor) {
    if (is_begun_ != nullptr) executor.run(executor.user, count_, &TaskRun::call, this);
    for (std::size_t index = 0; index < count_; ++index) begin(index);
    // A task that is still running on a thread of the executor refers to this.
    while (done_.load(std::memory_order_acquire) != count_) {
    }
#if defined(__cpp_exceptions)
    if (error_) std::rethrow_exception(error_);
#endif
  }

 private:
  static void call(void* work, std::size_t index) {
    auto& self = *static_cast<TaskRun*>(work);
    if (index < self.count_) self.begin(index);
  }

  void begin(std::size_t index) noexcept {
    if (is_begun_ != nullptr && is_begun_[index].exchange(true, std::memory_order_relaxed)) return;
#if defined(__cpp_exceptions)
    try {
      task_(index);
    } catch (...) {
      if (!has_error_.exchange(true, std::memory_order_relaxed)) error_ = std::current_exception();
    }
#else
    task_(index);
#endif
    done_.fetch_add(1, std::memory_order_release);
  }

  std::size_t count_;
  const Executor::Task& task_;
  std::unique_ptr<std::atomic<bool>[]> is_begun_;  ///< One for each task, or null if there is no memory for them.
  std::atomic<std::size_t> done_ = 0;
  std::atomic<bool> has_error_ = false;
#if defined(__cpp_exceptions)
  std::exception_ptr error_;  ///< What the first task that threw has thrown.
#endif
};

/// Fails unless the executor can be called. Null is allowed.
inline void check_executor(Arguments& arguments, const surehit_executor* executor) {
  arguments.check_optional(executor, "executor");
  if (executor != nullptr && arguments.are_valid()) {
    arguments.check_pointer(reinterpret_cast<const void*>(executor->run), "executor.run");
  }
}

/// Returns an executor of C that has been checked, or none. It must outlive the result.
[[nodiscard]] inline std::optional<Executor> executor_of(const surehit_executor* executor) {
  if (executor == nullptr) return std::nullopt;
  return Executor([executor](std::size_t count, const Executor::Task& task) { TaskRun(count, task).run(*executor); });
}

}  // namespace surehit::c
