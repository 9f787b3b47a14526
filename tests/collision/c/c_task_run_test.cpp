#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "c/task_run.hpp"
#include "surehit/executor.hpp"

namespace surehit::test::c_task_run_test {
namespace {

/// How often each task was done, by an executor of C that does `run`.
class CTaskRun : public testing::Test {
 protected:
  static constexpr std::size_t count = 50;

  void expect_each_task_once(surehit_run_tasks run) {
    const surehit_executor executor = {run, nullptr};
    std::vector<std::atomic<int>> done(count);
    c::executor_of(&executor)->run(count, [&](std::size_t i) { ++done[i]; });
    for (const auto& times : done) EXPECT_EQ(times, 1);
  }
};

TEST_F(CTaskRun, does_each_task_once) {
  expect_each_task_once([](void*, std::size_t tasks, surehit_task task, void* work) {
    for (std::size_t i = tasks; i-- > 0;) task(work, i);
  });
}

TEST_F(CTaskRun, does_what_the_executor_leaves_out) {
  expect_each_task_once([](void*, std::size_t, surehit_task, void*) {});
  expect_each_task_once([](void*, std::size_t tasks, surehit_task task, void* work) {
    for (std::size_t i = 1; i < tasks; i += 2) task(work, i);
  });
}

TEST_F(CTaskRun, does_nothing_twice) {
  expect_each_task_once([](void*, std::size_t tasks, surehit_task task, void* work) {
    for (std::size_t i = 0; i < 2 * tasks; ++i) task(work, i / 2);
  });
}

TEST_F(CTaskRun, does_no_task_that_is_not_there) {
  expect_each_task_once([](void*, std::size_t tasks, surehit_task task, void* work) {
    for (const std::size_t i : {tasks, tasks + 1, SIZE_MAX}) task(work, i);
  });
}

TEST_F(CTaskRun, waits_for_a_task_that_is_still_running) {
  static std::thread thread;
  static std::atomic<bool> has_begun;
  has_begun = false;
  const surehit_executor executor = {[](void*, std::size_t, surehit_task task, void* work) {
                                       thread = std::thread([task, work] { task(work, 0); });
                                       while (!has_begun) {
                                       }
                                     },
                                     nullptr};
  std::atomic<std::size_t> done = 0;
  c::executor_of(&executor)->run(count, [&](std::size_t i) {
    if (i == 0) {
      has_begun = true;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    ++done;
  });
  EXPECT_EQ(done, count);
  thread.join();
}

TEST_F(CTaskRun, brings_exceptions_to_the_caller) {
  static std::size_t returned;
  returned = 0;
  const surehit_executor executor = {[](void*, std::size_t tasks, surehit_task task, void* work) {
                                       for (std::size_t i = 0; i < tasks; ++i, ++returned) task(work, i);
                                     },
                                     nullptr};
  std::size_t done = 0;
  const auto run = [&] {
    c::executor_of(&executor)->run(count, [&](std::size_t i) {
      ++done;
      if (i % 2 == 1) throw std::runtime_error("task " + std::to_string(i));
    });
  };
  EXPECT_THROW(run(), std::runtime_error);
  EXPECT_EQ(done, count);
  EXPECT_EQ(returned, count);
}

TEST_F(CTaskRun, needs_no_executor) { EXPECT_FALSE(c::executor_of(nullptr)); }

}  // namespace
}  // namespace surehit::test::c_task_run_test
