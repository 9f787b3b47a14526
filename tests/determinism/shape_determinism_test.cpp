#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <variant>
#include <vector>

#include "answers.hpp"
#include "hard_shapes.hpp"
#include "support/case_count.hpp"
#include "support/instruction_sets.hpp"
#include "support/scalars.hpp"
#include "support/shape_text.hpp"
#include "support/threads.hpp"

namespace surehit::test {
namespace {

/// Balls, boxes and capsules on a mesh with ties.
template <typename Scalar>
class ShapeDeterminism : public testing::Test {
 protected:
  [[nodiscard]] std::vector<SweptShape<Scalar>> some(std::size_t count) const {
    return {hard.shapes.begin(),
            hard.shapes.begin() + static_cast<std::ptrdiff_t>(std::min(count, hard.shapes.size()))};
  }
  void expect_same(const Collider<Scalar>& collider, const std::vector<SweptShape<Scalar>>& shapes) const {
    const ShapeAnswers<Scalar> expected(hard.hard.collider(), shapes);
    const ShapeAnswers<Scalar> answers(collider, shapes);
    for (std::size_t id = 0; id < shapes.size(); ++id) {
      EXPECT_EQ(answers.all[id], expected.all[id])
          << "shape " << id << ": " << hex_text(answers.all[id].first) << " or " << hex_text(expected.all[id].first);
    }
  }

  HardShapes<Scalar> hard;
};
TYPED_TEST_SUITE(ShapeDeterminism, Scalars, ScalarNames);

TYPED_TEST(ShapeDeterminism, answers_are_the_published_ones) {
  const ShapeAnswers<TypeParam> answers(this->hard.hard.collider(), this->hard.shapes);
  EXPECT_EQ(answers.hash(), published_shape_hash<TypeParam>);
  const auto hits =
      std::count_if(answers.all.begin(), answers.all.end(), [](const auto& answer) { return answer.any; });
  EXPECT_GT(hits, 400);
  EXPECT_LT(hits, 1400);
  keep_few(this->hard.shapes);
  EXPECT_EQ(ShapeAnswers<TypeParam>(this->hard.hard.collider(), this->hard.shapes).hash(),
            published_shape_hash_of_few<TypeParam>);
}

TYPED_TEST(ShapeDeterminism, answers_are_the_same_on_every_instruction_set) {
  const auto shapes = this->some(case_count(sizeof(TypeParam) == 4 ? 600 : 200));
  for (const std::int64_t target : instruction_sets()) {
    SCOPED_TRACE(name_of_instruction_set(target));
    const ShapeAnswers<TypeParam> expected(this->hard.hard.collider(), shapes);
    const ForcedInstructionSet forced(target);
    EXPECT_EQ(ShapeAnswers<TypeParam>(this->hard.hard.collider(), shapes).all, expected.all);
  }
}

TYPED_TEST(ShapeDeterminism, answers_are_the_same_in_every_grid) {
  const auto shapes = this->some(case_count(300));
  this->expect_same(this->hard.hard.collider({.resolution = {1, 1, 1}, .crowded = 0}), shapes);
  this->expect_same(this->hard.hard.collider({.resolution = {1, 7, 200}}), shapes);
  this->expect_same(this->hard.hard.collider({.resolution = {3, 2, 4}, .crowded = 3}), shapes);
}

TYPED_TEST(ShapeDeterminism, answers_are_the_same_in_batches_on_any_number_of_threads) {
  using Scalar = TypeParam;
  const Collider<Scalar> collider = this->hard.hard.collider();
  // A batch has shapes of one kind.
  std::vector<SweptSphere<Scalar>> balls;
  std::vector<ShapeHit<Scalar>> expected;
  for (const SweptShape<Scalar>& shape : this->hard.shapes) {
    const auto* const ball = std::get_if<SweptSphere<Scalar>>(&shape);
    if (ball == nullptr) continue;
    balls.push_back(*ball);
    expected.push_back(collider.first_hit(*ball).value_or(ShapeHit<Scalar>{}));
  }
  ASSERT_GT(balls.size(), 400U);
  for (const std::size_t count : {1U, 2U, 3U, 8U}) {
    const Threads threads(count);
    std::vector<ShapeHit<Scalar>> hits(balls.size());
    collider.first_hits(balls, hits, {.executor = Executor(threads)});
    EXPECT_EQ(hits, expected) << count << " threads";
  }
}

}  // namespace
}  // namespace surehit::test
