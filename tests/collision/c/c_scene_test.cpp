#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "c_functions.hpp"
#include "c_scene_of.hpp"
#include "c_values.hpp"
#include "support/case_count.hpp"
#include "support/same_bits.hpp"
#include "support/scalars.hpp"
#include "support/scene_drawer.hpp"
#include "support/scene_path_drawer.hpp"
#include "surehit/scene.hpp"

namespace surehit::test::c_scene_test {
namespace {

template <typename Scalar>
class CScene : public testing::Test {
 protected:
  using C = CFunctions<Scalar>;

  static std::int32_t accept(void* user, std::size_t path, const typename C::SceneHit* hit) {
    const auto modulus = *static_cast<const std::uint32_t*>(user);
    return (hit->triangle + hit->instance.index + path) % modulus != 0 ? SUREHIT_ACCEPT : SUREHIT_REJECT;
  }
  static auto filter_of(std::uint32_t modulus) {
    return [modulus](std::size_t path, const SceneHit<Scalar>& hit) {
      return (hit.triangle + hit.instance.index + path) % modulus != 0;
    };
  }

  /// Returns true if there is a hit.
  static bool expect_same(const CSceneOf<Scalar>& c, const Scene<Scalar>& cpp, const Path<Scalar>& path,
                          const SceneQueryOptions<Scalar>& options, std::uint32_t modulus) {
    const auto filter = filter_of(modulus);
    const typename C::SceneFilter c_filter = {accept, &modulus};
    const auto c_path = in_c(path);
    const auto c_options = in_c(options);
    typename C::SceneHit c_hit;
    std::uint8_t blocked = 2;
    std::array<typename C::SceneHit, 300> c_hits;
    std::vector<SceneHit<Scalar>> hits;
    std::size_t count = 0;
    EXPECT_EQ(C::scene_first_hit(c.handle, &c_path, &c_options, &c_filter, nullptr, &c_hit), SUREHIT_OK);
    const auto hit = cpp.first_hit(path, filter, options);
    EXPECT_TRUE(same_bits(in_cpp(c_hit), hit.value_or(SceneHit<Scalar>{})));
    EXPECT_EQ(C::scene_any_hit(c.handle, &c_path, &c_options, &c_filter, nullptr, &blocked), SUREHIT_OK);
    EXPECT_EQ(blocked, hit ? 1 : 0);
    cpp.all_hits(path, hits, filter, options);
    EXPECT_EQ(
        C::scene_all_hits(c.handle, &c_path, &c_options, &c_filter, nullptr, c_hits.data(), c_hits.size(), &count),
        SUREHIT_OK);
    EXPECT_EQ(count, hits.size());
    for (std::size_t i = 0; i < std::min(count, c_hits.size()); ++i) EXPECT_TRUE(same_bits(in_cpp(c_hits[i]), hits[i]));
    if (!hit || path.kind != PathKind::segment) return hit.has_value();
    typename C::Vector point;
    EXPECT_EQ(C::scene_last_free_point(c.handle, &c_path, &c_hit, &c_options, &c_filter, &point), SUREHIT_OK);
    const auto free = cpp.last_free_point({path.start, path.toward}, *hit, filter, options);
    for (Eigen::Index axis = 0; axis < 3; ++axis) EXPECT_TRUE(same_bits(in_cpp(point)[axis], free[axis]));
    return true;
  }

  static void expect_same_batch(const CSceneOf<Scalar>& c, const Scene<Scalar>& cpp,
                                const std::vector<Segment<Scalar>>& segments,
                                const std::vector<SceneQueryOptions<Scalar>>& options) {
    std::vector<typename C::SceneOptions> c_options;
    for (const auto& own : options) c_options.push_back(in_c(own));
    std::uint32_t modulus = 4;
    const typename C::SceneFilter c_filter = {accept, &modulus};
    const typename C::SceneBatchOptions batch = {sizeof batch, nullptr, c_options.data(), &c_filter, nullptr, nullptr};
    const typename C::Paths paths = {segments[0].start.data(), nullptr, segments.size(), 0, 0, SUREHIT_SEGMENT};
    std::vector<typename C::SceneHit> c_hits(segments.size());
    std::vector<SceneHit<Scalar>> hits(segments.size());
    std::vector<std::uint8_t> blocked(segments.size(), 2);
    EXPECT_EQ(C::scene_first_hits(c.handle, &paths, &batch, c_hits.data()), SUREHIT_OK) << surehit_last_error();
    EXPECT_EQ(C::scene_any_hits(c.handle, &paths, &batch, blocked.data()), SUREHIT_OK);
    cpp.first_hits(segments, hits, {.path_options = options, .filter = filter_of(modulus)});
    for (std::size_t i = 0; i < hits.size(); ++i) {
      EXPECT_TRUE(same_bits(in_cpp(c_hits[i]), hits[i]));
      EXPECT_EQ(blocked[i], hits[i].triangle != no_triangle ? 1 : 0);
    }
  }

