#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <new>
#include <tuple>
#include <utility>
#include <vector>

#include "collision/allocations.hpp"
#include "collision/shape/crowded_ground.hpp"
#include "support/random.hpp"
#include "support/same_bits.hpp"
#include "support/scalars.hpp"
#include "unit_scenes.hpp"

namespace surehit::test::scene_allocation_test {
namespace {

/// Whichever allocation of a change fails, the scene is as before.
template <typename Scalar>
class SceneAllocation : public testing::Test {
 protected:
  using Hits = std::vector<SceneHit<Scalar>>;

  SceneAllocation() {
    for (int i = 0; i < 40; ++i) ids.push_back(scene.add(stack, turned(i)));
    scene.set_motion(ids[3], {0, 0, 1});
    scene.commit();
  }

  /// Turned and moved up, so that no pose is a translation.
  static Pose<Scalar> turned(int i) {
    auto pose = with_rows<Scalar>({1, Scalar{0.125}, 0}, {Scalar{-0.125}, 1, 0}, {0, 0, 1});
    pose.translation = {0, 0, static_cast<Scalar>(i)};
    return pose;
  }

  [[nodiscard]] Hits all() const {
    Hits hits;
    scene.all_hits(through_stack<Scalar>(-1000, 1000), hits);
    return hits;
  }

  static void expect_same(const Hits& left, const Hits& right) {
    ASSERT_EQ(left.size(), right.size());
    for (std::size_t i = 0; i < left.size(); ++i) ASSERT_TRUE(same_bits(left[i], right[i]));
  }

  /// Returns true if the call threw. Its first allocations succeed.
  static bool fails_after(std::size_t successes, const std::function<void()>& call) {
    const ScarceMemory memory(successes);
    try {
      call();
    } catch (const std::bad_alloc&) {
      return true;
    }
    return false;
  }

