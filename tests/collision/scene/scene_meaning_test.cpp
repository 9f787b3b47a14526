#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "support/neighbour.hpp"
#include "support/pair_text.hpp"
#include "support/same_bits.hpp"
#include "support/scalars.hpp"
#include "surehit/scene.hpp"
#include "unit_scenes.hpp"

namespace surehit::test {
namespace {

/// One test for each sentence about what a hit in a scene means.
template <typename Scalar>
class SceneMeaning : public testing::Test {
 protected:
  using Answer = std::optional<SceneHit<Scalar>>;
  static constexpr Scalar quarter{0.25};

  InstanceId add(const Pose<Scalar>& pose = {}, const InstanceOptions& options = {}) {
    return scene.add(floor, pose, options);
  }

  /// Above (1/4, 1/4), from one height to another.
  static Segment<Scalar> across(Scalar from, Scalar to) { return through_stack<Scalar>(from, to); }

  static void expect_hit(const Answer& answer, Scalar t, Side side, InstanceId instance, std::uint32_t triangle = 0) {
    ASSERT_TRUE(answer);
    const SceneHit<Scalar> expected{{t, quarter, quarter, triangle, side}, instance};
    EXPECT_TRUE(same_bits(*answer, expected)) << hex_text(*answer);
  }

  std::vector<SceneHit<Scalar>> all(const Path<Scalar>& path, const SceneQueryOptions<Scalar>& options = {}) const {
    std::vector<SceneHit<Scalar>> hits;
    scene.all_hits(path, hits, options);
    return hits;
  }

