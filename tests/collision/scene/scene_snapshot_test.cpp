#include "surehit/scene_snapshot.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include "support/case_count.hpp"
#include "support/random.hpp"
#include "support/same_bits.hpp"
#include "support/scalars.hpp"
#include "unit_scenes.hpp"

namespace surehit::test::scene_snapshot_test {
namespace {

/// All that a scene or a snapshot answers to the same questions.
template <typename Scalar>
struct Answers {
  std::vector<SceneHit<Scalar>> hits;
  std::vector<SceneHit<Scalar>> first_hits;
  std::vector<SceneShapeHit<Scalar>> touches;
  std::vector<SceneShapeHit<Scalar>> first_touches;
  std::vector<std::uint8_t> blocked;
  std::vector<Vector3<Scalar>> points;  ///< Free points, corners, normals and numbers of poses.
  std::vector<Scalar> free_t;
  std::vector<std::uint64_t> numbers;  ///< Masks, the user's numbers, and counts.
  std::vector<InstanceId> ids;
};

template <typename Scalar>
bool same_points(const std::vector<Vector3<Scalar>>& left, const std::vector<Vector3<Scalar>>& right) {
  bool is_same = left.size() == right.size();
  for (std::size_t i = 0; is_same && i < left.size(); ++i) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) is_same = is_same && same_bits(left[i][axis], right[i][axis]);
  }
  return is_same;
}

template <typename Hit>
bool same_hits(const std::vector<Hit>& left, const std::vector<Hit>& right) {
  bool is_same = left.size() == right.size();
  for (std::size_t i = 0; is_same && i < left.size(); ++i) is_same = same_bits(left[i], right[i]);
  return is_same;
}

template <typename Scalar>
bool is_same(const Answers<Scalar>& left, const Answers<Scalar>& right) {
  return same_hits(left.hits, right.hits) && same_hits(left.first_hits, right.first_hits) &&
         left.touches == right.touches && left.first_touches == right.first_touches && left.blocked == right.blocked &&
         same_points(left.points, right.points) && left.free_t == right.free_t && left.numbers == right.numbers &&
         left.ids == right.ids;
}

/// A scene that changes at random, and questions about it.
template <typename Scalar>
class SceneSnapshots : public testing::Test {
 protected:
  SceneSnapshots() {
    for (int i = 0; i < 30; ++i) add();
    scene.commit();
    for (int i = 0; i < 12; ++i) {
      segments.push_back({point(), point()});
      balls.push_back({point(), point(), random.template unit<Scalar>()});
    }
  }

  Vector3<Scalar> point() {
    return {2 * random.symmetric<Scalar>(), 2 * random.symmetric<Scalar>(), 2 * random.symmetric<Scalar>()};
  }

  Pose<Scalar> pose() {
    auto pose = with_rows<Scalar>({1, random.symmetric<Scalar>(), 0}, {random.symmetric<Scalar>(), 2, 0},
                                  {0, random.symmetric<Scalar>(), 1});
    pose.translation = point();
    return pose;
  }

  void add() {
    ids.push_back(scene.add(random.one_in(9) ? empty : stack, pose(), {.mask = 1, .user_data = random.below(99)}));
  }

  /// Sets poses alone, or also adds and removes instances, which builds the tree anew.
  void change(bool is_pose_alone) {
    for (int i = 0; i < 5; ++i) {
      const std::size_t at = random.below(ids.size());
      switch (is_pose_alone ? 0 : random.below(6)) {
        case 0:
          scene.set_pose(ids[at], pose());
          break;
        case 1:
          scene.set_motion(ids[at], point());
          break;
        case 2:
          scene.set_mask(ids[at], random.one_in(2) ? 1 : 0);
          break;
        case 3:
          add();
          break;
        case 4:
          scene.set_collider(ids[at], random.one_in(3) ? empty : stack);
          break;
        default:
          scene.remove(ids[at]);
          ids.erase(ids.begin() + static_cast<std::ptrdiff_t>(at));
      }
    }
  }

