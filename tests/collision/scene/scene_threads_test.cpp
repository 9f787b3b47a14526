#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <thread>
#include <type_traits>
#include <vector>

#include "support/case_count.hpp"
#include "support/pair_text.hpp"
#include "support/same_bits.hpp"
#include "support/scalars.hpp"
#include "support/scene_drawer.hpp"
#include "support/scene_path_drawer.hpp"
#include "support/threads.hpp"
#include "surehit/executor.hpp"

namespace surehit::test::scene_threads_test {
namespace {

/// One scene, asked and committed by several threads at once.
template <typename Scalar>
class SceneThreads : public testing::Test {
 protected:
  using Hits = std::vector<SceneHit<Scalar>>;

  /// All that batches answer.
  struct Answers {
    Hits hits;
    std::vector<std::uint8_t> blocked;
    QueryStatistics statistics;
  };

  SceneThreads() : drawn_(many_instances()), judged_(drawn_) {
    ScenePathDrawer<Scalar> drawer(drawn_, judged_.oracle, judged_.ids, random_);
    while (segments_.size() < case_count(2500)) {
      const Path<Scalar> path = drawer.draw();
      segments_.push_back({path.start, path.kind == PathKind::segment ? path.toward : path.start + path.toward});
    }
  }

  /// Some thousands, so that a commit has work for several threads. They are so far apart that paths meet few.
  DrawnScene<Scalar> many_instances() {
    DrawnScene<Scalar> drawn;
    drawn.meshes.push_back(ground_piece(2, std::is_same_v<Scalar, float>, random_));
    while (drawn.instances.size() < 3000) {
      Placement<Scalar> placement{draw_pose<Scalar>(SceneFamily::rotations, random_)};
      for (Scalar& x : placement.pose.translation) x += 20 * random_.symmetric<Scalar>();
      drawn.instances.push_back({0, placement});
    }
    return drawn;
  }

  [[nodiscard]] Answers answers_of(const Scene<Scalar>& scene, const std::optional<Executor>& executor = {}) const {
    Answers answers{Hits(segments_.size()), std::vector<std::uint8_t>(segments_.size()), {}};
    scene.first_hits(segments_, answers.hits, {.executor = executor, .statistics = &answers.statistics});
    scene.any_hits(segments_, answers.blocked, {.executor = executor, .statistics = &answers.statistics});
    return answers;
  }

  void expect_same(const Answers& left, const Answers& right) const {
    EXPECT_EQ(left.blocked, right.blocked);
    EXPECT_EQ(left.statistics.paths, right.statistics.paths);
    EXPECT_EQ(left.statistics.candidates, right.statistics.candidates);
    for (std::size_t i = 0; i < left.hits.size(); ++i) {
      ASSERT_TRUE(same_bits(left.hits[i], right.hits[i])) << hex_text(Path<Scalar>(segments_[i]));
    }
  }

