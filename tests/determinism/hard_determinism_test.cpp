#include <gtest/gtest.h>

#include <cstddef>

#include "collider_state.hpp"
#include "determinism.hpp"
#include "hard_prop.hpp"
#include "hard_questions.hpp"
#include "support/case_count.hpp"
#include "support/scalars.hpp"

namespace surehit::test::hard_determinism_test {
namespace {

/// On a mesh with ties: triangles that share edges, that lie in one plane and overlap, that are the same.
template <typename Scalar>
class HardDeterminism : public testing::Test {
 protected:
  [[nodiscard]] Determinism<Scalar> of(std::size_t questions) {
    hard.questions.all.erase(hard.questions.all.begin() + static_cast<std::ptrdiff_t>(questions),
                             hard.questions.all.end());
    return {hard.view(), hard.masks, hard.questions};
  }
  [[nodiscard]] Determinism<Scalar> of_some() { return of(case_count(2000)); }

  HardQuestions<Scalar> hard;
};
TYPED_TEST_SUITE(HardDeterminism, Scalars, ScalarNames);

TYPED_TEST(HardDeterminism, answers_are_the_published_ones) {
  if (!runs_few_cases()) {
    EXPECT_EQ(Answers<TypeParam>(this->hard.collider(), this->hard.questions).hash(), published_hash<TypeParam>);
  }
  keep_few(this->hard.questions.all);
  EXPECT_EQ(Answers<TypeParam>(this->hard.collider(), this->hard.questions).hash(), published_hash_of_few<TypeParam>);
}

TYPED_TEST(HardDeterminism, answers_are_the_same_on_every_instruction_set) {
  this->of(case_count(HardQuestions<TypeParam>::question_count)).expect_same_of_every_instruction_set();
}

TYPED_TEST(HardDeterminism, answers_are_the_same_in_every_grid) {
  const auto determinism = this->of_some();
  EXPECT_EQ(determinism.expect_same_in({.resolution = {1, 1, 1}, .crowded = 0}), 1U);
  determinism.expect_same_in({.resolution = {1, 7, 200}});
  determinism.expect_same_in({.resolution = {3, 2, 4}, .crowded = 3});
  EXPECT_GE(determinism.expect_same_in({.resolution = {2048, 2048, 2048}, .crowded = 1}), 100'000U);
}

TYPED_TEST(HardDeterminism, answers_are_the_same_of_any_number_of_threads) {
  this->of_some().expect_same_of_any_number_of_threads();
}

TYPED_TEST(HardDeterminism, answers_are_the_same_of_any_batch_size) { this->of_some().expect_same_of_any_batch_size(); }

TYPED_TEST(HardDeterminism, answers_are_the_same_in_any_order) { this->of_some().expect_same_in_any_order(); }

/// On a mesh whose grid has an inner grid, which has an inner grid too.
template <typename Scalar>
class PropDeterminism : public testing::Test {};
TYPED_TEST_SUITE(PropDeterminism, Scalars, ScalarNames);

TYPED_TEST(PropDeterminism, answers_are_the_published_ones_on_every_instruction_set_and_in_every_grid) {
  const HardProp<TypeParam> hard;
  const Collider<TypeParam> collider = hard.collider();
  EXPECT_GE(detail::ColliderState<TypeParam>::of(collider).grid.inner_frames().size(), 2U);
  EXPECT_EQ(Answers<TypeParam>(collider, hard.questions).hash(), published_prop_hash<TypeParam>);
  const Determinism<TypeParam> determinism(hard.view(), hard.masks, hard.questions);
  determinism.expect_same_of_every_instruction_set();
  determinism.expect_same_in({.resolution = {1, 1, 1}, .crowded = 0});
  determinism.expect_same_in({.resolution = {3, 2, 4}, .crowded = 3});
}

}  // namespace
}  // namespace surehit::test::hard_determinism_test
