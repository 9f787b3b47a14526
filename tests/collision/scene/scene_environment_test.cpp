#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "support/floating_point_mode.hpp"
#include "support/scalars.hpp"
#include "unit_scenes.hpp"

namespace surehit::test::scene_environment_test {
namespace {

/// Bytes of what a scene answers, whose poses and motions underflow, cancel and tie.
template <typename Scalar>
class SceneEnvironment : public testing::Test {
 protected:
  SceneEnvironment() {
    using Limits = std::numeric_limits<Scalar>;
    const Scalar tiny = Limits::denorm_min();
    const Scalar third = Scalar{1} / 3;
    mesh_ = stack_of_triangles<Scalar>(4);
    mesh_.add({{-1, -1, Limits::min()}, {1, -1, Limits::min()}, {0, 1, 3 * tiny}});
    mesh_.add({{-1, Scalar(0.1), 0}, {1, Scalar(0.1), 0}, {0, Scalar(0.1), Scalar(0.3)}});
    segments_ = {
        {{third, third / 7, -1}, {third / 3, third, 5}},         {{tiny, 2 * tiny, 1}, {2 * tiny, tiny, -1}},
        {{tiny, tiny, -3 * tiny}, {tiny, tiny, 4 * tiny}},       {{-1, third, 2}, {2, third / 5, 2}},
        {{third / 5, third / 9, 9}, {third / 7, third / 3, -9}}, {{0, 0, Limits::min()}, {tiny, Limits::min(), -tiny}}};
    for (const auto& [start, end] : segments_) {
      balls_.push_back({start, end, Scalar(0.1)});
      if (balls_.size() % 2 == 0) continue;
      boxes_.push_back({start, end, {tiny, Scalar(0.1), third}});
      capsules_.push_back({start, end, {third, -tiny, Scalar(0.1)}, third / 7});
    }
  }

  [[nodiscard]] std::vector<std::uint8_t> build_and_ask() {
    const Scalar tiny = std::numeric_limits<Scalar>::denorm_min();
    const Scalar third = Scalar{1} / 3;
    bytes_.clear();
    const auto collider = std::make_shared<Collider<Scalar>>();
    add(!collider->try_build(mesh_.view()).has_value());
    Scene<Scalar> scene;
    std::vector<InstanceId> ids;
    ids.push_back(scene.try_add(collider).id());
    ids.push_back(scene.try_add(collider, Pose<Scalar>::translated({0, 0, tiny})).id());
    ids.push_back(scene.try_add(collider, Pose<Scalar>::rigid({third, 2 * third, -2 * third, 0}, {0, tiny, 1})).id());
    auto sheared = with_rows<Scalar>({1, third, 0}, {0, -third, third}, {Scalar(0.1), 0, 1});
    sheared.translation = {third, tiny, -third};
    ids.push_back(scene.try_add(collider, sheared).id());
    scene.commit();
    ask(scene, ids);
    // The motion is seen even if it is the least one that there is.
    add(scene.try_set_motion(ids[0], {0, 0, tiny}).has_value());
    add(scene.try_set_motion(ids[2], {third, -tiny, 1}).has_value());
    add(scene.try_set_pose(ids[1], Pose<Scalar>::translated({tiny, third, 2})).has_value());
    scene.commit();
    ask(scene, ids);
    return bytes_;
  }

 private:
  template <typename Number>
  void add(const Number& number) {
    const std::size_t size = bytes_.size();
    bytes_.resize(size + sizeof number);
    std::memcpy(bytes_.data() + size, &number, sizeof number);
  }
  void add(const Vector3<Scalar>& vector) {
    for (int axis = 0; axis < 3; ++axis) add(vector[axis]);
  }
  void add(const SceneHit<Scalar>& hit) {
    add(hit.t);
    add(hit.u);
    add(hit.v);
    add(hit.triangle);
    add(hit.side);
    add(hit.instance.index);
  }
  void add(const SceneShapeHit<Scalar>& hit) {
    add(hit.t);
    add(hit.u);
    add(hit.v);
    add(hit.triangle);
    add(hit.feature);
    add(hit.started_touching);
    add(hit.instance.index);
  }

