#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "collider_state.hpp"
#include "collision/in_levels.hpp"
#include "collision/painted_stack.hpp"
#include "support/case_count.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/random.hpp"
#include "support/scalars.hpp"
#include "support/sphere_families.hpp"
#include "surehit/intersect.hpp"
#include "unit_scenes.hpp"

#if defined(SUREHIT_TEST_PROMISES_STACK)

namespace surehit::test::scene_stack_test {
namespace {

constexpr std::size_t promised_bytes = 64 * 1024;

/// Scenes whose numbers are as long as they get: the least and the largest in one pair, and in one pose.
template <typename Scalar>
class SceneStack : public testing::Test {
 protected:
  using Limits = std::numeric_limits<Scalar>;
  static constexpr Scalar tiny = Limits::denorm_min();
  static constexpr Scalar huge = Limits::max();

  SceneStack() {
    const Vector3<Scalar> long_vector{huge, tiny, -huge / 3};
    GeneratedMesh<Scalar> mesh;
    mesh.add({{-huge, -huge, tiny}, {huge, -huge, tiny}, {tiny, huge, tiny}});
    mesh.add({{-huge, -huge, -huge}, {huge, tiny, huge}, {tiny, huge, huge / 3}});
    mesh.add({{-huge, tiny, tiny}, {tiny, tiny, tiny}, {huge, tiny, tiny}});
    mesh.add({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const auto collider = std::make_shared<Collider<Scalar>>(mesh.view());
    auto wide = with_rows<Scalar>({Scalar(0x1p64F), Scalar(0x1p-64F), Scalar(0.3)},
                                  {Scalar(-0x1p-64F), Scalar(0.7), Scalar(0x1p64F)},
                                  {Scalar(0.1), Scalar(-0x1p64F), Scalar(0x1.fp-64F)});
    for (const Pose<Scalar>& pose : {Pose<Scalar>{}, Pose<Scalar>::translated(long_vector), wide}) {
      scene_.add(collider, pose);
      scene_.set_motion(scene_.add(collider, pose), {tiny, huge, 1});
    }
    wide.translation = long_vector;
    scene_.set_motion(scene_.add(collider, wide), long_vector);
    scene_.commit();
  }

  static std::vector<Segment<Scalar>> segments() {
    const Vector3<Scalar> middle{tiny, tiny, tiny};
    return {{{huge / 3, huge / 5, huge}, {-huge / 7, tiny, -huge}},
            {{-huge, huge / 3, tiny}, {huge, -huge / 5, tiny}},
            {middle, middle},
            {{-huge, tiny, tiny}, {huge, tiny, tiny}},
            {{Scalar(0.25), Scalar(0.25), 1}, {Scalar(0.25), Scalar(0.25), -1}},
            {{0, 0, 0}, {1, 1, 0}}};
  }

  void expect_within_promise(const std::string& name, const std::function<void()>& call) {
    const std::size_t bytes = stack_.bytes_used_by(call);
    testing::Test::RecordProperty(name, std::to_string(bytes));
    EXPECT_LT(bytes, promised_bytes) << name;
  }

  Scene<Scalar> scene_;

 private:
  PaintedStack stack_;
};
TYPED_TEST_SUITE(SceneStack, Scalars, ScalarNames);

TYPED_TEST(SceneStack, of_single_queries) {
  const auto odd = [](const SceneHit<TypeParam>& hit) { return hit.instance.index % 2 == 1; };
  int number = 0;
  for (const auto& segment : this->segments()) {
    for (const Path<TypeParam>& path : std::vector<Path<TypeParam>>{segment, Ray<TypeParam>{segment.start, segment.end},
                                                                    Line<TypeParam>{segment.start, segment.end}}) {
      const std::string name = std::to_string(number++);
      const auto& scene = this->scene_;
      this->expect_within_promise("first_" + name, [&] { static_cast<void>(scene.first_hit(path)); });
      this->expect_within_promise("first_odd_" + name, [&] { static_cast<void>(scene.first_hit(path, odd)); });
      this->expect_within_promise("any_" + name, [&] { static_cast<void>(scene.any_hit(path, odd)); });
    }
    for (const TypeParam t : {TypeParam(0.5), TypeParam(0x1p-60F)}) {
      this->expect_within_promise("last_free_point_" + std::to_string(number++), [&] {
        static_cast<void>(this->scene_.last_free_point(segment, SceneHit<TypeParam>{{.t = t, .triangle = 0}, {0, 0}}));
      });
    }
  }
}

TYPED_TEST(SceneStack, of_batches) {
  const auto segments = this->segments();
  std::vector<SceneHit<TypeParam>> hits(segments.size());
  std::vector<std::uint8_t> blocked(segments.size());
  this->expect_within_promise("first_hits", [&] { this->scene_.first_hits(segments, hits); });
  this->expect_within_promise("any_hits", [&] { this->scene_.any_hits(segments, blocked); });
  // A scene with one instance has batches of its own.
  Random random(5);
  const auto ground = rough_ground<TypeParam>(24, TypeParam(0.25), random);
  Scene<TypeParam> one;
  one.add(std::make_shared<Collider<TypeParam>>(ground.view()));
  one.commit();
  std::vector<Segment<TypeParam>> edges;
  for (std::size_t i = 0; i < 100; ++i) edges.push_back({{0, 0, 1}, ground.vertices[i]});
  std::vector<SceneHit<TypeParam>> edge_hits(edges.size());
  std::vector<std::uint8_t> edges_blocked(edges.size());
  this->expect_within_promise("first_hits_of_one", [&] { one.first_hits(edges, edge_hits); });
  this->expect_within_promise("any_hits_of_one", [&] { one.any_hits(edges, edges_blocked); });
  // Each instance has a box in front of all larger ones. So paths leave more boxes for later than a batch has room for.
  GeneratedMesh<TypeParam> crossing;
  crossing.add({{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}});
  const auto collider = std::make_shared<Collider<TypeParam>>(crossing.view());
  for (int i = 0; i < 120; ++i) {
    const auto size = static_cast<TypeParam>(std::exp2(i / 2.0));
    Pose<TypeParam> pose = Pose<TypeParam>::translated({TypeParam(1.25) * size, 0, 0});
    pose.linear *= size / 8;
    this->scene_.add(collider, pose);
  }
  this->scene_.commit();
  const std::vector<Segment<TypeParam>> along(20, {{0, 0, 0}, {static_cast<TypeParam>(0x1p62), 0, 0}});
  hits.resize(along.size());
  blocked.resize(along.size());
  this->expect_within_promise("first_hits_of_many", [&] { this->scene_.first_hits(along, hits); });
  this->expect_within_promise("any_hits_of_many", [&] { this->scene_.any_hits(along, blocked); });
}

/// The integers of moving shapes are longer, since their coefficients have a degree of six.
template <typename Scalar>
constexpr std::size_t promised_bytes_of_shapes = (sizeof(Scalar) == 4 ? 64 : 320) * 1024;

/// The longest integers are those of hits that are certain of nothing: twice the same triangles, at sizes of all kinds.
TYPED_TEST(SceneStack, of_moving_shapes) {
  using Scalar = TypeParam;
  PaintedStack stack;
  std::size_t deepest = 0;
  const auto measure = [&](const auto& call) { deepest = std::max(deepest, stack.bytes_used_by(call)); };
  const auto measure_all = [&](const Scene<Scalar>& scene, const SweptShape<Scalar>& shape) {
    std::vector<SceneShapeHit<Scalar>> hits(1);
    measure([&] { static_cast<void>(scene.first_hit(shape)); });
    measure([&] { static_cast<void>(scene.any_hit(shape, {.max_t = Scalar(0.5), .culling = Culling::back})); });
    measure([&] { scene.all_hits(shape, hits); });
    std::vector<SceneShapeHit<Scalar>> first(1);
    std::vector<std::uint8_t> blocked(1);
    const auto ask_batch = [&](const auto& one) {
      measure([&] { scene.first_hits(std::span(&one, 1), first); });
      measure([&] { scene.any_hits(std::span(&one, 1), blocked); });
    };
    std::visit(ask_batch, shape);
    if (hits.empty()) return;
    measure([&] { static_cast<void>(scene.last_free_t(shape, hits.back())); });
    measure([&] { static_cast<void>(scene.last_free_point(shape, hits.front())); });
  };
  for (const auto& [start, end] : this->segments()) {
    for (const Scalar size : {this->huge / 3, Scalar(0.25), this->tiny, Scalar(0)}) {
      measure_all(this->scene_, SweptSphere<Scalar>{start, end, size});
      measure_all(this->scene_, SweptBox<Scalar>{start, end, {size, this->tiny, size / 3}});
      measure_all(this->scene_, SweptCapsule<Scalar>{start, end, {size, this->tiny, -size}, size});
    }
  }
  for (const SphereFamily family : all_sphere_families) {
    Random random(41 + static_cast<std::uint64_t>(family));
    for (std::size_t i = case_count(4); i > 0; --i) {
      const auto [ball, triangle] = draw_sphere_pair<Scalar>(family, random);
      GeneratedMesh<Scalar> mesh;
      mesh.add(triangle);
      mesh.add({triangle.b, triangle.c, triangle.a});
      const auto collider = std::make_shared<Collider<Scalar>>(mesh.view());
      Scene<Scalar> scene;
      for (int k = 0; k < 2; ++k) scene.add(collider);
      scene.commit();
      const Vector3<Scalar> axis = (triangle.b - triangle.a) / 2;
      measure_all(scene, ball);
      measure_all(scene, SweptBox<Scalar>{ball.start, ball.end, {ball.radius, ball.radius, ball.radius}});
      measure_all(scene, SweptCapsule<Scalar>{ball.start, ball.end, axis, ball.radius});
    }
  }
  testing::Test::RecordProperty("bytes", std::to_string(deepest));
  EXPECT_LT(deepest, promised_bytes_of_shapes<Scalar>);
  // The longest integers are among the cases.
  EXPECT_GT(deepest, promised_bytes_of_shapes<Scalar> / 4);
}

/// Paths and shapes come to the deepest inner grid of an instance.
TYPED_TEST(SceneStack, in_inner_grids) {
  using Scalar = TypeParam;
  PaintedStack stack;
  std::size_t in_deepest_grid = 0;
  for (const SphereFamily family : all_sphere_families) {
    Random random(41 + static_cast<std::uint64_t>(family));
    const auto [ball, triangle] = draw_sphere_pair<Scalar>(family, random);
    const auto hit = intersect(ball, triangle);
    if (!hit) continue;
    const Vector3<Scalar> at = contact_point(triangle, *hit);
    const auto mesh = in_levels<Scalar>(triangle, at, ball.start, Grid::max_depth);
    const auto collider = std::make_shared<Collider<Scalar>>();
    // Numbers may be too large for levels around them.
    if (!collider->try_build(mesh.view(), {.grid = {.resolution = {2, 2, 2}, .crowded = 8}})) continue;
    const Grid& grid = detail::ColliderState<Scalar>::of(*collider).grid;
    if (grid.levels() > 0 && grid.inner_frames().size() >= Grid::max_depth) ++in_deepest_grid;
    const std::string name = name_of(family);
    // A scene with one instance has batches of its own.
    for (const std::size_t count : {1U, 2U}) {
      Scene<Scalar> scene;
      for (std::size_t i = 0; i < count; ++i) scene.add(collider);
      scene.commit();
      const std::vector<Segment<Scalar>> segments(40, Segment<Scalar>{ball.start, at});
      std::vector<SceneHit<Scalar>> hits(segments.size());
      std::vector<std::uint8_t> blocked(segments.size());
      this->expect_within_promise("first_hit_" + name, [&] { static_cast<void>(scene.first_hit(segments.front())); });
      this->expect_within_promise("first_hits_" + name, [&] { scene.first_hits(segments, hits); });
      this->expect_within_promise("any_hits_" + name, [&] { scene.any_hits(segments, blocked); });
      const auto measure_shapes = [&](const auto& shape) {
        const std::vector<std::remove_cvref_t<decltype(shape)>> shapes(2, shape);
        std::vector<SceneShapeHit<Scalar>> shape_hits(shapes.size());
        const auto measure = [&](const auto& call) {
          EXPECT_LT(stack.bytes_used_by(call), promised_bytes_of_shapes<Scalar>) << name;
        };
        measure([&] { static_cast<void>(scene.first_hit(shape)); });
        measure([&] { static_cast<void>(scene.any_hit(shape)); });
        measure([&] { scene.first_hits(shapes, shape_hits); });
        measure([&] { scene.any_hits(shapes, std::span(blocked).first(shapes.size())); });
        measure([&] { static_cast<void>(scene.last_free_point(shape, shape_hits.front())); });
      };
      measure_shapes(ball);
      measure_shapes(SweptBox<Scalar>{ball.start, ball.end, {ball.radius, ball.radius, ball.radius}});
      measure_shapes(SweptCapsule<Scalar>{ball.start, ball.end, (triangle.b - triangle.a) / 2, ball.radius});
    }
  }
  EXPECT_GT(in_deepest_grid, 0U);
}

TYPED_TEST(SceneStack, of_triangles_and_normals) {
  for (const InstanceId id : this->scene_.instances()) {
    this->expect_within_promise("triangle_" + std::to_string(id.index),
                                [&] { static_cast<void>(this->scene_.triangle(id, 1)); });
    this->expect_within_promise("normal_" + std::to_string(id.index),
                                [&] { static_cast<void>(this->scene_.normal(id, 1)); });
  }
}

/// Normals of contacts decide their pairs again, with integers. The longest are those of all numbers of all sizes.
TYPED_TEST(SceneStack, of_contacts) {
  using Scalar = TypeParam;
  PaintedStack stack;
  std::size_t deepest = 0;
  const auto measure = [&](const auto& call) { deepest = std::max(deepest, stack.bytes_used_by(call)); };
  std::size_t contacts = 0;
  for (const auto& [start, end] : this->segments()) {
    for (const Scalar size : {this->huge / 3, Scalar(0.25), this->tiny}) {
      for (const SweptShape<Scalar>& shape :
           {SweptShape<Scalar>(SweptSphere<Scalar>{start, end, size}),
            SweptShape<Scalar>(SweptBox<Scalar>{start, end, {size, this->tiny, size / 3}}),
            SweptShape<Scalar>(SweptCapsule<Scalar>{start, end, {size, this->tiny, -size}, size})}) {
        std::vector<SceneShapeHit<Scalar>> hits;
        this->scene_.all_hits(shape, hits);
        hits.resize(std::min<std::size_t>(hits.size(), 4));
        for (const auto& hit : hits) {
          measure([&] { static_cast<void>(this->scene_.contact_point(hit)); });
          measure([&] { static_cast<void>(this->scene_.contact_normal(shape, hit)); });
          ++contacts;
        }
      }
    }
  }
  testing::Test::RecordProperty("bytes", std::to_string(deepest));
  EXPECT_GT(contacts, 50U);
  EXPECT_LT(deepest, promised_bytes_of_shapes<Scalar>);
}

}  // namespace
}  // namespace surehit::test::scene_stack_test

#endif
