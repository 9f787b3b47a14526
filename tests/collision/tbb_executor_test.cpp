#include "surehit/tbb_executor.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cfenv>
#include <cstddef>
#include <thread>
#include <vector>

#include "executor_answers.hpp"
#include "support/floating_point_mode.hpp"
#include "support/scalars.hpp"

namespace surehit::test::tbb_executor_test {
namespace {

/// A temporary lives as long as the call that it is written in.
Executor by(TbbExecutor&& executor) { return Executor(executor); }

TEST(TbbExecutor, runs_each_index_once) {
  for (const int threads : {1, 2, 4}) {
    TbbExecutor executor(threads);
    for (const std::size_t count : {0U, 1U, 2U, 1000U}) {
      std::vector<std::atomic<int>> calls(count + 1);
      Executor(executor).run(count, [&](std::size_t index) { ++calls.at(index); });
      for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(calls[i], 1) << i << " of " << count;
      EXPECT_EQ(calls[count], 0);
    }
  }
}

TEST(TbbExecutor, of_one_thread_is_the_callers) {
  TbbExecutor executor(1);
  std::vector<std::thread::id> ids(100);
  Executor(executor).run(ids.size(), [&](std::size_t index) { ids[index] = std::this_thread::get_id(); });
  for (const std::thread::id id : ids) EXPECT_EQ(id, std::this_thread::get_id());
}

template <typename Scalar>
class BatchOnTbb : public testing::Test {};
TYPED_TEST_SUITE(BatchOnTbb, Scalars, ScalarNames);

TYPED_TEST(BatchOnTbb, answers_as_without) {
  const auto many = ManyPaths<TypeParam>::scattered(9000);
  for (const std::size_t count : {0U, 1U, 4097U, 9000U}) {
    const AnswersWithoutExecutor expected(many, count);
    for (const int threads : {1, 2, 4}) expected.expect_same_with(by(TbbExecutor(threads)));
    expected.expect_same_with(by(TbbExecutor()));
  }
}

TYPED_TEST(BatchOnTbb, answers_the_same_in_any_floating_point_mode_of_the_caller) {
  const auto many = ManyPaths<TypeParam>::scattered(9000);
  const std::span<const Segment<TypeParam>> segments(many.segments);
  const BatchAnswers<TypeParam> expected(many.collider, segments, QueryOptions<TypeParam>{});
  const FloatingPointModeScope scope({"upward_and_flush", FE_UPWARD, true});
  TbbExecutor executor(2);
  BatchAnswers<TypeParam>(many.collider, segments, executor, QueryOptions<TypeParam>{}).expect_same_as(expected);
}

}  // namespace
}  // namespace surehit::test::tbb_executor_test