  std::shared_ptr<Collider<Scalar>> floor = stack_collider<Scalar>(1);
  Scene<Scalar> scene;
};
TYPED_TEST_SUITE(SceneMeaning, Scalars, ScalarNames);

// "Makes a scene without instances. Every query misses."

TYPED_TEST(SceneMeaning, empty_scene_is_never_hit) {
  for (int commits = 0; commits < 2; ++commits) {
    const auto path = this->across(1, -1);
    EXPECT_FALSE(this->scene.first_hit(path));
    EXPECT_FALSE(this->scene.any_hit(path));
    EXPECT_TRUE(this->all(path).empty());
    EXPECT_EQ(this->scene.instance_count(), 0U);
    EXPECT_TRUE(this->scene.instances().empty());
    EXPECT_TRUE(this->scene.box().is_empty());
    std::vector<SceneHit<TypeParam>> hits(1, {{.t = 3, .triangle = 5}, {1, 2}});
    std::vector<std::uint8_t> blocked(1, 7);
    const std::vector<Segment<TypeParam>> paths = {path};
    this->scene.first_hits(paths, hits);
    this->scene.any_hits(paths, blocked);
    EXPECT_TRUE(same_bits(hits[0], SceneHit<TypeParam>{}));
    EXPECT_EQ(blocked[0], 0);
    EXPECT_EQ(this->scene.last_free_point(path, SceneHit<TypeParam>{{.t = TypeParam{0.5}}, {}})[2],
              std::numeric_limits<TypeParam>::epsilon());
    this->scene.commit();
  }
}

TYPED_TEST(SceneMeaning, empty_collider_is_never_hit) {
  const auto id = this->scene.add(std::make_shared<Collider<TypeParam>>());
  this->scene.commit();
  EXPECT_EQ(this->scene.triangle_count(id), 0U);
  EXPECT_FALSE(this->scene.any_hit(this->across(1, -1)));
  EXPECT_TRUE(this->scene.box().is_empty());
  const auto solid = this->add();
  this->scene.commit();
  this->expect_hit(this->scene.first_hit(this->across(1, -1)), TypeParam{0.5}, Side::front, solid);
}

// "a corner v of its mesh is at linear v + translation, in exact arithmetic. No corner is rounded."

TYPED_TEST(SceneMeaning, instance_is_where_its_pose_places_it) {
  // The mesh's x is the world's y, its y is -2 times the world's x, and its z is 3 times the world's.
  auto pose = with_rows<TypeParam>({0, -2, 0}, {1, 0, 0}, {0, 0, 3});
  pose.translation = {10, 20, 30};
  const auto id = this->add(pose);
  this->scene.commit();
  const Segment<TypeParam> down{{TypeParam{9.5}, TypeParam{20.25}, 31}, {TypeParam{9.5}, TypeParam{20.25}, 29}};
  this->expect_hit(this->scene.first_hit(down), TypeParam{0.5}, Side::front, id);
  EXPECT_FALSE(this->scene.any_hit(this->across(31, 29)));
}

TYPED_TEST(SceneMeaning, corners_are_not_rounded) {
  // At 2^digits, no number lies between those of even ulps, but the floor does.
  const TypeParam far = std::ldexp(TypeParam{1}, std::numeric_limits<TypeParam>::digits);
  this->scene.add(stack_collider<TypeParam>(2), at_height(far));
  this->scene.commit();
  const auto hits = this->all(this->across(far - 2, far + 2));
  ASSERT_EQ(hits.size(), 2U);
  EXPECT_EQ(hits[0].t, TypeParam{0.5});
  EXPECT_EQ(hits[1].t, TypeParam{0.75});
}

TYPED_TEST(SceneMeaning, long_path_meets_an_instance_that_is_nearly_flat) {
  GeneratedMesh<TypeParam> mesh;
  mesh.add({{-4, 1, -2}, {4, 2, 4}, {-4, 3, -3}});
  const auto collider = std::make_shared<Collider<TypeParam>>(mesh.view());
  const Vector3<TypeParam> way{1, 2, 3};
  for (const TypeParam height : {TypeParam{0x1p-20F}, TypeParam{0x1p-32F}, TypeParam{0x1p-44F}, TypeParam{0x1p-60F}}) {
    Scene<TypeParam> scene;
    scene.add(collider, with_rows<TypeParam>({1, 0, 0}, {0, 1, 0}, {0, 0, height}));
    scene.commit();
    for (const TypeParam length : {TypeParam{1}, TypeParam{0x1p16F}, TypeParam{0x1p20F}}) {
      // The middle of the triangle is nearly at this point, and an end is twice as far as the other.
      const Vector3<TypeParam> middle{TypeParam{-1.25}, 2, 0};
      EXPECT_TRUE(scene.any_hit(Segment<TypeParam>{middle - length * way, middle + 2 * length * way})) << height;
    }
  }
}

// "t, u and v are rounded once."

TYPED_TEST(SceneMeaning, t_is_rounded_once) {
  // The image is 7 units high, on a way of 10.
  auto pose = with_rows<TypeParam>({7, 0, 0}, {0, 7, 0}, {0, 0, 7});
  const auto id = this->scene.add(stack_collider<TypeParam>(2), pose);
  this->scene.commit();
  const TypeParam x{1.75};
  const auto hit = this->scene.first_hit(Segment<TypeParam>{{x, x, 10}, {x, x, 0}});
  this->expect_hit(hit, TypeParam{3} / 10, Side::front, id, 1);
}

// "Among hits with equal exact t, the lowest instance id comes first, and then the lowest triangle id."

TYPED_TEST(SceneMeaning, ties_go_by_instance_and_then_by_triangle) {
  GeneratedMesh<TypeParam> twice;
  for (int i = 0; i < 2; ++i) twice.add(unit_triangle<TypeParam>());
  const auto collider = std::make_shared<Collider<TypeParam>>(twice.view());
  std::vector<InstanceId> ids;
  for (int i = 0; i < 5; ++i) ids.push_back(this->scene.add(collider));
  this->scene.commit();
  std::sort(ids.begin(), ids.end());
  const auto hits = this->all(this->across(1, -1));
  ASSERT_EQ(hits.size(), 10U);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    this->expect_hit(hits[i], TypeParam{0.5}, Side::front, ids[i / 2], i % 2);
  }
  this->expect_hit(this->scene.first_hit(this->across(1, -1)), TypeParam{0.5}, Side::front, ids[0]);
}

TYPED_TEST(SceneMeaning, order_is_that_of_exact_t_where_rounded_ones_are_equal) {
  // Two floors that are less than an ulp of t apart.
  const TypeParam tiny = std::numeric_limits<TypeParam>::denorm_min();
  const auto lower = this->add(at_height<TypeParam>(0));
  const auto upper = this->add(at_height<TypeParam>(tiny));
  this->scene.commit();
  const auto hits = this->all(this->across(1, -1));
  ASSERT_EQ(hits.size(), 2U);
  EXPECT_EQ(hits[0].t, hits[1].t);
  EXPECT_EQ(hits[0].instance, upper);
  EXPECT_EQ(hits[1].instance, lower);
}

// "the side is that of the placed triangle, also where the pose mirrors it."

TYPED_TEST(SceneMeaning, mirrored_instance_shows_its_other_side) {
  const auto id = this->add(with_rows<TypeParam>({0, 1, 0}, {1, 0, 0}, {0, 0, 1}));
  this->scene.commit();
  this->expect_hit(this->scene.first_hit(this->across(1, -1)), TypeParam{0.5}, Side::back, id);
  EXPECT_FALSE(this->scene.any_hit(this->across(1, -1), {.culling = Culling::back}));
  EXPECT_TRUE(this->scene.any_hit(this->across(1, -1), {.culling = Culling::front}));
}

TYPED_TEST(SceneMeaning, mirror_in_its_own_plane_leaves_a_triangle_its_side) {
  // The side is that of the placed corners, and not that of the placed normal.
  const auto id = this->add(with_rows<TypeParam>({1, 0, 0}, {0, 1, 0}, {0, 0, -1}));
  this->scene.commit();
  this->expect_hit(this->scene.first_hit(this->across(1, -1)), TypeParam{0.5}, Side::front, id);
}

// "Until then, queries answer as before."

TYPED_TEST(SceneMeaning, changes_wait_for_the_commit) {
  const auto old = this->add();
  this->scene.commit();
  const auto path = this->across(4, -4);
  const auto expect_old = [&] {
    const auto hits = this->all(path);
    ASSERT_EQ(hits.size(), 1U);
    this->expect_hit(hits[0], TypeParam{0.5}, Side::front, old);
  };
  this->scene.set_pose(old, at_height<TypeParam>(2));
  expect_old();
  this->scene.set_motion(old, {0, 0, 1});
  expect_old();
  this->scene.set_mask(old, 0);
  expect_old();
  this->add(at_height<TypeParam>(1));
  expect_old();
  this->scene.remove(old);
  expect_old();
  const auto later = this->add(at_height<TypeParam>(2));
  expect_old();
  this->scene.commit();
  const auto hits = this->all(path);
  ASSERT_EQ(hits.size(), 2U);
  this->expect_hit(hits[0], TypeParam{0.25}, Side::front, later);
}

TYPED_TEST(SceneMeaning, commit_without_changes_changes_nothing) {
  const auto id = this->add();
  for (int i = 0; i < 3; ++i) {
    this->scene.commit();
    this->expect_hit(this->scene.first_hit(this->across(1, -1)), TypeParam{0.5}, Side::front, id);
  }
}

TYPED_TEST(SceneMeaning, instance_removed_before_its_commit_never_was) {
  this->scene.remove(this->add());
  this->scene.commit();
  EXPECT_FALSE(this->scene.any_hit(this->across(1, -1)));
}

TYPED_TEST(SceneMeaning, last_change_counts) {
  const auto id = this->add();
  this->scene.commit();
  this->scene.set_pose(id, at_height<TypeParam>(8));
  this->scene.set_pose(id, at_height<TypeParam>(-2));
  this->scene.set_mask(id, 0);
  this->scene.set_mask(id, 1);
  this->scene.commit();
  this->expect_hit(this->scene.first_hit(this->across(4, -4)), TypeParam{0.75}, Side::front, id);
}

// "It may be rebuilt. Then no query may run until the next commit, which sees the new mesh."

TYPED_TEST(SceneMeaning, rebuilt_collider_is_seen_after_the_commit) {
  const auto id = this->add(at_height<TypeParam>(1));
  this->scene.commit();
  this->floor->rebuild(stack_of_triangles<TypeParam>(2).view());
  this->scene.commit();
  EXPECT_EQ(this->scene.triangle_count(id), 2U);
  this->expect_hit(this->scene.first_hit(this->across(4, 0)), TypeParam{0.5}, Side::front, id, 1);
  EXPECT_GE(this->scene.box().high[2], 2);
  auto moved = stack_of_triangles<TypeParam>(2);
  for (auto& vertex : moved.vertices) vertex[2] += 2;
  this->floor->rebuild(VertexView<TypeParam>(moved.vertices));
  this->scene.commit();
  this->expect_hit(this->scene.first_hit(this->across(4, 0)), TypeParam{0}, Side::front, id, 1);
  EXPECT_GE(this->scene.box().high[2], 4);
}

// Motion.

TYPED_TEST(SceneMeaning, instance_is_at_its_pose_plus_t_times_its_motion) {
  const auto id = this->add();
  this->scene.set_motion(id, {0, 0, 3});
  this->scene.commit();
  // Up by 3 while the point goes down by 1: they meet after a quarter.
  this->expect_hit(this->scene.first_hit(this->across(1, 0)), TypeParam{0.25}, Side::front, id);
  // A point that goes up is overtaken from below.
  this->expect_hit(this->scene.first_hit(this->across(1, 2)), TypeParam{0.5}, Side::front, id);
  EXPECT_FALSE(this->scene.any_hit(this->across(1, 4)));
  // One that starts below is not caught from above.
  EXPECT_FALSE(this->scene.any_hit(this->across(-1, 1)));
  this->expect_hit(this->scene.first_hit(this->across(-1, 4)), TypeParam{0.5}, Side::back, id);
}

TYPED_TEST(SceneMeaning, point_that_goes_with_an_instance_lies_on_it_from_the_start) {
  const auto id = this->add();
  this->scene.set_motion(id, {1, 2, 3});
  this->scene.commit();
  const TypeParam quarter = this->quarter;
  const Segment<TypeParam> with_it{{quarter, quarter, 0}, {1 + quarter, 2 + quarter, 3}};
  this->expect_hit(this->scene.first_hit(with_it), 0, Side::edge_on, id);
  const Segment<TypeParam> beside_it{{1, 1, 0}, {2, 3, 3}};
  EXPECT_FALSE(this->scene.any_hit(beside_it));
}

TYPED_TEST(SceneMeaning, point_that_stands_is_met_by_an_instance_that_moves) {
  const auto id = this->add();
  this->scene.set_motion(id, {0, 0, 4});
  this->scene.commit();
  this->expect_hit(this->scene.first_hit(this->across(1, 1)), this->quarter, Side::front, id);
  EXPECT_FALSE(this->scene.any_hit(this->across(5, 5)));
}

TYPED_TEST(SceneMeaning, motion_is_exact_where_the_way_past_it_is_no_number) {
  // 1 - 2^-60 up, in a step down from 1 to -1: the ways differ by less than an ulp of any of them.
  const auto id = this->add();
  this->scene.set_motion(id, {0, 0, TypeParam{0x1p-60F}});
  const auto other = this->add();
  this->scene.commit();
  const auto hits = this->all(this->across(1, -1));
  ASSERT_EQ(hits.size(), 2U);
  EXPECT_EQ(hits[0].instance, id);
  EXPECT_EQ(hits[1].instance, other);
}

TYPED_TEST(SceneMeaning, rays_and_lines_see_the_instance_at_its_pose) {
  const auto id = this->add();
  this->scene.set_motion(id, {0, 0, 3});
  this->scene.commit();
  const Vector3<TypeParam> origin{this->quarter, this->quarter, 1};
  this->expect_hit(this->scene.first_hit(Ray<TypeParam>{origin, {0, 0, -1}}), 1, Side::front, id);
  EXPECT_FALSE(this->scene.any_hit(Ray<TypeParam>{origin, {0, 0, 1}}));
  this->expect_hit(this->scene.first_hit(Line<TypeParam>{origin, {0, 0, 1}}), -1, Side::back, id);
}

TYPED_TEST(SceneMeaning, motion_stays_until_it_is_set_again) {
  const auto id = this->add();
  this->scene.set_motion(id, {0, 0, 3});
  for (int i = 0; i < 2; ++i) {
    this->scene.commit();
    EXPECT_TRUE(this->scene.any_hit(this->across(1, TypeParam{0.5})));
  }
  this->scene.set_pose(id, at_height<TypeParam>(-1));
  this->scene.commit();
  this->expect_hit(this->scene.first_hit(this->across(1, 0)), TypeParam{0.5}, Side::front, id);
  this->scene.set_motion(id, {0, 0, 0});
  this->scene.commit();
  EXPECT_FALSE(this->scene.any_hit(this->across(1, 0)));
}

TYPED_TEST(SceneMeaning, instances_with_different_motions_are_ordered_by_exact_t) {
  const auto slow = this->add();
  this->scene.set_motion(slow, {0, 0, 1});
  const auto fast = this->add(at_height<TypeParam>(-1));
  this->scene.set_motion(fast, {0, 0, 7});
  this->scene.commit();
  const auto hits = this->all(this->across(1, 0));
  ASSERT_EQ(hits.size(), 2U);
  this->expect_hit(hits[0], this->quarter, Side::front, fast);
  this->expect_hit(hits[1], TypeParam{0.5}, Side::front, slow);
}

// Options.

TYPED_TEST(SceneMeaning, instance_masks_leave_out_instances) {
  const auto wall = this->add({}, {.mask = 1});
  const auto glass = this->add({}, {.mask = 2});
  this->add({}, {.mask = 0});
  this->scene.commit();
  const auto path = this->across(1, -1);
  EXPECT_EQ(this->all(path).size(), 2U);
  this->expect_hit(this->scene.first_hit(path, {.instance_mask = 1}), TypeParam{0.5}, Side::front, wall);
  this->expect_hit(this->scene.first_hit(path, {.instance_mask = 2}), TypeParam{0.5}, Side::front, glass);
  EXPECT_FALSE(this->scene.any_hit(path, {.instance_mask = 4}));
  EXPECT_FALSE(this->scene.any_hit(path, {.instance_mask = 0}));
  this->scene.set_mask(glass, 5);
  this->scene.commit();
  this->expect_hit(this->scene.first_hit(path, {.instance_mask = 4}), TypeParam{0.5}, Side::front, glass);
}

TYPED_TEST(SceneMeaning, masks_leave_out_triangles) {
  const auto id = this->scene.add(stack_collider<TypeParam>(3, {1, 2, 0}), {}, {.mask = 4});
  this->scene.commit();
  const auto path = this->across(3, -1);
  EXPECT_EQ(this->all(path).size(), 2U);
  this->expect_hit(this->scene.first_hit(path, {.mask = 1}), TypeParam{0.75}, Side::front, id, 0);
  this->expect_hit(this->scene.first_hit(path, {.mask = 2}), TypeParam{0.5}, Side::front, id, 1);
  EXPECT_FALSE(this->scene.any_hit(path, {.mask = 4}));
  EXPECT_FALSE(this->scene.any_hit(path, {.mask = 1, .instance_mask = 1}));
}

TYPED_TEST(SceneMeaning, ignored_instance_is_left_out) {
  const auto upper = this->add(at_height<TypeParam>(1));
  const auto lower = this->add();
  this->scene.commit();
  const auto path = this->across(2, -2);
  this->expect_hit(this->scene.first_hit(path), this->quarter, Side::front, upper);
  this->expect_hit(this->scene.first_hit(path, {.ignored_instance = upper}), TypeParam{0.5}, Side::front, lower);
}

TYPED_TEST(SceneMeaning, ignored_triangle_is_one_of_the_ignored_instance) {
  const auto stack = stack_collider<TypeParam>(2);
  const auto upper = this->scene.add(stack, at_height<TypeParam>(2));
  const auto lower = this->scene.add(stack);
  this->scene.commit();
  const auto path = this->across(4, -4);
  const auto hits = this->all(path, {.ignored_instance = upper, .ignored_triangle = 1});
  ASSERT_EQ(hits.size(), 3U);
  this->expect_hit(hits[0], this->quarter, Side::front, upper, 0);
  this->expect_hit(hits[1], TypeParam{0.375}, Side::front, lower, 1);
  // Without an ignored instance it means nothing.
  EXPECT_EQ(this->all(path, {.ignored_triangle = 1}).size(), 4U);
}

TYPED_TEST(SceneMeaning, stale_ignored_instance_leaves_out_nothing) {
  const auto old = this->add();
  this->scene.remove(old);
  this->scene.commit();
  const auto later = this->add();
  this->scene.commit();
  this->expect_hit(this->scene.first_hit(this->across(1, -1), {.ignored_instance = old}), TypeParam{0.5}, Side::front,
                   later);
}

TYPED_TEST(SceneMeaning, limits_are_exact) {
  this->add(with_rows<TypeParam>({3, 0, 0}, {0, 3, 0}, {0, 0, 3}));
  this->scene.commit();
  const TypeParam half{0.5};
  EXPECT_TRUE(this->scene.any_hit(this->across(1, -1), {.min_t = half, .max_t = half}));
  EXPECT_FALSE(this->scene.any_hit(this->across(1, -1), {.min_t = neighbour(half, 1)}));
  EXPECT_FALSE(this->scene.any_hit(this->across(1, -1), {.max_t = neighbour(half, -1)}));
  EXPECT_FALSE(this->scene.any_hit(this->across(1, -1), {.min_t = std::numeric_limits<TypeParam>::quiet_NaN()}));
}

TYPED_TEST(SceneMeaning, ignored_contacts_are_where_the_instance_is_at_that_time) {
  const auto id = this->add();
  this->scene.set_motion(id, {0, 0, 3});
  this->scene.commit();
  EXPECT_FALSE(this->scene.any_hit(this->across(0, 5), {.ignore_start_contact = true}));
  EXPECT_TRUE(this->scene.any_hit(this->across(0, 5), {.ignore_end_contact = true}));
  EXPECT_FALSE(this->scene.any_hit(this->across(5, 3), {.ignore_end_contact = true}));
  EXPECT_TRUE(this->scene.any_hit(this->across(5, 3), {.ignore_start_contact = true}));
  EXPECT_TRUE(this->scene.any_hit(this->across(1, 0), {.ignore_end_contact = true}));
}

TYPED_TEST(SceneMeaning, filter_sees_the_hit_and_its_instance) {
  const auto upper = this->add(at_height<TypeParam>(1));
  const auto lower = this->add();
  this->scene.commit();
  const auto path = this->across(2, -2);
  std::vector<SceneHit<TypeParam>> seen;
  const auto is_lower = [&](const SceneHit<TypeParam>& hit) {
    seen.push_back(hit);
    return hit.instance == lower;
  };
  this->expect_hit(this->scene.first_hit(path, is_lower), TypeParam{0.5}, Side::front, lower);
  for (const auto& hit : seen) {
    this->expect_hit(hit, hit.instance == upper ? this->quarter : TypeParam{0.5}, Side::front, hit.instance);
  }
  EXPECT_TRUE(this->scene.any_hit(path, is_lower));
  std::vector<SceneHit<TypeParam>> hits;
  this->scene.all_hits(path, hits, is_lower);
  ASSERT_EQ(hits.size(), 1U);
  this->expect_hit(hits[0], TypeParam{0.5}, Side::front, lower);
}

// Batches.

TYPED_TEST(SceneMeaning, batch_ends_with_the_shortest_of_its_spans) {
  this->add();
  this->scene.commit();
  const std::vector<Segment<TypeParam>> paths(3, this->across(1, -1));
  const std::vector<SceneQueryOptions<TypeParam>> options(2);
  std::vector<SceneHit<TypeParam>> hits(4);
  std::vector<std::uint8_t> blocked(4, 7);
  this->scene.first_hits(paths, hits, {.path_options = options});
  this->scene.any_hits(paths, blocked, {.path_options = options});
  EXPECT_EQ(hits[1].triangle, 0U);
  EXPECT_EQ(hits[2].triangle, no_triangle);
  EXPECT_EQ(blocked, (std::vector<std::uint8_t>{1, 1, 7, 7}));
  this->scene.first_hits(paths, hits);
  EXPECT_EQ(hits[2].triangle, 0U);
  EXPECT_EQ(hits[3].triangle, no_triangle);
}

TYPED_TEST(SceneMeaning, each_path_of_a_batch_has_its_options) {
  this->add();
  this->scene.commit();
  const std::vector<Segment<TypeParam>> paths(40, this->across(1, -1));
  std::vector<SceneQueryOptions<TypeParam>> options(paths.size());
  for (std::size_t i = 0; i < paths.size(); i += 3) options[i].max_t = TypeParam(0.25);
  std::vector<SceneHit<TypeParam>> hits(paths.size());
  std::vector<std::uint8_t> blocked(paths.size());
  this->scene.first_hits(paths, hits, {.path_options = options});
  this->scene.any_hits(paths, blocked, {.path_options = options});
  for (std::size_t i = 0; i < hits.size(); ++i) {
    EXPECT_EQ(hits[i].triangle, i % 3 == 0 ? no_triangle : 0U);
    EXPECT_EQ(blocked[i], i % 3 == 0 ? 0 : 1);
  }
}

TYPED_TEST(SceneMeaning, filter_of_a_batch_sees_the_path) {
  const auto id = this->add();
  this->scene.commit();
  const std::vector<Segment<TypeParam>> paths(40, this->across(1, -1));
  std::vector<SceneHit<TypeParam>> hits(paths.size());
  const auto is_third = [](std::size_t path, const SceneHit<TypeParam>&) { return path % 3 == 0; };
  this->scene.first_hits(paths, hits, {.filter = is_third});
  for (std::size_t i = 0; i < hits.size(); ++i) EXPECT_EQ(hits[i].instance, i % 3 == 0 ? id : InstanceId{});
}

TYPED_TEST(SceneMeaning, statistics_count_each_path_once) {
  for (int i = 0; i < 3; ++i) this->add(at_height<TypeParam>(static_cast<TypeParam>(i)));
  this->scene.commit();
  const std::vector<Segment<TypeParam>> paths(40, this->across(1, -1));
  std::vector<SceneHit<TypeParam>> hits(paths.size());
  QueryStatistics statistics;
  this->scene.first_hits(paths, hits, {.statistics = &statistics});
  EXPECT_EQ(statistics.paths, 40U);
  static_cast<void>(this->scene.first_hit(paths[0], {}, &statistics));
  static_cast<void>(this->scene.any_hit(paths[0], {}, &statistics));
  this->scene.all_hits(paths[0], hits, {}, &statistics);
  EXPECT_EQ(statistics.paths, 43U);
}

TYPED_TEST(SceneMeaning, path_that_is_not_finite_hits_nothing) {
  this->add();
  this->scene.commit();
  for (const TypeParam bad :
       {std::numeric_limits<TypeParam>::quiet_NaN(), std::numeric_limits<TypeParam>::infinity()}) {
    const auto path = this->across(1, -bad);
    EXPECT_FALSE(this->scene.any_hit(path));
    EXPECT_FALSE(this->scene.any_hit(Ray<TypeParam>{{bad, 0, 0}, {0, 0, 1}}));
    EXPECT_EQ(this->scene.last_free_point(path, SceneHit<TypeParam>{{.t = TypeParam{0.5}}, {}}), path.start);
  }
}

// "it moves by s times its motion while the point moves to s."

TYPED_TEST(SceneMeaning, last_free_point_is_in_front_of_where_the_instance_is_by_then) {
  const auto id = this->add();
  this->scene.set_motion(id, {0, 0, 1});
  this->scene.commit();
  const auto path = this->across(1, 0);
  const auto hit = this->scene.first_hit(path);
  this->expect_hit(hit, TypeParam{0.5}, Side::front, id);
  const TypeParam epsilon = std::numeric_limits<TypeParam>::epsilon();
  EXPECT_EQ(this->scene.last_free_point(path, *hit)[2], TypeParam{0.5} + epsilon / 2);
}

TYPED_TEST(SceneMeaning, last_free_point_of_a_tiny_t_is_that_of_the_collider) {
  this->add();
  this->scene.commit();
  const auto path = this->across(TypeParam{0x1p-80F}, -1);
  const auto hit = this->scene.first_hit(path);
  ASSERT_TRUE(hit);
  const auto free = this->scene.last_free_point(path, *hit);
  EXPECT_NE(free, path.start);
  EXPECT_EQ(free, this->floor->last_free_point(path, *hit));
}

// "A scene of doubles takes colliders of float and of double."

TEST(SceneOfDoubles, takes_colliders_of_both) {
  Scened scene;
  const auto of_float = scene.add(stack_collider<float>(1), at_height(0x1p40));
  const auto of_double = scene.add(stack_collider<double>(1), at_height(0x1p40 + 1));
  scene.commit();
  std::vector<SceneHitd> hits;
  scene.all_hits(Segmentd{{0.1, 0.2, 0x1p40 + 2}, {0.1, 0.2, 0x1p40 - 2}}, hits);
  ASSERT_EQ(hits.size(), 2U);
  EXPECT_EQ(hits[0].instance, of_double);
  EXPECT_EQ(hits[1].instance, of_float);
  // The weights are doubles in both.
  for (const SceneHitd& hit : hits) {
    EXPECT_EQ(hit.u, 0.1);
    EXPECT_EQ(hit.v, 0.2);
  }
}

// "An instance is the exact image of its mesh", where doubles lose all of it.

TEST(SceneOfDoubles, knows_where_the_middle_of_a_mesh_is_though_its_image_cancels) {
  constexpr double a = 0x1.93de7e4f16d7ap+60, b = 0x1.4c1634efd96efp+7;
  constexpr double x = 0x1.b1a55f88176edp+0, z = 0x1.6d5b5c5ebf07cp+0;
  GeneratedMesh<double> planes;
  for (const double y : {-5.0, 5.0}) planes.add({{0, y, 0}, {2 * x, y, 0}, {x, y, 2 * z}});
  Posed pose;
  pose.linear << 1, 0, 0, a, 0x1p-64, b, 0, 0, 1;
  pose.translation = {-x, -0x1.56101c60b9536p+61, -z};
  Scened scene;
  scene.add(std::make_shared<Collider<double>>(planes.view()), pose);
  scene.commit();
  // In the mesh, the origin of the scene is far above both planes. So only the way down meets them.
  const std::vector<Rayd> rays = {{{0, 0, 0}, {1, 0, 0}}, {{0, 0, 0}, {-1, 0, 0}}};
  std::vector<SceneHitd> hits(rays.size());
  scene.first_hits(rays, hits);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto alone = scene.first_hit(rays[i]);
    EXPECT_EQ(alone ? alone->triangle : no_triangle, i == 0 ? 1 : no_triangle);
    EXPECT_EQ(hits[i].triangle, i == 0 ? 1 : no_triangle);
  }
}

TEST(SceneOfDoubles, meets_boxes_without_bounds_far_from_their_middle) {
  constexpr double huge = 1e305;
  for (int axis = 0; axis < 3; ++axis) {
    const auto turned = [&](double x, double y, double z) {
      const std::array<double, 3> all = {x, y, z};
      const auto at = [&](int i) { return all[static_cast<std::size_t>((i + axis) % 3)]; };
      return Vector3d(at(0), at(1), at(2));
    };
    GeneratedMesh<double> wall;
    wall.add({turned(0.5, -huge, -huge), turned(0.5, huge, -huge), turned(0.5, 0, huge)});
    Scened scene;
    scene.add(std::make_shared<Collider<double>>(wall.view()));
    scene.commit();
    for (const double far : {1e13, -1e13, 1e25, -1e25}) {
      const Segmentd segment{turned(-1, 0.25, far), turned(2, 0.25, far)};
      const auto hit = scene.first_hit(segment);
      ASSERT_TRUE(hit) << axis << ' ' << far;
      EXPECT_EQ(hit->t, 0.5);
      EXPECT_TRUE(scene.any_hit(segment));
    }
  }
}

}  // namespace
}  // namespace surehit::test
