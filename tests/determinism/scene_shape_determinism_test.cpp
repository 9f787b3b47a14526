#include <gtest/gtest.h>

#include <algorithm>
#include <cinttypes>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "hard_scene_shapes.hpp"
#include "support/case_count.hpp"
#include "support/instruction_sets.hpp"
#include "support/scalars.hpp"
#include "support/threads.hpp"

namespace surehit::test::scene_shape_determinism_test {
namespace {

/// Balls, boxes and capsules in the hard scene, asked about in many ways.
template <typename Scalar>
class SceneShapeDeterminism : public testing::Test {
 protected:
  [[nodiscard]] std::vector<SweptShape<Scalar>> some_shapes() const {
    const std::size_t count = std::min(case_count(sizeof(Scalar) == 4 ? 160 : 60), hard.shapes.size());
    return {hard.shapes.begin(), hard.shapes.begin() + static_cast<std::ptrdiff_t>(count)};
  }
  [[nodiscard]] std::uint64_t hash_of(const Scene<Scalar>& scene, const std::optional<Executor>& executor = {},
                                      std::size_t batch = std::size_t{1} << 30) const {
    return SceneShapeAnswers<Scalar>(scene, some_shapes(), executor, batch).hash();
  }

  /// Asks for more shapes of one kind than a task has.
  template <typename Shape>
  void expect_same_batches(const Scene<Scalar>& scene) const {
    std::vector<Shape> shapes;
    while (shapes.size() < 300) {
      for (const auto& any : hard.shapes) {
        if (const auto* const shape = std::get_if<Shape>(&any)) shapes.push_back(*shape);
      }
    }
    std::vector<SceneShapeQueryOptions<Scalar>> options(shapes.size());
    for (std::size_t i = 0; i < options.size(); i += 3) options[i] = {.max_t = Scalar{0.5F}, .instance_mask = 1};
    std::vector<SceneShapeHit<Scalar>> expected(shapes.size());
    scene.first_hits(shapes, expected, {.path_options = options});
    for (const std::size_t count : {2U, 8U}) {
      SCOPED_TRACE(std::to_string(count) + " threads");
      const Threads threads(count);
      std::vector<SceneShapeHit<Scalar>> hits(shapes.size());
      std::vector<std::uint8_t> blocked(shapes.size());
      scene.first_hits(shapes, hits, {.path_options = options, .executor = threads});
      scene.any_hits(shapes, blocked, {.path_options = options, .executor = threads});
      EXPECT_TRUE(hits == expected);
      for (std::size_t i = 0; i < hits.size(); ++i) EXPECT_EQ(blocked[i] != 0, expected[i].triangle != no_triangle);
    }
  }

  HardSceneShapes<Scalar> hard;
};
TYPED_TEST_SUITE(SceneShapeDeterminism, Scalars, ScalarNames);

TYPED_TEST(SceneShapeDeterminism, answers_are_the_published_ones) {
  const auto scene = this->hard.hard.scene();
  const SceneShapeAnswers<TypeParam> answers(scene, this->hard.shapes);
  std::printf("%zu answers, %zu of them hits, %zu after the start: %016" PRIx64 "\n", this->hard.shapes.size(),
              answers.hit_count(), answers.later_hit_count(), answers.hash());
  EXPECT_GT(answers.later_hit_count(), this->hard.shapes.size() / 3);
  EXPECT_LT(answers.hit_count(), this->hard.shapes.size());
  EXPECT_EQ(answers.hash(), published_scene_shape_hash<TypeParam>);
  keep_few(this->hard.shapes);
  EXPECT_EQ(SceneShapeAnswers<TypeParam>(scene, this->hard.shapes).hash(),
            published_scene_shape_hash_of_few<TypeParam>);
}

TYPED_TEST(SceneShapeDeterminism, answers_are_the_same_on_every_instruction_set) {
  const std::uint64_t expected = this->hash_of(this->hard.hard.scene());
  for (const std::int64_t target : instruction_sets()) {
    SCOPED_TRACE(name_of_instruction_set(target));
    const ForcedInstructionSet forced(target);
    const HardScene<TypeParam> hard;
    EXPECT_EQ(this->hash_of(hard.scene()), expected);
  }
}

TYPED_TEST(SceneShapeDeterminism, answers_are_the_same_of_any_number_of_threads) {
  auto scene = this->hard.hard.scene();
  const std::uint64_t expected = this->hash_of(scene);
  for (const std::size_t count : {1U, 2U, 8U}) {
    SCOPED_TRACE(std::to_string(count) + " threads");
    const Threads threads(count);
    for (const InstanceId id : scene.instances()) scene.set_pose(id, Pose<TypeParam>(scene.pose(id)));
    scene.commit(Executor(threads));
    EXPECT_EQ(this->hash_of(scene, threads), expected);
  }
}

TYPED_TEST(SceneShapeDeterminism, batches_of_several_tasks_are_the_same_of_any_number_of_threads) {
  const auto scene = this->hard.hard.scene();
  this->template expect_same_batches<SweptSphere<TypeParam>>(scene);
  this->template expect_same_batches<SweptBox<TypeParam>>(scene);
  this->template expect_same_batches<SweptCapsule<TypeParam>>(scene);
}

TYPED_TEST(SceneShapeDeterminism, answers_are_the_same_of_any_batch_size) {
  const auto scene = this->hard.hard.scene();
  const std::uint64_t expected = this->hash_of(scene);
  for (const std::size_t size : {1U, 3U, 17U}) EXPECT_EQ(this->hash_of(scene, {}, size), expected);
}

}  // namespace
}  // namespace surehit::test::scene_shape_determinism_test
