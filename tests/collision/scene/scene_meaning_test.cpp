#include "scene_meaning.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace surehit::test::scene_meaning_test {
namespace {

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
  const std::vector<InstanceId> ids = this->add_equal_triangles();
  this->scene.commit();
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

TYPED_TEST(SceneMeaning, assigned_collider_is_seen_after_the_commit) {
  const auto id = this->add();
  this->scene.commit();
  *this->floor = Collider<TypeParam>(*this->floor);  // The same mesh in another place.
  this->scene.commit();
  this->floor->set_mask(0, 0);
  EXPECT_FALSE(this->scene.any_hit(this->across(4, -4)));
  *this->floor = Collider<TypeParam>(stack_of_triangles<TypeParam>(2).view());
  this->scene.commit();
  this->expect_hit(this->scene.first_hit(this->across(4, 0)), TypeParam{0.75}, Side::front, id, 1);
}

// "Gives an instance another collider. Its id, pose, motion, mask and user data stay."

TYPED_TEST(SceneMeaning, other_collider_is_seen_after_the_commit) {
  const auto id = this->scene.add(this->floor, at_height<TypeParam>(-2), {.mask = 6, .user_data = 7});
  this->scene.set_motion(id, {0, 0, 1});
  this->scene.commit();
  const long uses = this->floor.use_count();
  const auto path = this->across(4, -4);
  const auto before = this->scene.first_hit(path);
  const auto snapshot = this->scene.snapshot();
  this->scene.set_collider(id, stack_collider<TypeParam>(2));
  EXPECT_EQ(this->scene.triangle_count(id), 2U);
  EXPECT_TRUE(same_bits(*this->scene.first_hit(path), *before));
  this->scene.commit();
  const auto after = this->scene.first_hit(path);
  ASSERT_TRUE(after);
  EXPECT_EQ(after->instance, id);
  EXPECT_EQ(after->triangle, 1U);
  EXPECT_LT(after->t, before->t);
  EXPECT_TRUE(same_bits(*snapshot.first_hit(path), *before));
  EXPECT_EQ(this->scene.pose(id).translation[2], -2);
  EXPECT_EQ(this->scene.motion(id)[2], 1);
  EXPECT_EQ(this->scene.mask(id), 6U);
  EXPECT_EQ(this->scene.user_data(id), 7U);
  EXPECT_EQ(this->floor.use_count(), uses);  // The snapshot has it.
}

TYPED_TEST(SceneMeaning, other_collider_ends_the_share_of_the_first_one) {
  const long uses = this->floor.use_count();
  const auto id = this->add();
  this->scene.commit();
  this->scene.set_collider(id, stack_collider<TypeParam>(2));
  EXPECT_GT(this->floor.use_count(), uses);  // Queries may still use it.
  this->scene.commit();
  EXPECT_EQ(this->floor.use_count(), uses);
}

TYPED_TEST(SceneMeaning, last_collider_before_a_commit_counts) {
  const auto id = this->add();
  const auto two = stack_collider<TypeParam>(2);
  const auto three = stack_collider<TypeParam>(3);
  this->scene.set_collider(id, two);
  this->scene.set_collider(id, three);
  EXPECT_EQ(two.use_count(), 1);
  EXPECT_EQ(three.use_count(), 2);
  this->scene.commit();
  EXPECT_EQ(three.use_count(), 2);
  EXPECT_EQ(this->scene.first_hit(this->across(4, -4))->triangle, 2U);
}

TYPED_TEST(SceneMeaning, instance_gets_triangles_and_loses_them_with_its_collider) {
  const auto id = this->scene.add(std::make_shared<Collider<TypeParam>>());
  for (int round = 0; round < 3; ++round) {
    this->scene.set_collider(id, this->floor);
    this->scene.commit();
    this->expect_hit(this->scene.first_hit(this->across(1, -1)), TypeParam{0.5}, Side::front, id);
    this->scene.set_collider(id, std::make_shared<Collider<TypeParam>>());
    this->scene.commit();
    EXPECT_FALSE(this->scene.any_hit(this->across(1, -1)));
  }
}

TEST(SceneMeaningInDouble, collider_of_floats_takes_the_place_of_one_of_doubles) {
  Scened scene;
  const auto id = scene.add(stack_collider<double>(1));
  scene.commit();
  const auto path = through_stack<double>(4, -4);
  for (int round = 0; round < 2; ++round) {
    scene.set_collider(id, stack_collider<float>(3));
    scene.commit();
    EXPECT_EQ(scene.triangle_count(id), 3U);
    EXPECT_EQ(scene.first_hit(path)->triangle, 2U);
    scene.set_collider(id, stack_collider<double>(2));
    scene.commit();
    EXPECT_EQ(scene.triangle_count(id), 2U);
    EXPECT_EQ(scene.first_hit(path)->triangle, 1U);
  }
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

/// The coordinates from this axis on.
Vector3d turned_by(int axis, const std::array<double, 3>& all) {
  const auto at = [&](int i) { return all[static_cast<std::size_t>((i + axis) % 3)]; };
  return {at(0), at(1), at(2)};
}

TEST(SceneOfDoubles, meets_boxes_without_bounds_far_from_their_middle) {
  constexpr double huge = 1e305;
  for (int axis = 0; axis < 3; ++axis) {
    const auto turned = [&](double x, double y, double z) { return turned_by(axis, {x, y, z}); };
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

/// A wall across an axis, as far away as doubles go. Its box is small, and beyond the frame of the other instances.
TEST(SceneOfDoubles, meets_a_small_box_far_beyond_all_others) {
  constexpr double huge = 1e305;
  for (int axis = 0; axis < 3; ++axis) {
    const auto turned = [&](double x, double y, double z) { return turned_by(axis, {x, y, z}); };
    GeneratedMesh<double> wall;
    wall.add({turned(0, -1, -1), turned(0, 1, -1), turned(0, 0, 1)});
    const auto collider = std::make_shared<Collider<double>>(wall.view());
    for (const bool is_alone : {true, false}) {
      Scened scene;
      const auto far = scene.add(collider, Posed::translated(turned(huge, 0, 0)));
      if (!is_alone) scene.add(collider, Posed::translated(turned(3, 100, 0)));
      scene.commit();
      const Rayd ray{turned(-5, 0.25, 0.125), turned(1, 0, 0)};
      const auto hit = scene.first_hit(ray);
      ASSERT_TRUE(hit) << axis;
      EXPECT_EQ(hit->t, huge);
      EXPECT_EQ(hit->instance, far);
      EXPECT_TRUE(scene.any_hit(ray));
      const std::vector<Rayd> rays(20, ray);
      std::vector<SceneHitd> hits(rays.size());
      std::vector<std::uint8_t> blocked(rays.size());
      scene.first_hits(rays, hits);
      scene.any_hits(rays, blocked);
      for (std::size_t i = 0; i < rays.size(); ++i) {
        EXPECT_TRUE(same_bits(hits[i], *hit));
        EXPECT_EQ(blocked[i], 1);
      }
    }
  }
}

}  // namespace
}  // namespace surehit::test::scene_meaning_test
