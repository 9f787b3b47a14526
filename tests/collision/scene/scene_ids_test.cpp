#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "support/scalars.hpp"
#include "surehit/scene.hpp"
#include "unit_scenes.hpp"

namespace surehit::test::scene_ids_test {
namespace {

using Reason = InvalidInstance::Reason;

/// What ids stand for, and what a scene knows of its instances.
template <typename Scalar>
class SceneIds : public testing::Test {
 protected:
  InstanceId add(const Pose<Scalar>& pose = {}, const InstanceOptions& options = {}) {
    return scene.add(floor, pose, options);
  }

  static Segment<Scalar> across() { return through_stack<Scalar>(4, -4); }

  void expect_stale(InstanceId id) {
    EXPECT_FALSE(scene.contains(id));
    const auto expect_error = [&](const InstanceResult& result) {
      ASSERT_FALSE(result);
      EXPECT_EQ(result.error().reason, Reason::stale_id);
      EXPECT_EQ(result.error().element, id.index);
      EXPECT_EQ(result.id(), InstanceId{});
    };
    expect_error(scene.try_remove(id));
    expect_error(scene.try_set_collider(id, floor));
    expect_error(scene.try_set_pose(id, {}));
    expect_error(scene.try_set_motion(id, {0, 0, 0}));
    expect_error(scene.try_set_mask(id, 1));
    EXPECT_THROW(scene.remove(id), InvalidInstance);
  }

  /// No other instance answers for a stale id, and neither does what is left of one.
  template <typename Subject>
  static void expect_unknown(const Subject& subject, InstanceId id) {
    const auto expect_error = [&](const auto& ask) {
      try {
        ask();
        ADD_FAILURE() << "answered";
      } catch (const InvalidInstance& error) {
        EXPECT_EQ(error.reason, Reason::stale_id);
        EXPECT_EQ(error.element, id.index);
        EXPECT_NE(std::string(error.what()).find(std::to_string(id.index)), std::string::npos) << error.what();
      }
    };
    expect_error([&] { return subject.pose(id).translation[2]; });
    expect_error([&] { return subject.motion(id)[2]; });
    expect_error([&] { return subject.mask(id); });
    expect_error([&] { return subject.user_data(id); });
    expect_error([&] { return subject.triangle_count(id); });
    expect_error([&] { return subject.triangle(id, 0); });
    expect_error([&] { return subject.normal(id, 0); });
  }

