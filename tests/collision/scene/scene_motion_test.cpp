#include <limits>

#include "scene_meaning.hpp"

namespace surehit::test::scene_motion_test {
namespace {

/// What a segment means where instances move.
template <typename Scalar>
class SceneMotion : public SceneMeaning<Scalar> {};
TYPED_TEST_SUITE(SceneMotion, Scalars, ScalarNames);

TYPED_TEST(SceneMotion, instance_is_at_its_pose_plus_t_times_its_motion) {
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

TYPED_TEST(SceneMotion, point_that_goes_with_an_instance_lies_on_it_from_the_start) {
  const auto id = this->add();
  this->scene.set_motion(id, {1, 2, 3});
  this->scene.commit();
  const TypeParam quarter = this->quarter;
  const Segment<TypeParam> with_it{{quarter, quarter, 0}, {1 + quarter, 2 + quarter, 3}};
  this->expect_hit(this->scene.first_hit(with_it), 0, Side::edge_on, id);
  const Segment<TypeParam> beside_it{{1, 1, 0}, {2, 3, 3}};
  EXPECT_FALSE(this->scene.any_hit(beside_it));
}

TYPED_TEST(SceneMotion, point_that_stands_is_met_by_an_instance_that_moves) {
  const auto id = this->add();
  this->scene.set_motion(id, {0, 0, 4});
  this->scene.commit();
  this->expect_hit(this->scene.first_hit(this->across(1, 1)), this->quarter, Side::front, id);
  EXPECT_FALSE(this->scene.any_hit(this->across(5, 5)));
}

TYPED_TEST(SceneMotion, motion_is_exact_where_the_way_past_it_is_no_number) {
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

TYPED_TEST(SceneMotion, rays_and_lines_see_the_instance_at_its_pose) {
  const auto id = this->add();
  this->scene.set_motion(id, {0, 0, 3});
  this->scene.commit();
  const Vector3<TypeParam> origin{this->quarter, this->quarter, 1};
  this->expect_hit(this->scene.first_hit(Ray<TypeParam>{origin, {0, 0, -1}}), 1, Side::front, id);
  EXPECT_FALSE(this->scene.any_hit(Ray<TypeParam>{origin, {0, 0, 1}}));
  this->expect_hit(this->scene.first_hit(Line<TypeParam>{origin, {0, 0, 1}}), -1, Side::back, id);
}

TYPED_TEST(SceneMotion, motion_stays_until_it_is_set_again) {
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

TYPED_TEST(SceneMotion, instances_with_different_motions_are_ordered_by_exact_t) {
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

TYPED_TEST(SceneMotion, ignored_contacts_are_where_the_instance_is_at_that_time) {
  const auto id = this->add();
  this->scene.set_motion(id, {0, 0, 3});
  this->scene.commit();
  EXPECT_FALSE(this->scene.any_hit(this->across(0, 5), {.ignore_start_contact = true}));
  EXPECT_TRUE(this->scene.any_hit(this->across(0, 5), {.ignore_end_contact = true}));
  EXPECT_FALSE(this->scene.any_hit(this->across(5, 3), {.ignore_end_contact = true}));
  EXPECT_TRUE(this->scene.any_hit(this->across(5, 3), {.ignore_start_contact = true}));
  EXPECT_TRUE(this->scene.any_hit(this->across(1, 0), {.ignore_end_contact = true}));
}

// "it moves by s times its motion while the point moves to s."

TYPED_TEST(SceneMotion, last_free_point_is_in_front_of_where_the_instance_is_by_then) {
  const auto id = this->add();
  this->scene.set_motion(id, {0, 0, 1});
  this->scene.commit();
  const auto path = this->across(1, 0);
  const auto hit = this->scene.first_hit(path);
  this->expect_hit(hit, TypeParam{0.5}, Side::front, id);
  const TypeParam epsilon = std::numeric_limits<TypeParam>::epsilon();
  EXPECT_EQ(this->scene.last_free_point(path, *hit)[2], TypeParam{0.5} + epsilon / 2);
}

TYPED_TEST(SceneMotion, share_of_a_last_free_point_is_where_the_instance_is_by_then) {
  const auto id = this->add();
  this->scene.set_motion(id, {0, 0, 1});
  this->scene.commit();
  const auto path = this->across(1, 0);
  const auto hit = this->scene.first_hit(path);
  ASSERT_TRUE(hit);
  TypeParam share = 2;
  const auto free = this->scene.last_free_point(path, *hit, {}, &share);
  // The next Scalar below t = 0.5 is half as far away as the one above, and is not tried.
  EXPECT_EQ(share, TypeParam{0.5} - std::numeric_limits<TypeParam>::epsilon() / 2);
  EXPECT_EQ(free[2], 1 - share);
  // The point may stay where it is, beside the instance as it is by then.
  this->scene.set_pose(id, at_height<TypeParam>(share));
  this->scene.set_motion(id, {0, 0, 0});
  this->scene.commit();
  EXPECT_FALSE(this->scene.any_hit(this->across(free[2], free[2])));
  EXPECT_TRUE(this->scene.any_hit(this->across(free[2], share)));

  // From a start on the instance, no point is free.
  const auto from_it = this->across(share, 0);
  EXPECT_EQ(this->scene.last_free_point(from_it, SceneHit<TypeParam>{{.t = TypeParam{0.5}}, {}}, {}, &share),
            from_it.start);
  EXPECT_EQ(share, 0);
}

}  // namespace
}  // namespace surehit::test::scene_motion_test