  static void expect_same_instance(const CSceneOf<Scalar>& c, const Scene<Scalar>& cpp, std::size_t i, InstanceId id) {
    ASSERT_EQ(c.ids[i].index, id.index);
    ASSERT_EQ(c.ids[i].generation, id.generation);
    std::size_t count = 0;
    std::uint64_t user_data = 0;
    typename C::Pose pose;
    typename C::Vector vector;
    typename C::Triangle corners;
    EXPECT_EQ(C::user_data(c.handle, c.ids[i], &user_data), SUREHIT_OK);
    EXPECT_EQ(user_data, i);
    EXPECT_EQ(C::pose(c.handle, c.ids[i], &pose), SUREHIT_OK);
    EXPECT_EQ(in_cpp(pose.y_axis), cpp.pose(id).linear.col(1));
    EXPECT_EQ(C::motion(c.handle, c.ids[i], &vector), SUREHIT_OK);
    EXPECT_EQ(in_cpp(vector), cpp.motion(id));
    ASSERT_EQ(C::instance_triangle_count(c.handle, c.ids[i], &count), SUREHIT_OK);
    ASSERT_EQ(count, cpp.triangle_count(id));
    if (count == 0) return;
    EXPECT_EQ(C::placed_triangle(c.handle, c.ids[i], 0, &corners), SUREHIT_OK);
    EXPECT_EQ(in_cpp(corners.c), cpp.triangle(id, 0).c);
    EXPECT_EQ(C::placed_normal(c.handle, c.ids[i], 0, &vector), SUREHIT_OK);
    EXPECT_EQ(in_cpp(vector), cpp.normal(id, 0));
    EXPECT_EQ(C::placed_normal(c.handle, c.ids[i], static_cast<std::uint32_t>(count), &vector), SUREHIT_OUT_OF_RANGE);
  }
};
TYPED_TEST_SUITE(CScene, Scalars, ScalarNames);

TYPED_TEST(CScene, answers_have_the_bits_of_cpp) {
  using C = CFunctions<TypeParam>;
  std::size_t hits = 0;
  for (const SceneFamily family : all_scene_families) {
    Random random(static_cast<std::uint64_t>(family));
    for (std::size_t i = case_count(8); i > 0; --i) {
      const auto drawn = draw_scene<TypeParam>(family, random);
      const JudgedScene<TypeParam> judged(drawn);
      const CSceneOf<TypeParam> c(drawn);
      ScenePathDrawer<TypeParam> drawer(drawn, judged.oracle, judged.ids, random);
      std::vector<Segment<TypeParam>> segments;
      std::vector<SceneQueryOptions<TypeParam>> options;
      for (int j = 0; j < 30; ++j) {
        const Path<TypeParam> path = drawer.draw();
        const auto hit = judged.scene.first_hit(path);
        options.push_back(hit ? draw_scene_options(*hit, random) : SceneQueryOptions<TypeParam>{});
        segments.push_back({path.start, path.toward});
        hits += this->expect_same(c, judged.scene, path, {}, 5) ? 1 : 0;
        this->expect_same(c, judged.scene, path, options.back(), 3);
      }
      this->expect_same_batch(c, judged.scene, segments, options);
      for (std::size_t j = 0; j < judged.ids.size(); ++j) this->expect_same_instance(c, judged.scene, j, judged.ids[j]);
      typename C::Box box;
      ASSERT_EQ(C::scene_box(c.handle, &box), SUREHIT_OK);
      EXPECT_EQ(in_cpp(box.low), judged.scene.box().low);
      EXPECT_EQ(in_cpp(box.high), judged.scene.box().high);
      ASSERT_FALSE(testing::Test::HasFailure()) << name_of(family);
    }
  }
  EXPECT_GT(hits, 10U);
}

// It is asked after all instances were removed from its scene.
TYPED_TEST(CScene, snapshots_answer_as_their_scene_did) {
  using C = CFunctions<TypeParam>;
  std::size_t hits = 0;
  for (const SceneFamily family : all_scene_families) {
    Random random(static_cast<std::uint64_t>(family));
    const auto drawn = draw_scene<TypeParam>(family, random);
    const JudgedScene<TypeParam> judged(drawn);
    CSceneOf<TypeParam> c(drawn);
    typename C::SceneHandle* const scene = c.handle;
    typename C::SceneHandle* first = nullptr;
    ASSERT_EQ(C::snapshot(scene, &first), SUREHIT_OK);
    ASSERT_EQ(C::snapshot(first, &c.handle), SUREHIT_OK);
    ASSERT_EQ(C::destroy_scene(first), SUREHIT_OK);
    for (const surehit_instance_id id : c.ids) ASSERT_EQ(C::remove(scene, id), SUREHIT_OK);
    ASSERT_EQ(C::commit(scene, nullptr), SUREHIT_OK);
    ScenePathDrawer<TypeParam> drawer(drawn, judged.oracle, judged.ids, random);
    std::vector<Segment<TypeParam>> segments;
    for (int j = 0; j < 10; ++j) {
      const Path<TypeParam> path = drawer.draw();
      segments.push_back({path.start, path.toward});
      hits += this->expect_same(c, judged.scene, path, {}, 5) ? 1 : 0;
    }
    this->expect_same_batch(c, judged.scene, segments, {segments.size(), SceneQueryOptions<TypeParam>{}});
    for (std::size_t j = 0; j < judged.ids.size(); ++j) this->expect_same_instance(c, judged.scene, j, judged.ids[j]);
    ASSERT_EQ(C::destroy_scene(c.handle), SUREHIT_OK);
    c.handle = scene;
    ASSERT_FALSE(testing::Test::HasFailure()) << name_of(family);
  }
  EXPECT_GT(hits, 10U);
}

TYPED_TEST(CScene, snapshots_cannot_be_changed) {
  using C = CFunctions<TypeParam>;
  typename C::SceneHandle* scene = nullptr;
  typename C::SceneHandle* snapshot = nullptr;
  typename C::ColliderHandle* collider = nullptr;
  ASSERT_EQ(C::create_scene(&scene), SUREHIT_OK);
  ASSERT_EQ(C::create(nullptr, nullptr, &collider), SUREHIT_OK);
  surehit_instance_id id = {};
  ASSERT_EQ(C::add(scene, collider, nullptr, 1, 0, &id), SUREHIT_OK);
  EXPECT_EQ(C::snapshot(scene, nullptr), SUREHIT_NULL_POINTER);
  EXPECT_EQ(C::snapshot(nullptr, &snapshot), SUREHIT_NULL_POINTER);
  ASSERT_EQ(C::snapshot(scene, &snapshot), SUREHIT_OK);
  std::size_t count = 1;
  std::uint8_t is_there = 1;
  EXPECT_EQ(C::instance_count(snapshot, &count), SUREHIT_OK);
  EXPECT_EQ(count, 0U);  // It was not committed.
  EXPECT_EQ(C::contains(snapshot, id, &is_there), SUREHIT_OK);
  EXPECT_EQ(is_there, 0);
  ASSERT_EQ(C::destroy_scene(snapshot), SUREHIT_OK);
  ASSERT_EQ(C::commit(scene, nullptr), SUREHIT_OK);
  ASSERT_EQ(C::snapshot(scene, &snapshot), SUREHIT_OK);
  EXPECT_EQ(C::destroy_scene(scene), SUREHIT_OK);
  surehit_instance_id all = {7, 7};
  EXPECT_EQ(C::instances(snapshot, &all, 1, &count), SUREHIT_OK);
  EXPECT_EQ(count, 1U);
  EXPECT_EQ(all.index, id.index);
  const auto pose = C::identity();
  const typename C::Vector motion = {0, 0, 0};
  for (const surehit_status status :
       {C::add(snapshot, collider, nullptr, 1, 0, &id), C::remove(snapshot, id), C::set_pose(snapshot, id, &pose),
        C::set_collider(snapshot, id, collider), C::set_motion(snapshot, id, &motion),
        C::set_instance_mask(snapshot, id, 1), C::commit(snapshot, nullptr), C::scene_memory_bytes(snapshot, &count)}) {
    EXPECT_EQ(status, SUREHIT_INVALID_HANDLE);
  }
  EXPECT_EQ(C::destroy(collider), SUREHIT_OK);
  EXPECT_EQ(C::destroy_scene(snapshot), SUREHIT_OK);
  EXPECT_EQ(C::destroy_scene(snapshot), SUREHIT_INVALID_HANDLE);
}

TYPED_TEST(CScene, refuses_what_cpp_refuses) {
  using C = CFunctions<TypeParam>;
  typename C::SceneHandle* scene = nullptr;
  typename C::ColliderHandle* collider = nullptr;
  ASSERT_EQ(C::create_scene(&scene), SUREHIT_OK);
  ASSERT_EQ(C::create(nullptr, nullptr, &collider), SUREHIT_OK);
  surehit_instance_id id = {};
  EXPECT_EQ(C::add(scene, nullptr, nullptr, 1, 0, &id), SUREHIT_NULL_POINTER);
  EXPECT_EQ(C::add(scene, collider, nullptr, 1, 0, nullptr), SUREHIT_NULL_POINTER);
  EXPECT_EQ(C::create_scene(nullptr), SUREHIT_NULL_POINTER);

  // Element i of a pose is the number at place i of its struct.
  for (std::size_t i = 0; i < 12; ++i) {
    auto pose = C::identity();
    TypeParam* const numbers = &pose.x_axis.x;
    numbers[i] = std::numeric_limits<TypeParam>::infinity();
    EXPECT_EQ(C::add(scene, collider, &pose, 1, 0, &id), SUREHIT_NON_FINITE_POSE);
    EXPECT_EQ(surehit_last_error_element(), i);
  }
  auto pose = C::identity();
  ASSERT_EQ(C::add(scene, collider, &pose, 1, 0, &id), SUREHIT_OK);
  pose.z_axis.x = TypeParam(0x1p65);
  EXPECT_EQ(C::set_pose(scene, id, &pose), SUREHIT_POSE_OUT_OF_RANGE);
  EXPECT_EQ(surehit_last_error_element(), 6U);
  pose.z_axis = {0, 0, 0};
  EXPECT_EQ(C::set_pose(scene, id, &pose), SUREHIT_SINGULAR_POSE);
  EXPECT_EQ(C::set_pose(scene, id, nullptr), SUREHIT_NULL_POINTER);
  typename C::Vector motion = {0, std::numeric_limits<TypeParam>::quiet_NaN(), 0};
  EXPECT_EQ(C::set_motion(scene, id, &motion), SUREHIT_NON_FINITE_MOTION);
  EXPECT_EQ(surehit_last_error_element(), 1U);
  EXPECT_EQ(C::set_motion(scene, id, nullptr), SUREHIT_NULL_POINTER);
  EXPECT_EQ(C::set_collider(scene, id, nullptr), SUREHIT_NULL_POINTER);
  EXPECT_EQ(C::set_collider(scene, id, collider), SUREHIT_OK);

  ASSERT_EQ(C::remove(scene, id), SUREHIT_OK);
  std::uint32_t mask = 0;
  for (const surehit_status status :
       {C::remove(scene, id), C::set_pose(scene, id, &pose), C::set_instance_mask(scene, id, 1),
        C::set_collider(scene, id, collider), C::instance_mask(scene, id, &mask), C::pose(scene, id, &pose),
        C::motion(scene, id, &motion), C::placed_normal(scene, {7, 0}, 0, &motion)}) {
    EXPECT_EQ(status, SUREHIT_STALE_ID);
  }
  EXPECT_EQ(surehit_last_error_element(), 7U);
  EXPECT_EQ(C::destroy(collider), SUREHIT_OK);
  EXPECT_EQ(C::commit(scene, nullptr), SUREHIT_OK);
  EXPECT_EQ(C::destroy_scene(scene), SUREHIT_OK);
  EXPECT_EQ(C::commit(scene, nullptr), SUREHIT_INVALID_HANDLE);
}

TYPED_TEST(CScene, poses_are_those_of_cpp) {
  using C = CFunctions<TypeParam>;
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    const std::array<TypeParam, 4> q = {random.symmetric<TypeParam>(), random.symmetric<TypeParam>(),
                                        random.symmetric<TypeParam>(), random.symmetric<TypeParam>()};
    const auto expected = Pose<TypeParam>::rigid(q, {1, 2, 3});
    const auto pose = C::rigid(q[0], q[1], q[2], q[3], {1, 2, 3});
    EXPECT_EQ(in_cpp(pose.x_axis), expected.linear.col(0));
    EXPECT_EQ(in_cpp(pose.y_axis), expected.linear.col(1));
    EXPECT_EQ(in_cpp(pose.z_axis), expected.linear.col(2));
    EXPECT_EQ(in_cpp(pose.translation), expected.translation);
  }
}

}  // namespace
}  // namespace surehit::test::c_scene_test
