#include <gtest/gtest.h>

#include <algorithm>
#include <cinttypes>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "hard_scene.hpp"
#include "support/case_count.hpp"
#include "support/instruction_sets.hpp"
#include "support/scalars.hpp"
#include "support/threads.hpp"

namespace surehit::test::scene_determinism_test {
namespace {

/// The hard scene, asked and made in many ways.
template <typename Scalar>
class SceneDeterminism : public testing::Test {
 protected:
  [[nodiscard]] std::span<const Path<Scalar>> some_paths() const {
    return std::span(hard.paths).first(case_count(1000));
  }
  [[nodiscard]] std::uint64_t hash_of(const Scene<Scalar>& scene, const std::optional<Executor>& executor = {},
                                      std::size_t batch = std::size_t{1} << 30) const {
    return SceneAnswers<Scalar>(scene, some_paths(), executor, batch).hash();
  }

  HardScene<Scalar> hard;
};
TYPED_TEST_SUITE(SceneDeterminism, Scalars, ScalarNames);

TYPED_TEST(SceneDeterminism, answers_are_the_published_ones) {
  if (!runs_few_cases()) {
    const SceneAnswers<TypeParam> answers(this->hard.scene(), this->hard.paths);
    std::printf("%zu answers, %zu of them hits: %016" PRIx64 "\n", this->hard.paths.size(), answers.hit_count(),
                answers.hash());
    EXPECT_GT(answers.hit_count(), this->hard.paths.size() / 3);
    EXPECT_EQ(answers.hash(), published_scene_hash<TypeParam>);
  }
  keep_few(this->hard.paths);
  EXPECT_EQ(SceneAnswers<TypeParam>(this->hard.scene(), this->hard.paths).hash(),
            published_scene_hash_of_few<TypeParam>);
}

TYPED_TEST(SceneDeterminism, answers_are_the_same_on_every_instruction_set) {
  const std::uint64_t expected = this->hash_of(this->hard.scene());
  for (const std::int64_t target : instruction_sets()) {
    SCOPED_TRACE(name_of_instruction_set(target));
    const ForcedInstructionSet forced(target);
    const HardScene<TypeParam> hard;
    EXPECT_EQ(this->hash_of(hard.scene()), expected);
  }
}

TYPED_TEST(SceneDeterminism, answers_are_the_same_of_any_number_of_threads) {
  const std::uint64_t expected = this->hash_of(this->hard.scene());
  for (const std::size_t count : {1U, 2U, 8U}) {
    SCOPED_TRACE(std::to_string(count) + " threads");
    const Threads threads(count);
    auto scene = this->hard.scene();
    for (const InstanceId id : scene.instances()) scene.set_pose(id, Pose<TypeParam>(scene.pose(id)));
    scene.commit(Executor(threads));
    EXPECT_EQ(this->hash_of(scene, threads), expected);
  }
}

TYPED_TEST(SceneDeterminism, answers_are_the_same_of_any_batch_size) {
  const auto scene = this->hard.scene();
  const std::uint64_t expected = this->hash_of(scene);
  for (const std::size_t size : {1U, 3U, 16U, 17U, 100U}) EXPECT_EQ(this->hash_of(scene, {}, size), expected);
}

/// Adds and removes until each instance has the index that it has in the plain scene.
TYPED_TEST(SceneDeterminism, answers_are_the_same_after_any_order_of_changes) {
  const std::uint64_t expected = this->hash_of(this->hard.scene());
  const auto& instances = this->hard.instances;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    Random random(seed);
    Scene<TypeParam> scene;
    std::vector<InstanceId> ids;
    for (const auto& instance : instances) ids.push_back(scene.add(this->hard.collider(instance)));
    for (std::size_t i = 0; i < ids.size(); ++i) ASSERT_EQ(ids[i].index, i);
    // Away from where they belong, in any order, and with commits between.
    for (int changes = 0; changes < 100; ++changes) {
      const std::size_t at = random.below(ids.size());
      scene.set_pose(ids[at], instances[random.below(ids.size())].pose);
      scene.set_motion(ids[at], {1, 2, 3});
      scene.set_mask(ids[at], 0);
      if (random.one_in(10)) scene.commit();
      if (random.one_in(10)) {
        scene.remove(ids[at]);
        scene.commit();
        ids[at] = scene.add(this->hard.collider(instances[at]));
        ASSERT_EQ(ids[at].index, at);
      }
    }
    for (std::size_t i = ids.size(); i-- > 0;) {
      scene.set_mask(ids[i], instances[i].mask);
      scene.set_pose(ids[i], instances[i].pose);
      scene.set_motion(ids[i], instances[i].motion);
    }
    scene.commit();
    EXPECT_EQ(this->hash_of(scene), expected);
  }
}

/// Hits at equal t are in the order of their instances' ids, so they are sorted by the instances of the hard scene
/// here.
TYPED_TEST(SceneDeterminism, contacts_are_the_same_of_any_order_of_adding) {
  const auto& instances = this->hard.instances;
  std::vector<std::size_t> order(instances.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto hash_of_contacts = [&] {
    Scene<TypeParam> scene;
    for (const std::size_t at : order) {
      const InstanceId id =
          scene.add(this->hard.collider(instances[at]), instances[at].pose, {.mask = instances[at].mask});
      scene.set_motion(id, instances[at].motion);
    }
    scene.commit();
    AnswerHash hash;
    std::vector<SceneHit<TypeParam>> contacts;
    for (const Path<TypeParam>& path : this->some_paths()) {
      scene.all_hits(path, contacts);
      const auto first = scene.first_hit(path);
      EXPECT_EQ(first, contacts.empty() ? std::nullopt : std::optional(contacts.front()));
      for (auto& contact : contacts) contact.instance.index = static_cast<std::uint32_t>(order[contact.instance.index]);
      std::sort(contacts.begin(), contacts.end(), [](const auto& a, const auto& b) {
        return std::tie(a.t, a.instance.index, a.triangle) < std::tie(b.t, b.instance.index, b.triangle);
      });
      for (const auto& contact : contacts) {
        hash.take(static_cast<const Hit<TypeParam>&>(contact));
        hash.take(contact.instance.index);
      }
    }
    return hash.value();
  };
  const std::uint64_t expected = hash_of_contacts();
  std::reverse(order.begin(), order.end());
  EXPECT_EQ(hash_of_contacts(), expected);
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    Random random(seed);
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    EXPECT_EQ(hash_of_contacts(), expected);
  }
}

}  // namespace
}  // namespace surehit::test::scene_determinism_test
