#include <gtest/gtest.h>

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

namespace surehit::test {
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
}  // namespace surehit::test
