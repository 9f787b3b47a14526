#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "support/case_count.hpp"
#include "support/pair_text.hpp"
#include "support/same_bits.hpp"
#include "support/saved_file.hpp"
#include "support/scalars.hpp"
#include "support/scene_drawer.hpp"
#include "support/scene_path_drawer.hpp"

namespace surehit::test::scene_file_test {
namespace {

using Reason = InvalidFile::Reason;

template <typename Scalar>
class SceneFile : public testing::Test {
 protected:
  /// Two instances of one collider, one of another, one removed, and one removed but not committed.
  static Scene<Scalar> some_scene() {
    Random random(101);
    const auto ground = collider_of<Scalar>(ground_piece(3, true, random));
    Scene<Scalar> scene;
    scene.add(ground, Pose<Scalar>::translated({1, 2, 3}), {.mask = 5, .user_data = 7});
    const InstanceId removed = scene.add(ground);
    const InstanceId moving = scene.add(collider_of<Scalar>(ground_piece(2, true, random)));
    const InstanceId forgotten = scene.add(ground);
    scene.add(ground, draw_pose<Scalar>(SceneFamily::rotations, random));
    scene.set_motion(moving, {0, 1, Scalar{0.5}});
    scene.remove(removed);
    scene.commit();
    scene.remove(forgotten);
    return scene;
  }

  static void expect_refused(Bytes bytes, Reason reason, std::size_t offset) {
    repair(bytes);
    Scene<Scalar> scene;
    const LoadResult result = scene.try_load(bytes);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().reason, reason) << result.error().what();
    EXPECT_EQ(result.error().offset, offset) << result.error().what();
    EXPECT_EQ(scene.instance_count(), 0U);
  }
};
TYPED_TEST_SUITE(SceneFile, Scalars, ScalarNames);

TYPED_TEST(SceneFile, answers_as_what_was_saved) {
  Random random(103);
  std::size_t hits = 0;
  for (std::size_t i = 0; i < case_count(10 * all_scene_families.size()); ++i) {
    const DrawnScene<TypeParam> drawn =
        draw_scene<TypeParam>(all_scene_families[i % all_scene_families.size()], random);
    const JudgedScene<TypeParam> judged(drawn);
    const Bytes bytes = saved(judged.scene);
    const Scene<TypeParam> loaded = Scene<TypeParam>::load(bytes);
    EXPECT_EQ(saved(loaded), bytes);
    ASSERT_EQ(loaded.instances(), judged.scene.instances());
    ScenePathDrawer<TypeParam> drawer(drawn, judged.oracle, judged.ids, random);
    for (int path = 0; path < 20; ++path) {
      const Path<TypeParam> asked = drawer.draw();
      const auto hit = loaded.first_hit(asked);
      const auto expected = judged.scene.first_hit(asked);
      ASSERT_EQ(hit.has_value(), expected.has_value());
      if (!hit) continue;
      EXPECT_TRUE(same_bits(*hit, *expected));
      ++hits;
    }
  }
  EXPECT_GT(hits, case_count(200));
}

TYPED_TEST(SceneFile, keeps_ids_and_what_instances_have) {
  Scene<TypeParam> scene = this->some_scene();
  const Bytes bytes = saved(scene);
  Scene<TypeParam> loaded = Scene<TypeParam>::load(bytes);
  ASSERT_EQ(loaded.instances(), scene.instances());
  for (const InstanceId id : scene.instances()) {
    EXPECT_EQ(loaded.pose(id).linear, scene.pose(id).linear);
    EXPECT_EQ(loaded.pose(id).translation, scene.pose(id).translation);
    EXPECT_EQ(loaded.motion(id), scene.motion(id));
    EXPECT_EQ(loaded.mask(id), scene.mask(id));
    EXPECT_EQ(loaded.user_data(id), scene.user_data(id));
  }
  EXPECT_FALSE(loaded.contains({1, 0}));
  scene.commit();
  EXPECT_EQ(saved(scene), bytes);
  const auto collider = std::make_shared<const Collider<TypeParam>>();
  for (int i = 0; i < 4; ++i) EXPECT_EQ(loaded.add(collider), scene.add(collider));
}

TYPED_TEST(SceneFile, holds_each_collider_once) {
  const Bytes bytes = saved(this->some_scene());
  EXPECT_EQ(number_at<std::uint32_t>(bytes, 24), 2U);
  EXPECT_EQ(number_at<std::uint32_t>(bytes, 28), 5U);
  EXPECT_EQ(number_at<std::uint32_t>(bytes, 32), 2U);
}

TYPED_TEST(SceneFile, empty_scene_is_loaded) {
  const Bytes bytes = saved(Scene<TypeParam>());
  EXPECT_EQ(bytes.size(), 44U);
  EXPECT_EQ(Scene<TypeParam>::load(bytes).instance_count(), 0U);
}

TYPED_TEST(SceneFile, failed_load_changes_nothing) {
  Scene<TypeParam> scene = this->some_scene();
  const Bytes bytes = saved(scene);
  Bytes damaged = bytes;
  damaged[40] ^= std::byte{1};
  EXPECT_FALSE(scene.try_load(damaged));
  EXPECT_THROW(static_cast<void>(Scene<TypeParam>::load(damaged)), InvalidFile);
  EXPECT_EQ(saved(scene), bytes);
  const LoadResult of_collider = Collider<TypeParam>().try_load(bytes);
  ASSERT_FALSE(of_collider);
  EXPECT_EQ(of_collider.error().reason, Reason::wrong_kind);
}

TYPED_TEST(SceneFile, missing_and_damaged_bytes_are_found) {
  Bytes bytes = saved(this->some_scene());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    Bytes shorter(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    ASSERT_FALSE(Scene<TypeParam>().try_load(shorter)) << size;
    repair(shorter);
    ASSERT_FALSE(Scene<TypeParam>().try_load(shorter)) << size;
  }
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    bytes[at] ^= std::byte{16};
    ASSERT_FALSE(Scene<TypeParam>().try_load(bytes)) << at;
    bytes[at] ^= std::byte{16};
  }
}