  std::shared_ptr<Collider<Scalar>> floor = stack_collider<Scalar>(1);
  Scene<Scalar> scene;
};
TYPED_TEST_SUITE(SceneIds, Scalars, ScalarNames);

TYPED_TEST(SceneIds, default_id_is_that_of_no_instance) {
  EXPECT_EQ(InstanceId{}.index, no_instance);
  this->expect_stale({});
  this->expect_stale({0, 0});
  this->add();
  this->expect_stale({});
  this->expect_stale({1, 0});
}

TYPED_TEST(SceneIds, new_instance_is_known_before_the_commit) {
  const auto id = this->add();
  EXPECT_TRUE(this->scene.contains(id));
  EXPECT_EQ(this->scene.instance_count(), 1U);
  EXPECT_EQ(this->scene.instances(), std::vector<InstanceId>{id});
  EXPECT_EQ(this->scene.triangle_count(id), 1U);
  this->scene.remove(id);
  EXPECT_EQ(this->scene.instance_count(), 0U);
  this->expect_stale(id);
}

TYPED_TEST(SceneIds, removed_id_is_stale_before_and_after_the_commit) {
  const auto id = this->add();
  this->scene.commit();
  this->scene.remove(id);
  this->expect_stale(id);
  this->scene.commit();
  this->expect_stale(id);
}

TYPED_TEST(SceneIds, old_id_is_never_that_of_another_instance) {
  std::vector<InstanceId> old;
  for (int i = 0; i < 50; ++i) {
    const auto id = this->add();
    EXPECT_EQ(std::find(old.begin(), old.end(), id), old.end());
    if (i % 3 == 0) this->scene.commit();
    this->scene.remove(id);
    old.push_back(id);
    if (i % 2 == 0) this->scene.commit();
  }
  const auto id = this->add();
  for (const InstanceId stale : old) this->expect_stale(stale);
  EXPECT_TRUE(this->scene.contains(id));
}

TYPED_TEST(SceneIds, generation_counts_the_uses_of_an_index) {
  const auto first = this->add();
  EXPECT_EQ(first.generation, 0U);
  this->scene.commit();
  this->scene.remove(first);
  this->scene.commit();
  // Indices are few if they come back.
  std::vector<InstanceId> ids;
  for (int i = 0; i < 100; ++i) {
    ids.push_back(this->add());
    this->scene.commit();
    this->scene.remove(ids.back());
    this->scene.commit();
  }
  const auto greatest = std::max_element(ids.begin(), ids.end());
  EXPECT_LT(greatest->index, 10U);
  EXPECT_GE(greatest->generation, 10U);
}

TYPED_TEST(SceneIds, removed_instance_answers_until_the_commit_by_its_old_id) {
  const auto old = this->add();
  this->scene.commit();
  this->scene.remove(old);
  const auto later = this->add(at_height<TypeParam>(1));
  const auto before = this->scene.first_hit(this->across());
  ASSERT_TRUE(before);
  EXPECT_EQ(before->instance, old);
  // What it was is known as long as queries hit it.
  EXPECT_EQ(this->scene.pose(old).translation[2], 0);
  EXPECT_EQ(this->scene.user_data(old), 0U);
  EXPECT_EQ(this->scene.triangle_count(old), 1U);
  EXPECT_EQ(this->scene.normal(old, 0), (Vector3<TypeParam>{0, 0, 1}));
  EXPECT_FALSE(this->scene.contains(old));
  this->scene.commit();
  const auto after = this->scene.first_hit(this->across());
  ASSERT_TRUE(after);
  EXPECT_EQ(after->instance, later);
}

TYPED_TEST(SceneIds, nothing_is_known_of_a_stale_id) {
  this->expect_unknown(this->scene, {});
  this->expect_unknown(this->scene, {0, 0});
  const auto old = this->add();
  this->expect_unknown(this->scene, {});
  this->expect_unknown(this->scene, {1, 0});
  this->expect_unknown(this->scene, {old.index, old.generation + 1});
  this->scene.commit();
  this->scene.remove(old);
  this->expect_unknown(this->scene, {old.index, old.generation + 1});
  this->scene.commit();
  this->expect_unknown(this->scene, old);
  // The index is in use again.
  const auto later = this->add(at_height<TypeParam>(1), {.user_data = 7});
  ASSERT_EQ(later.index, old.index);
  this->expect_unknown(this->scene, old);
  EXPECT_EQ(this->scene.user_data(later), 7U);
}

TYPED_TEST(SceneIds, a_snapshot_knows_nothing_of_a_stale_id) {
  this->expect_unknown(this->scene.snapshot(), {});
  const auto old = this->add();
  this->expect_unknown(this->scene.snapshot(), old);  // It is not committed.
  this->scene.commit();
  const auto before = this->scene.snapshot();
  this->expect_unknown(before, {1, 0});
  this->scene.remove(old);
  this->scene.commit();
  const auto later = this->add(at_height<TypeParam>(1), {.user_data = 7});
  this->expect_unknown(this->scene.snapshot(), old);
  this->scene.commit();
  ASSERT_EQ(later.index, old.index);
  this->expect_unknown(this->scene.snapshot(), old);
  this->expect_unknown(before, later);
  EXPECT_EQ(before.user_data(old), 0U);
  EXPECT_EQ(this->scene.snapshot().user_data(later), 7U);
}

TYPED_TEST(SceneIds, instances_are_in_order) {
  for (int i = 0; i < 20; ++i) this->add();
  auto ids = this->scene.instances();
  for (std::size_t i = 0; i < 20; i += 3) this->scene.remove(ids[i]);
  for (int i = 0; i < 5; ++i) this->add();
  ids = this->scene.instances();
  EXPECT_EQ(ids.size(), this->scene.instance_count());
  EXPECT_TRUE(std::is_sorted(ids.begin(), ids.end()));
  EXPECT_EQ(std::adjacent_find(ids.begin(), ids.end()), ids.end());
  for (const InstanceId id : ids) EXPECT_TRUE(this->scene.contains(id));
}

TYPED_TEST(SceneIds, what_was_set_last_is_known_before_the_commit) {
  const auto id = this->add(at_height<TypeParam>(1), {.mask = 5, .user_data = 0x123456789abcdef0u});
  const auto other = this->add();
  EXPECT_EQ(this->scene.pose(id).translation[2], 1);
  EXPECT_EQ(this->scene.motion(id), (Vector3<TypeParam>{0, 0, 0}));
  EXPECT_EQ(this->scene.mask(id), 5U);
  EXPECT_EQ(this->scene.user_data(id), 0x123456789abcdef0u);
  EXPECT_EQ(this->scene.mask(other), ~std::uint32_t{0});
  EXPECT_EQ(this->scene.user_data(other), 0U);
  EXPECT_EQ(this->scene.pose(other).linear, Pose<TypeParam>::Matrix3::Identity());
  for (int commits = 0; commits < 2; ++commits) {
    const auto height = static_cast<TypeParam>(7 + commits);
    this->scene.set_pose(id, at_height(height));
    this->scene.set_motion(id, {1, 2, height});
    this->scene.set_mask(id, 9);
    EXPECT_EQ(this->scene.pose(id).translation[2], height);
    EXPECT_EQ(this->scene.motion(id), (Vector3<TypeParam>{1, 2, height}));
    EXPECT_EQ(this->scene.mask(id), 9U);
    this->scene.commit();
  }
}

TYPED_TEST(SceneIds, user_data_of_a_reused_index_is_the_new_one) {
  const auto old = this->add(at_height<TypeParam>(1), {.mask = 1, .user_data = 7});
  this->scene.set_motion(old, {1, 1, 1});
  this->scene.commit();
  this->scene.remove(old);
  this->scene.commit();
  const auto id = this->add();
  EXPECT_EQ(this->scene.user_data(id), 0U);
  EXPECT_EQ(this->scene.motion(id), (Vector3<TypeParam>{0, 0, 0}));
  EXPECT_EQ(this->scene.mask(id), ~std::uint32_t{0});
  this->scene.commit();
  EXPECT_EQ(this->scene.first_hit(this->across())->t, TypeParam{0.5});
}

TYPED_TEST(SceneIds, setters_return_the_id) {
  const auto id = this->add();
  EXPECT_EQ(this->scene.try_set_pose(id, {}).id(), id);
  EXPECT_EQ(this->scene.try_set_motion(id, {0, 0, 1}).id(), id);
  EXPECT_EQ(this->scene.try_set_mask(id, 1).id(), id);
  EXPECT_EQ(this->scene.try_remove(id).id(), id);
}

TYPED_TEST(SceneIds, scene_shares_a_collider_until_nothing_needs_it) {
  std::weak_ptr<const Collider<TypeParam>> watched = this->floor;
  const auto id = this->scene.add(std::move(this->floor));
  this->scene.commit();
  EXPECT_FALSE(watched.expired());
  this->scene.remove(id);
  EXPECT_TRUE(this->scene.any_hit(this->across()));
  EXPECT_FALSE(watched.expired());
  this->scene.commit();
  EXPECT_TRUE(watched.expired());
}

TYPED_TEST(SceneIds, end_of_a_scene_gives_up_its_colliders) {
  {
    Scene<TypeParam> scene;
    scene.add(this->floor);
    scene.commit();
    scene.add(this->floor);
  }
  EXPECT_EQ(this->floor.use_count(), 1);
}

TYPED_TEST(SceneIds, moved_scene_takes_all_along) {
  const auto id = this->add();
  this->scene.commit();
  this->scene.set_pose(id, at_height<TypeParam>(2));
  Scene<TypeParam> moved = std::move(this->scene);
  EXPECT_EQ(moved.first_hit(this->across())->t, TypeParam{0.5});
  moved.commit();
  EXPECT_EQ(moved.first_hit(this->across())->t, TypeParam{0.25});
  EXPECT_EQ(this->scene.instance_count(), 0U);
  EXPECT_FALSE(this->scene.contains(id));
  EXPECT_FALSE(this->scene.any_hit(this->across()));
  // It can be used again.
  this->add();
  this->scene.commit();
  EXPECT_TRUE(this->scene.any_hit(this->across()));
  this->scene = std::move(moved);
  EXPECT_EQ(this->scene.first_hit(this->across())->t, TypeParam{0.25});
}

TYPED_TEST(SceneIds, memory_counts_the_scene_without_its_colliders) {
  const auto large = std::make_shared<Collider<TypeParam>>(stack_of_triangles<TypeParam>(5000).view());
  const std::size_t empty = this->scene.memory_bytes();
  this->scene.add(large);
  this->scene.commit();
  const std::size_t one = this->scene.memory_bytes();
  EXPECT_GT(one, empty);
  EXPECT_LT(one, large->memory_bytes() / 2);
  for (int i = 0; i < 1000; ++i) this->scene.add(large);
  this->scene.commit();
  EXPECT_GT(this->scene.memory_bytes(), one + 1000 * sizeof(Pose<TypeParam>));
}

TYPED_TEST(SceneIds, pose_of_another_instance_may_be_given) {
  // The scene grows while it reads the pose.
  const auto first = this->add();
  const auto pattern = this->add(at_height<TypeParam>(3));
  for (int i = 0; i < 3000; ++i) {
    const auto id = this->scene.add(this->floor, this->scene.pose(pattern));
    ASSERT_EQ(this->scene.pose(id).linear, Pose<TypeParam>().linear);
    ASSERT_EQ(this->scene.pose(id).translation, at_height<TypeParam>(3).translation);
  }
  this->scene.set_pose(first, this->scene.pose(pattern));
  this->scene.set_motion(first, this->scene.motion(pattern));
  EXPECT_EQ(this->scene.pose(first).translation, at_height<TypeParam>(3).translation);
}

}  // namespace
}  // namespace surehit::test::scene_ids_test