  std::shared_ptr<Collider<Scalar>> stack = stack_collider<Scalar>(3);
  Scene<Scalar> scene;
  std::vector<InstanceId> ids;
};
TYPED_TEST_SUITE(SceneAllocation, Scalars, ScalarNames);

TYPED_TEST(SceneAllocation, counter_counts) {
  // Called as a function, which a compiler may not leave out as it may a new-expression.
  EXPECT_EQ(allocations_of([] { ::operator delete(::operator new(10)); }), 1U);
}

TYPED_TEST(SceneAllocation, none_in_queries) {
  const auto across = through_stack<TypeParam>(100, -100);
  // In planes of triangles, where all is decided, ordered and rounded exactly.
  const Segment<TypeParam> in_plane{{-1, TypeParam{0.25}, 3}, {2, TypeParam{0.125}, 3}};
  const auto odd = [](const SceneHit<TypeParam>& hit) { return hit.instance.index % 2 == 1; };
  for (const auto& segment : {across, in_plane}) {
    const std::vector<Segment<TypeParam>> segments(64, segment);
    std::vector<SceneHit<TypeParam>> hits(segments.size());
    std::vector<std::uint8_t> blocked(segments.size());
    EXPECT_EQ(allocations_of([&] {
                const auto hit = this->scene.first_hit(segment);
                ASSERT_TRUE(hit);
                static_cast<void>(this->scene.any_hit(segment));
                static_cast<void>(this->scene.first_hit(segment, odd));
                static_cast<void>(this->scene.any_hit(segment, odd));
                static_cast<void>(this->scene.last_free_point(segment, *hit));
                static_cast<void>(this->scene.last_free_point(segment, *hit, odd));
                static_cast<void>(this->scene.triangle(hit->instance, hit->triangle));
                static_cast<void>(this->scene.normal(hit->instance, hit->triangle));
                static_cast<void>(this->scene.box());
                this->scene.first_hits(segments, hits);
                this->scene.any_hits(segments, blocked, {.filter = odd});
              }),
              0U);
  }
}

template <typename Shape, typename Scalar>
void expect_no_allocation(const Scene<Scalar>& scene, const std::vector<Shape>& shapes) {
  std::vector<SceneShapeHit<Scalar>> hits(shapes.size());
  std::vector<std::uint8_t> blocked(shapes.size());
  const auto odd = [](const SceneShapeHit<Scalar>& hit) { return (hit.instance.index + hit.triangle) % 2 == 1; };
  std::size_t hit_count = 0;
  EXPECT_EQ(allocations_of([&] {
              for (const Shape& shape : shapes) {
                const auto hit = scene.first_hit(shape);
                static_cast<void>(scene.any_hit(shape));
                static_cast<void>(scene.first_hit(shape, odd));
                static_cast<void>(scene.any_hit(shape, odd));
                static_cast<void>(scene.overlaps(shape));
                static_cast<void>(scene.overlaps(shape, odd));
                if (!hit) continue;
                ++hit_count;
                static_cast<void>(scene.contact_point(*hit));
                static_cast<void>(scene.contact_normal(shape, *hit));
                static_cast<void>(scene.last_free_t(shape, *hit));
                static_cast<void>(scene.last_free_point(shape, *hit));
                static_cast<void>(scene.last_free_point(shape, *hit, odd));
              }
              scene.first_hits(shapes, hits, {.filter = odd});
              scene.any_hits(shapes, blocked);
            }),
            0U);
  EXPECT_GT(hit_count, shapes.size() / 2);
}

TYPED_TEST(SceneAllocation, none_in_queries_of_moving_shapes) {
  const Vector3<TypeParam> start{0, 0, 100};
  const Vector3<TypeParam> end{TypeParam(0.3), 0, -100};
  const TypeParam size{0.5};
  expect_no_allocation(this->scene, std::vector(3, SweptSphere<TypeParam>{start, end, size}));
  expect_no_allocation(this->scene, std::vector(3, SweptBox<TypeParam>{start, end, {size, size / 2, size}}));
  expect_no_allocation(this->scene, std::vector(3, SweptCapsule<TypeParam>{start, end, {0, size, size / 4}, size}));
}

/// They come to divided cells and to inner grids of instances, one of which moves.
TYPED_TEST(SceneAllocation, none_in_queries_of_moving_shapes_in_crowded_cells) {
  const CrowdedGround<TypeParam> ground;
  const auto collider = std::make_shared<Collider<TypeParam>>(ground.mesh.view(), CrowdedGround<TypeParam>::options());
  ASSERT_TRUE(ground.has_crowded_cells_and_inner_grids(*collider));
  for (const int count : {1, 3}) {
    Scene<TypeParam> crowded;
    for (int i = 0; i < count; ++i) crowded.add(collider, this->turned(i));
    if (count > 1) crowded.set_motion(crowded.instances().back(), {0, 0, -1});
    crowded.commit();
    expect_no_allocation(crowded, ground.template shapes<SweptSphere<TypeParam>>(30));
    expect_no_allocation(crowded, ground.template shapes<SweptBox<TypeParam>>(30));
    expect_no_allocation(crowded, ground.template shapes<SweptCapsule<TypeParam>>(30));
  }
}

TYPED_TEST(SceneAllocation, all_hits_keeps_the_capacity_of_its_vector) {
  std::vector<SceneHit<TypeParam>> hits;
  hits.reserve(1000);
  const auto* const data = hits.data();
  this->scene.all_hits(through_stack<TypeParam>(1000, -1000), hits);
  EXPECT_EQ(hits.size(), 120U);
  EXPECT_EQ(hits.data(), data);
}

TYPED_TEST(SceneAllocation, none_in_setters_and_default_scenes) {
  EXPECT_EQ(allocations_of([] {
              Scene<TypeParam> empty;
              Scene<TypeParam> other = std::move(empty);
              other.commit();
            }),
            0U);
  EXPECT_EQ(allocations_of([&] {
              this->scene.set_mask(this->ids[1], 1);
              this->scene.set_collider(this->ids[1], this->stack);
              this->scene.set_motion(this->ids[1], {0, 0, 1});
              this->scene.set_pose(this->ids[1], this->turned(5));
            }),
            0U);
}

TYPED_TEST(SceneAllocation, failed_add_leaves_the_scene_as_it_was) {
  const auto before = this->all();
  const long uses = this->stack.use_count();
  std::size_t failures = 0;
  // Some adds need no memory, because there is room from before.
  for (int added = 0; added < 100; ++added) {
    const std::size_t count = this->scene.instance_count();
    for (std::size_t successes = 0;
         this->fails_after(successes, [&] { this->scene.add(this->stack, this->turned(added)); }); ++successes) {
      ++failures;
      ASSERT_EQ(this->scene.instance_count(), count);
      ASSERT_EQ(this->stack.use_count(), uses + added);
      this->expect_same(this->all(), before);
    }
    ASSERT_EQ(this->scene.instance_count(), count + 1);
  }
  EXPECT_GT(failures, 0U);
  this->scene.commit();
  EXPECT_EQ(this->all().size(), before.size() + 300);
}

TYPED_TEST(SceneAllocation, failed_first_add_leaves_an_empty_scene) {
  std::size_t successes = 0;
  Scene<TypeParam> empty;
  while (this->fails_after(successes, [&] { empty.add(this->stack); })) {
    ++successes;
    ASSERT_EQ(empty.instance_count(), 0U);
    ASSERT_FALSE(empty.any_hit(through_stack<TypeParam>(1, -1)));
  }
  EXPECT_GT(successes, 0U);
}

TYPED_TEST(SceneAllocation, failed_commit_leaves_the_committed_state_as_it_was) {
  Random random(5);
  std::size_t failures = 0;
  for (int round = 0; round < 8; ++round) {
    for (int i = 0; i < 20; ++i) {
      const std::size_t at = random.below(this->ids.size());
      if (random.one_in(4)) {
        this->scene.remove(this->ids[at]);
        this->ids.erase(this->ids.begin() + static_cast<std::ptrdiff_t>(at));
      } else if (random.one_in(3)) {
        this->ids.push_back(this->scene.add(this->stack, this->turned(i)));
      } else {
        this->scene.set_pose(this->ids[at], this->turned(round * 100 + i));
      }
    }
    const auto before = this->all();
    const auto box = this->scene.box();
    for (std::size_t successes = 0; this->fails_after(successes, [&] { this->scene.commit(); }); ++successes) {
      ++failures;
      this->expect_same(this->all(), before);
      ASSERT_EQ(this->scene.box().high, box.high);
    }
    // What failed before is done now: as in a scene that is made anew.
    Scene<TypeParam> anew;
    std::vector<InstanceId> ids;
    for (const InstanceId id : this->ids) {
      ids.push_back(anew.add(this->stack, this->scene.pose(id)));
      anew.set_motion(ids.back(), this->scene.motion(id));
    }
    anew.commit();
    std::vector<SceneHit<TypeParam>> expected;
    anew.all_hits(through_stack<TypeParam>(-1000, 1000), expected);
    for (auto& hit : expected) {
      const auto at = std::find(ids.begin(), ids.end(), hit.instance) - ids.begin();
      hit.instance = this->ids[static_cast<std::size_t>(at)];
    }
    // Ids are others, and so is the order of ties.
    auto answered = this->all();
    const auto is_before = [](const auto& left, const auto& right) {
      return std::tie(left.t, left.instance, left.triangle) < std::tie(right.t, right.instance, right.triangle);
    };
    std::sort(answered.begin(), answered.end(), is_before);
    std::sort(expected.begin(), expected.end(), is_before);
    this->expect_same(answered, expected);
  }
  EXPECT_GT(failures, 8U);
}

/// The tree made some room for those that did not come. Others that move must not take more than there is.
TYPED_TEST(SceneAllocation, failed_commit_of_new_instances_leaves_the_others_free_to_move) {
  const auto high = [](int i) { return SceneAllocation<TypeParam>::turned(i); };
  Scene<TypeParam> expected;
  for (int i = 0; i < 40; ++i) expected.add(this->stack, high(i < 18 ? 39 - i : i));
  expected.commit();
  std::vector<SceneHit<TypeParam>> expected_hits;
  expected.all_hits(through_stack<TypeParam>(-1000, 1000), expected_hits);
  std::size_t failures = 0;
  for (std::size_t successes = 0;; ++successes) {
    Scene<TypeParam> scene;
    std::vector<InstanceId> ids;
    for (int i = 0; i < 40; ++i) ids.push_back(scene.add(this->stack, high(i)));
    scene.commit();
    std::vector<InstanceId> added;
    for (int i = 0; i < 10; ++i) added.push_back(scene.add(this->stack, high(i)));
    if (!this->fails_after(successes, [&] { scene.commit(); })) break;
    ++failures;
    for (const InstanceId id : added) scene.remove(id);
    for (int i = 0; i < 18; ++i) scene.set_pose(ids[static_cast<std::size_t>(i)], high(39 - i));
    scene.commit();
    std::vector<SceneHit<TypeParam>> hits;
    scene.all_hits(through_stack<TypeParam>(-1000, 1000), hits);
    this->expect_same(hits, expected_hits);
  }
  EXPECT_GT(failures, 3U);
}

TYPED_TEST(SceneAllocation, failed_commit_leaves_snapshots_as_they_were) {
  using Hits = std::vector<SceneHit<TypeParam>>;
  Random random(6);
  std::size_t failures = 0;
  std::vector<SceneSnapshot<TypeParam>> snapshots;
  std::vector<Hits> expected;
  const auto ask = [](const SceneSnapshot<TypeParam>& snapshot) {
    Hits hits;
    snapshot.all_hits(through_stack<TypeParam>(-1000, 1000), hits);
    return hits;
  };
  for (int round = 0; round < 8; ++round) {
    EXPECT_EQ(allocations_of([&] {
                const auto snapshot = this->scene.snapshot();
                auto copy = snapshot;
                copy = snapshot;
                ASSERT_TRUE(copy.any_hit(through_stack<TypeParam>(-1000, 1000)));
              }),
              0U);
    snapshots.push_back(this->scene.snapshot());
    expected.push_back(this->all());
    // At times the last one stays alone, at times the one before it, so that the next commit copies or catches up.
    if (round % 3 == 2) {
      snapshots.erase(snapshots.begin(), snapshots.end() - 1);
      expected.erase(expected.begin(), expected.end() - 1);
    }
    if (round % 2 == 1) this->ids.push_back(this->scene.add(this->stack, this->turned(round)));
    for (int i = 0; i < 10; ++i) {
      this->scene.set_pose(this->ids[random.below(this->ids.size())], this->turned(round * 100 + i));
    }
    for (std::size_t successes = 0; this->fails_after(successes, [&] { this->scene.commit(); }); ++successes) {
      ++failures;
      this->expect_same(this->all(), expected.back());
      for (std::size_t i = 0; i < snapshots.size(); ++i) this->expect_same(ask(snapshots[i]), expected[i]);
    }
    for (std::size_t i = 0; i < snapshots.size(); ++i) this->expect_same(ask(snapshots[i]), expected[i]);
    Scene<TypeParam> anew;
    for (const InstanceId id : this->ids) {
      anew.set_motion(anew.add(this->stack, this->scene.pose(id)), this->scene.motion(id));
    }
    anew.commit();
    Hits hits;
    anew.all_hits(through_stack<TypeParam>(-1000, 1000), hits);
    this->expect_same(this->all(), hits);
  }
  EXPECT_GT(failures, 24U);
}

}  // namespace
}  // namespace surehit::test::scene_allocation_test