  void ask(const Scene<Scalar>& scene, const std::vector<InstanceId>& ids) {
    add(scene.box().low);
    add(scene.box().high);
    for (const InstanceId id : ids) {
      for (std::uint32_t i = 0; i < scene.triangle_count(id); ++i) {
        const Triangle<Scalar> triangle = scene.triangle(id, i);
        add(triangle.a);
        add(triangle.b);
        add(triangle.c);
        add(scene.normal(id, i));
      }
    }
    for (const Segment<Scalar>& segment : segments_) {
      ask_path(scene, segment);
      ask_path(scene, Ray<Scalar>{segment.start, segment.end});
      ask_path(scene, Line<Scalar>{segment.end, segment.start});
      if (const auto hit = scene.first_hit(segment)) add(scene.last_free_point(segment, *hit));
    }
    ask_shapes(scene, balls_);
    ask_shapes(scene, boxes_);
    ask_shapes(scene, capsules_);
    std::vector<SceneHit<Scalar>> hits(segments_.size());
    std::vector<std::uint8_t> blocked(segments_.size());
    scene.first_hits(segments_, hits);
    scene.any_hits(segments_, blocked);
    for (const auto& hit : hits) add(hit);
    bytes_.insert(bytes_.end(), blocked.begin(), blocked.end());
  }

  void ask_path(const Scene<Scalar>& scene, const Path<Scalar>& path) {
    add(scene.first_hit(path).value_or(SceneHit<Scalar>{}));
    add(scene.any_hit(path));
    std::vector<SceneHit<Scalar>> hits;
    scene.all_hits(path, hits);
    for (const auto& hit : hits) add(hit);
  }

  template <typename Shape>
  void ask_shapes(const Scene<Scalar>& scene, const std::vector<Shape>& shapes) {
    for (const Shape& shape : shapes) {
      const auto hit = scene.first_hit(shape);
      add(hit.value_or(SceneShapeHit<Scalar>{}));
      add(scene.any_hit(shape));
      add(scene.overlaps(shape));
      std::vector<SceneShapeHit<Scalar>> all;
      scene.all_hits(shape, all);
      for (const auto& one : all) add(one);
      if (!hit) continue;
      add(scene.last_free_t(shape, *hit));
      add(scene.last_free_point(shape, *hit));
      add(scene.contact_point(*hit));
      add(scene.contact_normal(shape, *hit));
    }
    std::vector<SceneShapeHit<Scalar>> hits(shapes.size());
    std::vector<std::uint8_t> blocked(shapes.size());
    scene.first_hits(shapes, hits);
    scene.any_hits(shapes, blocked);
    for (const auto& hit : hits) add(hit);
    bytes_.insert(bytes_.end(), blocked.begin(), blocked.end());
  }

  GeneratedMesh<Scalar> mesh_;
  std::vector<Segment<Scalar>> segments_;
  std::vector<SweptSphere<Scalar>> balls_;
  std::vector<SweptBox<Scalar>> boxes_;
  std::vector<SweptCapsule<Scalar>> capsules_;
  std::vector<std::uint8_t> bytes_;
};
TYPED_TEST_SUITE(SceneEnvironment, Scalars, ScalarNames);

TYPED_TEST(SceneEnvironment, answers_have_the_same_bits_in_every_mode) {
  const std::vector<std::uint8_t> expected = this->build_and_ask();
  for (const FloatingPointMode& mode : floating_point_modes) {
    std::vector<std::uint8_t> answers;
    {
      const FloatingPointModeScope scope(mode);
      answers = this->build_and_ask();
    }
    EXPECT_EQ(answers, expected) << mode.name;
  }
}

TYPED_TEST(SceneEnvironment, least_motion_is_seen_in_every_mode) {
  const TypeParam tiny = std::numeric_limits<TypeParam>::denorm_min();
  const auto floor = stack_collider<TypeParam>(1);
  for (const FloatingPointMode& mode : floating_point_modes) {
    Scene<TypeParam> scene;
    const InstanceId id = scene.add(floor);
    scene.commit();
    {
      const FloatingPointModeScope scope(mode);
      ASSERT_TRUE(scene.try_set_motion(id, {0, 0, tiny}));
      scene.commit();
    }
    // The floor comes from below. It reaches this height at t = 1.
    const Vector3<TypeParam> at{TypeParam{0.25}, TypeParam{0.25}, tiny};
    const auto hit = scene.first_hit(Segment<TypeParam>{at, at});
    ASSERT_TRUE(hit) << mode.name;
    EXPECT_EQ(hit->t, TypeParam{1}) << mode.name;
  }
}

#if defined(__SSE2__)

TYPED_TEST(SceneEnvironment, unmasked_exceptions_do_not_trap) {
  const std::vector<std::uint8_t> expected = this->build_and_ask();
  constexpr unsigned all_unmasked = 0;
  const unsigned caller = _mm_getcsr();
  _mm_setcsr(all_unmasked);
  const std::vector<std::uint8_t> answers = this->build_and_ask();
  const unsigned after = _mm_getcsr();
  _mm_setcsr(caller);
  EXPECT_EQ(answers, expected);
  EXPECT_EQ(after, all_unmasked);
}

#endif

}  // namespace
}  // namespace surehit::test::scene_environment_test
