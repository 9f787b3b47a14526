#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "answers.hpp"
#include "hard_shapes.hpp"
#include "support/case_count.hpp"
#include "support/instruction_sets.hpp"
#include "support/scalars.hpp"
#include "support/shape_text.hpp"
#include "support/threads.hpp"

namespace surehit::test::shape_determinism_test {
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

/// The hard shapes of one kind, with their options, and what single queries answer. A batch has shapes of one kind.
template <typename Shape, typename Scalar>
class ShapesOfOneKind {
 public:
  explicit ShapesOfOneKind(const HardShapes<Scalar>& hard) {
    const Collider<Scalar> collider = hard.hard.collider();
    for (std::size_t id = 0; id < hard.shapes.size(); ++id) {
      const auto* const shape = std::get_if<Shape>(&hard.shapes[id]);
      if (shape == nullptr) continue;
      shapes_.push_back(*shape);
      options_.push_back(ShapeAnswers<Scalar>::options_of(id));
      firsts_.push_back(collider.first_hit(*shape, options_.back()).value_or(ShapeHit<Scalar>{}));
    }
  }

  /// Has everything twice, so that a batch has several tasks.
  void repeat() {
    const std::size_t count = shapes_.size();
    for (std::size_t i = 0; i < count; ++i) {
      shapes_.push_back(Shape(shapes_[i]));
      options_.push_back(ShapeQueryOptions<Scalar>(options_[i]));
      firsts_.push_back(ShapeHit<Scalar>(firsts_[i]));
    }
  }

  void expect_same_of_batches(const Collider<Scalar>& collider, const std::optional<Executor>& executor = {}) const {
    std::vector<ShapeHit<Scalar>> hits(shapes_.size());
    std::vector<std::uint8_t> blocked(shapes_.size());
    const ShapeBatchOptions<Scalar> batch = {.path_options = options_, .executor = executor};
    collider.first_hits(shapes_, hits, batch);
    collider.any_hits(shapes_, blocked, batch);
    for (std::size_t i = 0; i < shapes_.size(); ++i) {
      EXPECT_EQ(hits[i], firsts_[i]) << hex_text(shapes_[i]) << ": " << hex_text(hits[i]) << " or "
                                     << hex_text(firsts_[i]);
      EXPECT_EQ(blocked[i] != 0, firsts_[i].triangle != no_triangle) << hex_text(shapes_[i]);
    }
  }

 private:
  std::vector<Shape> shapes_;
  std::vector<ShapeQueryOptions<Scalar>> options_;
  std::vector<ShapeHit<Scalar>> firsts_;
};

/// The hard shapes, kind by kind.
template <typename Scalar>
struct ShapesByKind {
  explicit ShapesByKind(const HardShapes<Scalar>& hard) : balls(hard), boxes(hard), capsules(hard) {}

  void repeat() {
    balls.repeat();
    boxes.repeat();
    capsules.repeat();
  }
  void expect_same_of_batches(const Collider<Scalar>& collider, const std::optional<Executor>& executor = {}) const {
    balls.expect_same_of_batches(collider, executor);
    boxes.expect_same_of_batches(collider, executor);
    capsules.expect_same_of_batches(collider, executor);
  }

  ShapesOfOneKind<SweptSphere<Scalar>, Scalar> balls;
  ShapesOfOneKind<SweptBox<Scalar>, Scalar> boxes;
  ShapesOfOneKind<SweptCapsule<Scalar>, Scalar> capsules;
};

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

TYPED_TEST(ShapeDeterminism, contacts_are_the_published_ones) {
  const Collider<TypeParam> collider = this->hard.hard.collider();
  const ShapeContacts<TypeParam> contacts(collider, this->hard.shapes);
  EXPECT_GT(contacts.normals.size(), 400U);
  EXPECT_EQ(contacts.hash(), published_shape_contact_hash<TypeParam>);
  keep_few(this->hard.shapes);
  EXPECT_EQ(ShapeContacts<TypeParam>(collider, this->hard.shapes).hash(),
            published_shape_contact_hash_of_few<TypeParam>);
}

TYPED_TEST(ShapeDeterminism, contacts_are_the_same_on_every_instruction_set) {
  const auto shapes = this->some(case_count(sizeof(TypeParam) == 4 ? 600 : 200));
  const std::uint64_t expected = ShapeContacts<TypeParam>(this->hard.hard.collider(), shapes).hash();
  for (const std::int64_t target : instruction_sets()) {
    SCOPED_TRACE(name_of_instruction_set(target));
    const ForcedInstructionSet forced(target);
    EXPECT_EQ(ShapeContacts<TypeParam>(this->hard.hard.collider(), shapes).hash(), expected);
  }
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

TYPED_TEST(ShapeDeterminism, batches_are_the_same_as_single_queries_on_every_instruction_set) {
  const ShapesByKind<TypeParam> shapes(this->hard);
  for (const std::int64_t target : instruction_sets()) {
    SCOPED_TRACE(name_of_instruction_set(target));
    const ForcedInstructionSet forced(target);
    shapes.expect_same_of_batches(this->hard.hard.collider());
    // In large cells, more shapes are small enough to walk in lanes.
    shapes.expect_same_of_batches(this->hard.hard.collider({.resolution = {3, 2, 4}}));
  }
}

TYPED_TEST(ShapeDeterminism, batches_are_the_same_on_any_number_of_threads) {
  ShapesByKind<TypeParam> shapes(this->hard);
  shapes.repeat();
  for (const std::size_t count : {1U, 2U, 3U, 8U}) {
    SCOPED_TRACE(std::to_string(count) + " threads");
    const Threads threads(count);
    shapes.expect_same_of_batches(this->hard.hard.collider(), Executor(threads));
  }
}

}  // namespace
}  // namespace surehit::test::shape_determinism_test