TYPED_TEST(SceneFile, forged_instances_are_found) {
  const Bytes bytes = saved(this->some_scene());
  constexpr std::size_t width = 20 + 15 * sizeof(TypeParam);
  const std::size_t unused = bytes.size() - 8 - 2 * 4;
  const std::size_t instances = unused - 5 * width;
  const auto refuse = [&](std::size_t at, auto number, std::size_t offset) {
    SCOPED_TRACE(at);
    Bytes forged = bytes;
    set_number(forged, at, number);
    this->expect_refused(forged, Reason::invalid_instance, offset);
  };
  refuse(instances, std::uint32_t{2}, instances);               // There is no such collider.
  refuse(instances + 2 * width, std::uint32_t{0}, unused + 8);  // No instance has the other collider.
  refuse(instances, ~std::uint32_t{0}, unused + 8);             // The index is lost.
  refuse(instances + 4, ~std::uint32_t{0}, instances);          // Only a free index has the last generation.
  refuse(instances + 20, std::numeric_limits<TypeParam>::quiet_NaN(), instances);
  refuse(instances + 20, TypeParam{0}, instances);  // The pose is singular.
  refuse(instances + 20 + 14 * sizeof(TypeParam), std::numeric_limits<TypeParam>::infinity(), instances);
  refuse(unused, std::uint32_t{0}, unused);  // In use.
  refuse(unused, std::uint32_t{5}, unused);
  refuse(unused + 4, number_at<std::uint32_t>(bytes, unused), unused + 4);  // Twice.
  for (const std::size_t at : {24U, 28U, 32U}) {
    for (const std::uint32_t count : {0U, 1U, 6U, ~0U}) {
      Bytes forged = bytes;
      set_number(forged, at, count);
      repair(forged);
      EXPECT_FALSE(Scene<TypeParam>().try_load(forged)) << at << ", " << count;
    }
  }
}

/// The collider is found to be wrong where it is in the scene's file.
TYPED_TEST(SceneFile, forged_colliders_are_found) {
  const Bytes bytes = saved(this->some_scene());
  constexpr std::size_t collider = 44;
  const auto size = static_cast<std::size_t>(number_at<std::uint64_t>(bytes, collider - 8));
  Bytes forged = bytes;
  forged[collider + 30] ^= std::byte{1};
  this->expect_refused(forged, Reason::wrong_checksum, collider + size - 8);
  forged = bytes;
  set_number(forged, collider - 8, ~std::uint64_t{0});
  this->expect_refused(forged, Reason::wrong_counts, collider - 8);
}

}  // namespace
}  // namespace surehit::test::scene_file_test