  /// Asks a scene that has no changes, or a snapshot.
  template <typename Subject>
  [[nodiscard]] Answers<Scalar> ask(const Subject& subject) const {
    Answers<Scalar> answers;
    answers.first_hits.resize(segments.size());
    answers.first_touches.resize(balls.size());
    answers.blocked.resize(segments.size() + balls.size());
    const std::span<std::uint8_t> blocked(answers.blocked);
    subject.first_hits(segments, answers.first_hits);
    subject.any_hits(segments, blocked.first(segments.size()));
    subject.first_hits(balls, answers.first_touches);
    subject.any_hits(balls, blocked.last(balls.size()));
    for (const Segment<Scalar>& segment : segments) {
      std::vector<SceneHit<Scalar>> hits;
      subject.all_hits(segment, hits);
      answers.hits.insert(answers.hits.end(), hits.begin(), hits.end());
      const auto first = subject.first_hit(segment);
      answers.numbers.push_back(subject.any_hit(segment) ? 1 : 0);
      if (first) answers.points.push_back(subject.last_free_point(segment, *first));
    }
    for (const SweptShape<Scalar> ball : balls) {
      std::vector<SceneShapeHit<Scalar>> touches;
      subject.all_hits(ball, touches);
      answers.touches.insert(answers.touches.end(), touches.begin(), touches.end());
      const auto first = subject.first_hit(ball);
      answers.numbers.push_back(subject.any_hit(ball) ? 1 : 0);
      answers.numbers.push_back(subject.overlaps(ball) ? 1 : 0);
      if (!first) continue;
      answers.free_t.push_back(subject.last_free_t(ball, *first));
      answers.points.push_back(subject.contact_point(*first));
      answers.points.push_back(subject.contact_normal(ball, *first));
    }
    answers.ids = subject.instances();
    answers.numbers.push_back(subject.instance_count());
    answers.points.push_back(subject.box().low);
    answers.points.push_back(subject.box().high);
    for (const InstanceId id : answers.ids) {
      answers.numbers.push_back(subject.contains(id) ? 1 : 0);
      answers.numbers.push_back(subject.contains({id.index, id.generation + 1}) ? 1 : 0);
      answers.numbers.push_back(subject.mask(id));
      answers.numbers.push_back(subject.user_data(id));
      answers.numbers.push_back(subject.triangle_count(id));
      answers.points.push_back(subject.motion(id));
      answers.points.push_back(subject.pose(id).translation);
      for (Eigen::Index row = 0; row < 3; ++row) answers.points.push_back(subject.pose(id).linear.row(row).transpose());
      if (subject.triangle_count(id) == 0) continue;
      answers.points.push_back(subject.triangle(id, 1).b);
      answers.points.push_back(subject.normal(id, 1));
    }
    return answers;
  }

  std::shared_ptr<Collider<Scalar>> stack = stack_collider<Scalar>(3);
  std::shared_ptr<Collider<Scalar>> empty = std::make_shared<Collider<Scalar>>();
  Random random{91};
  Scene<Scalar> scene;
  std::vector<InstanceId> ids;
  std::vector<Segment<Scalar>> segments;
  std::vector<SweptSphere<Scalar>> balls;
};
TYPED_TEST_SUITE(SceneSnapshots, Scalars, ScalarNames);