  Random random_{43};
  DrawnScene<Scalar> drawn_;
  JudgedScene<Scalar> judged_;
  std::vector<Segment<Scalar>> segments_;
};
TYPED_TEST_SUITE(SceneThreads, Scalars, ScalarNames);

TYPED_TEST(SceneThreads, batches_are_the_same_on_any_number_of_threads) {
  const auto expected = this->answers_of(this->judged_.scene);
  for (const std::size_t count : {1U, 2U, 8U}) {
    SCOPED_TRACE(std::to_string(count) + " threads");
    const Threads threads(count);
    this->expect_same(this->answers_of(this->judged_.scene, threads), expected);
  }
}

TYPED_TEST(SceneThreads, many_on_one_scene_get_the_same_answers) {
  const auto expected = this->answers_of(this->judged_.scene);
  std::atomic<std::size_t> differences = 0;
  std::vector<std::thread> threads;
  for (std::size_t id = 0; id < 8; ++id) {
    threads.emplace_back([&, id] {
      for (std::size_t i = 0; i < this->segments_.size(); ++i) {
        const std::size_t at = (i + id * this->segments_.size() / 8) % this->segments_.size();
        const auto hit = this->judged_.scene.first_hit(this->segments_[at]);
        if (!same_bits(hit.value_or(SceneHit<TypeParam>{}), expected.hits[at])) ++differences;
        if (this->judged_.scene.any_hit(this->segments_[at]) != (expected.blocked[at] == 1)) ++differences;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(differences, 0U);
}

/// Queries know nothing of changes before the commit. ThreadSanitizer shows that they do not read what changes.
TYPED_TEST(SceneThreads, are_asked_while_one_thread_adds_and_sets_and_removes) {
  Scene<TypeParam> scene;
  const auto collider = collider_of<TypeParam>(this->drawn_.meshes[0]);
  for (const bool is_empty : {true, false}) {
    const auto expected = this->answers_of(scene);
    std::atomic<bool> is_changing = true;
    std::atomic<std::size_t> differences = 0;
    std::vector<std::thread> threads;
    for (std::size_t id = 0; id < 3; ++id) {
      threads.emplace_back([&, id] {
        for (std::size_t i = id; is_changing || i < 100; ++i) {
          const std::size_t at = i % this->segments_.size();
          const auto hit = scene.snapshot().first_hit(this->segments_[at]);
          if (!same_bits(hit.value_or(SceneHit<TypeParam>{}), expected.hits[at])) ++differences;
          if (scene.any_hit(this->segments_[at]) != (expected.blocked[at] == 1)) ++differences;
        }
      });
    }
    std::vector<InstanceId> ids;
    for (const auto& instance : this->drawn_.instances) ids.push_back(scene.add(collider, instance.placement.pose));
    for (const InstanceId id : ids) scene.set_pose(id, {});
    for (std::size_t i = 0; i < ids.size(); i += 2) scene.remove(ids[i]);
    is_changing = false;
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(differences, 0U);
    EXPECT_EQ(std::count(expected.blocked.begin(), expected.blocked.end(), 1) == 0, is_empty);
    for (std::size_t i = 1; i < ids.size(); i += 2) scene.set_pose(ids[i], this->drawn_.instances[i].placement.pose);
    scene.commit();
  }
}

/// Each task of a batch gives its paths their own options, and their own numbers to the filter.
TYPED_TEST(SceneThreads, options_and_filters_are_those_of_each_path) {
  std::vector<Segment<TypeParam>> segments;
  while (segments.size() < 5000) segments.push_back(this->segments_[segments.size() % this->segments_.size()]);
  std::vector<SceneQueryOptions<TypeParam>> options(segments.size());
  for (std::size_t i = 0; i < options.size(); ++i) {
    options[i].max_t = i % 7 == 0 ? TypeParam(0.25) : TypeParam{1};
    if (i % 11 == 0) options[i].culling = Culling::back;
  }
  const auto accepts = [](std::size_t path, const SceneHit<TypeParam>& hit) {
    return (path + hit.triangle + hit.instance.index) % 5 != 0;
  };
  std::size_t hits_there = 0;
  std::vector<SceneHit<TypeParam>> expected(segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const auto of_path = [&](const SceneHit<TypeParam>& hit) { return accepts(i, hit); };
    expected[i] = this->judged_.scene.first_hit(segments[i], of_path, options[i]).value_or(SceneHit<TypeParam>{});
    hits_there += expected[i].triangle != no_triangle ? 1 : 0;
  }
  EXPECT_GT(hits_there, 500U);
  for (const std::size_t count : {1U, 8U}) {
    SCOPED_TRACE(std::to_string(count) + " threads");
    const Threads threads(count);
    std::vector<SceneHit<TypeParam>> hits(segments.size());
    std::vector<std::uint8_t> blocked(segments.size());
    const SceneBatchOptions<TypeParam> batch = {
        .path_options = options, .filter = accepts, .executor = Executor(threads)};
    this->judged_.scene.first_hits(segments, hits, batch);
    this->judged_.scene.any_hits(segments, blocked, batch);
    for (std::size_t i = 0; i < segments.size(); ++i) {
      ASSERT_TRUE(same_bits(hits[i], expected[i])) << i;
      ASSERT_EQ(blocked[i] != 0, expected[i].triangle != no_triangle) << i;
    }
  }
}

TYPED_TEST(SceneThreads, commits_are_the_same_on_any_number_of_threads) {
  const auto expected = this->answers_of(this->judged_.scene);
  for (const std::size_t count : {1U, 2U, 8U}) {
    SCOPED_TRACE(std::to_string(count) + " threads");
    const Threads threads(count);
    JudgedScene<TypeParam> other(this->drawn_);
    // Away and back again, with a commit after each.
    for (const bool is_back : {false, true}) {
      for (std::size_t i = 0; i < other.ids.size(); ++i) {
        auto pose = this->drawn_.instances[i].placement.pose;
        if (!is_back) pose.translation *= 1 + static_cast<TypeParam>(i % 3);
        other.scene.set_pose(other.ids[i], pose);
      }
      other.scene.commit(Executor(threads));
    }
    this->expect_same(this->answers_of(other.scene, threads), expected);
  }
}

}  // namespace
}  // namespace surehit::test::scene_threads_test