TYPED_TEST(SceneSnapshots, stay_as_a_scene_that_was_saved_then) {
  struct Taken {
    SceneSnapshot<TypeParam> snapshot;
    Answers<TypeParam> answers;
  };
  std::vector<Taken> taken;
  std::size_t hits = 0;
  const std::size_t rounds = case_count(120);
  for (std::size_t round = 0; round < rounds; ++round) {
    // The saved scene has the same ids, and was never changed.
    std::vector<std::byte> bytes;
    ASSERT_TRUE(this->scene.save([&](std::span<const std::byte> part) {
      bytes.insert(bytes.end(), part.begin(), part.end());
      return true;
    }));
    const auto frozen = Scene<TypeParam>::load(bytes);
    const auto expected = this->ask(frozen);
    hits += expected.hits.size();
    ASSERT_TRUE(is_same(this->ask(this->scene), expected)) << round;
    // At times there is none, one, or one of each of the last commits.
    if (!this->random.one_in(4)) taken.push_back({this->scene.snapshot(), expected});
    while (!taken.empty() && (taken.size() > 4 || this->random.one_in(3))) {
      taken.erase(taken.begin() + static_cast<std::ptrdiff_t>(this->random.below(taken.size())));
    }
    this->change(round % 3 != 0);
    for (const Taken& one : taken) ASSERT_TRUE(is_same(this->ask(one.snapshot), one.answers)) << round;
    this->scene.commit();
    for (const Taken& one : taken) ASSERT_TRUE(is_same(this->ask(one.snapshot), one.answers)) << round;
  }
  EXPECT_GT(hits, 8 * rounds);
}

TYPED_TEST(SceneSnapshots, are_asked_by_other_threads_while_the_scene_commits) {
  struct Published {
    SceneSnapshot<TypeParam> snapshot;
    std::shared_ptr<const Answers<TypeParam>> answers;
  };
  std::mutex mutex;
  Published last = {this->scene.snapshot(), std::make_shared<Answers<TypeParam>>(this->ask(this->scene))};
  std::atomic<bool> is_done = false;
  std::atomic<int> differences = 0;
  std::atomic<int> asked = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 3; ++i) {
    threads.emplace_back([&] {
      // At least one is asked, even if the commits are done by then.
      do {
        const Published mine = [&] {
          const std::lock_guard lock(mutex);
          return last;
        }();
        if (!is_same(this->ask(mine.snapshot), *mine.answers)) ++differences;
        ++asked;
      } while (!is_done);
    });
  }
  for (std::size_t round = 0; round < case_count(150); ++round) {
    this->change(round % 3 != 0);
    this->scene.commit();
    Published next = {this->scene.snapshot(), std::make_shared<Answers<TypeParam>>(this->ask(this->scene))};
    const std::lock_guard lock(mutex);
    std::swap(last, next);
  }
  is_done = true;
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(differences, 0);
  EXPECT_GE(asked, 3);
}

TYPED_TEST(SceneSnapshots, stay_after_the_end_of_their_scene) {
  const auto expected = this->ask(this->scene);
  std::optional<SceneSnapshot<TypeParam>> snapshot = this->scene.snapshot();
  SceneSnapshot<TypeParam> copy = *snapshot;
  {
    const Scene<TypeParam> moved = std::move(this->scene);
    EXPECT_TRUE(is_same(this->ask(*snapshot), expected));
    this->scene = Scene<TypeParam>();
  }
  const std::weak_ptr<const Collider<TypeParam>> watched = this->stack;
  this->stack.reset();
  this->empty.reset();
  EXPECT_TRUE(is_same(this->ask(*snapshot), expected));
  snapshot.reset();
  EXPECT_TRUE(is_same(this->ask(copy), expected));
  EXPECT_FALSE(watched.expired());
  copy = {};
  EXPECT_TRUE(watched.expired());
}

TYPED_TEST(SceneSnapshots, keep_the_collider_of_a_removed_instance) {
  auto own = stack_collider<TypeParam>(5);
  const std::weak_ptr<const Collider<TypeParam>> watched = own;
  const InstanceId id = this->scene.add(std::move(own));
  this->scene.commit();
  std::optional<SceneSnapshot<TypeParam>> snapshot = this->scene.snapshot();
  this->scene.remove(id);
  this->scene.commit();
  EXPECT_FALSE(this->scene.contains(id));
  EXPECT_TRUE(snapshot->contains(id));
  EXPECT_EQ(snapshot->triangle(id, 4).a.z(), 4);
  // A commit without a change is enough.
  snapshot.reset();
  this->scene.commit();
  EXPECT_TRUE(watched.expired());
}

TYPED_TEST(SceneSnapshots, of_two_commits_keep_one_collider_each) {
  auto own = stack_collider<TypeParam>(5);
  const std::weak_ptr<const Collider<TypeParam>> watched = own;
  const InstanceId id = this->scene.add(std::move(own));
  this->scene.commit();
  const auto first = this->scene.snapshot();
  this->change(true);
  this->scene.commit();
  {
    const auto second = this->scene.snapshot();
    this->scene.remove(id);
    this->scene.commit();
    EXPECT_TRUE(second.contains(id));
  }
  this->change(true);
  this->scene.commit();
  EXPECT_FALSE(watched.expired());
  EXPECT_EQ(first.triangle(id, 4).a.z(), 4);
}

TYPED_TEST(SceneSnapshots, of_an_empty_scene_miss) {
  const SceneSnapshot<TypeParam> none;
  const auto of_empty = Scene<TypeParam>().snapshot();
  Scene<TypeParam> uncommitted;
  const InstanceId id = uncommitted.add(this->stack);
  const auto before = uncommitted.snapshot();
  uncommitted.commit();
  for (const auto* const snapshot : {&none, &of_empty, &before}) {
    EXPECT_EQ(snapshot->instance_count(), 0U);
    EXPECT_TRUE(snapshot->instances().empty());
    EXPECT_FALSE(snapshot->contains(id));
    EXPECT_FALSE(snapshot->any_hit(through_stack<TypeParam>(-1, 5)));
    EXPECT_TRUE(snapshot->box().is_empty());
  }
  EXPECT_TRUE(uncommitted.snapshot().any_hit(through_stack<TypeParam>(-1, 5)));
}

template <typename T>
std::uintptr_t address_of(const T& object) {
  return reinterpret_cast<std::uintptr_t>(&object);
}

TYPED_TEST(SceneSnapshots, of_the_last_commit_cost_the_memory_of_one_more) {
  auto commit = [&, mask = 1U]() mutable {
    this->scene.set_mask(this->ids[3], mask ^= 2U);
    this->scene.commit();
    return this->scene.memory_bytes();
  };
  constexpr std::size_t pointers = 64;  // The scene's list of what may still be asked.
  const std::size_t alone = commit();
  EXPECT_EQ(commit(), alone);
  // Where the committed state lies, which is not asked any more.
  const auto place_of_state = [&] {
    const SceneSnapshot<TypeParam> now = this->scene.snapshot();
    return address_of(now.pose(this->ids[3]));
  };
  const std::uintptr_t place = place_of_state();
  SceneSnapshot<TypeParam> last = this->scene.snapshot();
  const std::size_t beside = commit();
  EXPECT_GT(beside, alone + 10'000);
  EXPECT_LT(beside, 2 * alone);
  // Two states are in use by turns.
  for (int i = 0; i < 6; ++i) {
    last = this->scene.snapshot();
    EXPECT_LE(commit(), beside + pointers);
    EXPECT_EQ(place == place_of_state(), i % 2 == 0);
  }
  const std::uintptr_t there = place_of_state();
  last = {};
  EXPECT_LE(commit(), alone + pointers);
  EXPECT_EQ(there, place_of_state());
}

TYPED_TEST(SceneSnapshots, stay_while_their_scene_is_loaded_anew) {
  const auto expected = this->ask(this->scene);
  const auto snapshot = this->scene.snapshot();
  std::vector<std::byte> bytes;
  ASSERT_TRUE(Scene<TypeParam>().save([&](std::span<const std::byte> part) {
    bytes.insert(bytes.end(), part.begin(), part.end());
    return true;
  }));
  ASSERT_TRUE(this->scene.try_load(bytes));
  EXPECT_EQ(this->scene.snapshot().instance_count(), 0U);
  EXPECT_TRUE(is_same(this->ask(snapshot), expected));
}

}  // namespace
}  // namespace surehit::test::scene_snapshot_test
