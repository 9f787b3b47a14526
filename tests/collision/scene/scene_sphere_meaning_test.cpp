#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "scene_meaning.hpp"
#include "support/case_count.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/random.hpp"
#include "support/threads.hpp"

namespace surehit::test::scene_sphere_meaning_test {
namespace {

/// What the hits of moving balls in a scene mean.
template <typename Scalar>
class SceneSphereMeaning : public SceneMeaning<Scalar> {
 protected:
  using Hits = std::vector<SceneShapeHit<Scalar>>;
  using Ball = SweptSphere<Scalar>;

  Hits touched(const Ball& ball, const SceneShapeQueryOptions<Scalar>& options = {}) const {
    Hits hits;
    this->scene.all_hits(ball, hits, options);
    return hits;
  }
  static Hits as_hits(const std::optional<SceneShapeHit<Scalar>>& hit) { return hit ? Hits{*hit} : Hits{}; }
};
TYPED_TEST_SUITE(SceneSphereMeaning, Scalars, ScalarNames);

// "Distances are those of the scene, whatever the poses are."

TYPED_TEST(SceneSphereMeaning, radius_is_that_of_the_scene) {
  for (const TypeParam scale : {TypeParam{1}, TypeParam{8}, TypeParam{0x1p-30F}}) {
    Scene<TypeParam> scene;
    // The corner of the floor is below the ball, and its size does not matter.
    const auto id = scene.add(this->floor, {with_rows<TypeParam>({scale, 0, 0}, {0, scale, 0}, {0, 0, scale}).linear,
                                            {TypeParam{0.25}, TypeParam{0.25}, 0}});
    scene.commit();
    const auto hit = scene.first_hit(this->falling(4, 0, 1));
    ASSERT_TRUE(hit);
    EXPECT_EQ(*hit, (SceneShapeHit<TypeParam>{{TypeParam{0.75}, 0, 0, 0, Feature::corner_a, false}, id}));
  }
}

TYPED_TEST(SceneSphereMeaning, ball_stays_round_where_a_pose_is_flat) {
  // The floor is 2^-40 thick in the scene what is 1 in the mesh. So the ball is an ellipsoid there.
  const auto stack = stack_collider<TypeParam>(3);
  const auto id = this->scene.add(stack, with_rows<TypeParam>({1, 0, 0}, {0, 1, 0}, {0, 0, TypeParam{0x1p-40F}}));
  this->scene.commit();
  const auto hits = this->touched(this->falling(2, 0, 1));
  ASSERT_EQ(hits.size(), 3U);
  EXPECT_EQ(hits[0].triangle, 2U);
  EXPECT_EQ(hits[0].instance, id);
  EXPECT_EQ(hits[2], (SceneShapeHit<TypeParam>{{TypeParam{0.5}, this->quarter, this->quarter, 0}, id}));
}

TYPED_TEST(SceneSphereMeaning, touch_in_one_point_is_found_wherever_the_tree_begins) {
  Random random(3);
  for (std::size_t i = case_count(500); i > 0; --i) {
    Scene<TypeParam> scene;
    scene.add(this->floor, at_height<TypeParam>(1));
    const TypeParam far = 1000 * random.unit<TypeParam>();
    scene.add(this->floor, Pose<TypeParam>::translated({-far, -far / 3, -far / 7}));
    scene.commit();
    const TypeParam centre = 1 + random.unit<TypeParam>();
    // The difference is exact.
    EXPECT_TRUE(scene.overlaps(this->falling(centre, 0, centre - 1)));
    EXPECT_TRUE(scene.any_hit(this->falling(9, centre, centre - 1)));
  }
}

TYPED_TEST(SceneSphereMeaning, corner_is_touched_in_one_point_by_what_comes_from_far_away) {
  Random random(4);
  const auto eighths = [&] { return static_cast<TypeParam>(random.between(-800, 800)) / 8; };
  const TypeParam far = sizeof(TypeParam) == 4 ? 0x1p12F : 0x1p44F;
  for (std::size_t i = case_count(500); i > 0; --i) {
    const TypeParam x = eighths();
    const TypeParam y = eighths();
    Scene<TypeParam> scene;
    scene.add(this->floor, Pose<TypeParam>::translated({x, y, 0}));
    const TypeParam other = 1000 * random.unit<TypeParam>();
    scene.add(this->floor, Pose<TypeParam>::translated({-other, -other / 3, -other / 7}));
    scene.commit();
    EXPECT_TRUE(scene.any_hit(SweptSphere<TypeParam>{{x - far, y + far, 0}, {x + far, y - far, 0}, 0}));
  }
}

// "While a shape moves, instances with a motion move too."

TYPED_TEST(SceneSphereMeaning, moving_instance_comes_toward_the_ball) {
  const auto lift = this->add();
  this->scene.set_motion(lift, {0, 0, 2});
  this->scene.commit();
  const auto ball = this->falling(4, 2, 1);
  const auto hit = this->scene.first_hit(ball);
  ASSERT_TRUE(hit);
  EXPECT_EQ(*hit, (SceneShapeHit<TypeParam>{{TypeParam{0.75}, this->quarter, this->quarter, 0}, lift}));
  EXPECT_EQ(this->scene.last_free_t(ball, *hit), std::nextafter(TypeParam{0.75}, TypeParam{0}));
  // A lift that goes as the ball does is never reached, and culling sees no step.
  const auto beside = this->falling(4, 6, 2);
  EXPECT_FALSE(this->scene.any_hit(beside));
  const auto rides = this->falling(2, 4, 2);
  EXPECT_TRUE(this->scene.overlaps(rides));
  EXPECT_TRUE(this->scene.any_hit(rides));
  EXPECT_FALSE(this->scene.any_hit(rides, {.culling = Culling::back}));
  EXPECT_FALSE(this->scene.any_hit(rides, {.culling = Culling::front}));
}

TYPED_TEST(SceneSphereMeaning, overlap_is_a_contact_at_the_start) {
  this->add();
  this->scene.commit();
  EXPECT_FALSE(this->scene.overlaps(this->falling(2, 0, 1)));
  EXPECT_TRUE(this->scene.overlaps(this->falling(1, 5, 1), {.max_t = -1, .ignore_start_contact = true}));
}

// "Leaves out placed triangles by the side from which the shape moves against them."

TYPED_TEST(SceneSphereMeaning, culling_follows_the_placed_triangle) {
  this->scene.add(this->floor, with_rows<TypeParam>({0, 1, 0}, {1, 0, 0}, {0, 0, 1}));  // mirrored
  this->scene.commit();
  const auto ball = this->falling(2, 0, 1);
  EXPECT_TRUE(this->scene.any_hit(ball, {.culling = Culling::front}));
  EXPECT_FALSE(this->scene.any_hit(ball, {.culling = Culling::back}));
}

// "Order, ids and options are those of paths."

TYPED_TEST(SceneSphereMeaning, ties_go_by_instance_and_then_by_triangle) {
  const std::vector<InstanceId> ids = this->add_equal_triangles();
  this->scene.commit();
  for (const TypeParam from : {TypeParam{3}, TypeParam{1}}) {  // not touching at the start, and touching
    const auto hits = this->touched(this->falling(from, 0, 1));
    ASSERT_EQ(hits.size(), 10U);
    for (std::size_t i = 0; i < hits.size(); ++i) {
      EXPECT_EQ(hits[i].instance, ids[i / 2]);
      EXPECT_EQ(hits[i].triangle, i % 2);
    }
    EXPECT_EQ(this->as_hits(this->scene.first_hit(this->falling(from, 0, 1))), (typename TestFixture::Hits{hits[0]}));
  }
}

TYPED_TEST(SceneSphereMeaning, removed_instance_is_not_touched_and_its_id_names_no_other) {
  const auto old = this->add();
  this->scene.commit();
  this->scene.remove(old);
  this->scene.commit();
  EXPECT_FALSE(this->scene.any_hit(this->falling(2, 0, 1)));
  const auto id = this->add();
  this->scene.commit();
  EXPECT_EQ(id.index, old.index);
  EXPECT_FALSE(this->scene.any_hit(this->falling(2, 0, 1), {.ignored_instance = id}));
  const auto hit = this->scene.first_hit(this->falling(2, 0, 1), {.ignored_instance = old});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->instance, id);
}

TYPED_TEST(SceneSphereMeaning, empty_scene_and_invalid_balls_miss) {
  EXPECT_FALSE(this->scene.first_hit(this->falling(2, 0, 1)));
  EXPECT_TRUE(this->touched(this->falling(2, 0, 1)).empty());
  this->add();
  this->scene.commit();
  for (const TypeParam bad :
       {TypeParam{-1}, std::numeric_limits<TypeParam>::quiet_NaN(), std::numeric_limits<TypeParam>::infinity()}) {
    EXPECT_FALSE(this->scene.any_hit(this->falling(2, 0, bad)));
    EXPECT_EQ(this->scene.any_hit(this->falling(2, bad, 1)), std::isfinite(bad));
  }
  EXPECT_FALSE(this->scene.any_hit(this->falling(2, 0, 1), {.max_t = std::numeric_limits<TypeParam>::quiet_NaN()}));
}

/// Many instances of whole numbers, and the collider of all of their triangles. Both must give the same bits.
template <typename Scalar>
class SceneSphereFlattened : public testing::Test {
 protected:
  static constexpr std::uint32_t side = 3;
  static constexpr int instances_in_a_row = 16;

  SceneSphereFlattened() {
    GeneratedMesh<Scalar> piece;
    for (std::uint32_t i = 0; i < side * side; ++i) {
      const auto at = [&](std::uint32_t x, std::uint32_t y) {
        return Vector3<Scalar>(static_cast<Scalar>(x), static_cast<Scalar>(y),
                               static_cast<Scalar>((x * 7 + y * 5) % 3));
      };
      const std::uint32_t x = i % side;
      const std::uint32_t y = i / side;
      piece.add({at(x, y), at(x + 1, y), at(x, y + 1)});
      piece.add({at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)});
    }
    count = static_cast<std::uint32_t>(piece.triangles.size());
    const auto collider = std::make_shared<Collider<Scalar>>(piece.view());
    GeneratedMesh<Scalar> all;
    for (int y = 0; y < instances_in_a_row; ++y) {
      for (int x = 0; x < instances_in_a_row; ++x) {
        const Vector3<Scalar> place(static_cast<Scalar>(4 * x), static_cast<Scalar>(4 * y), static_cast<Scalar>(x % 3));
        ids.push_back(scene.add(collider, Pose<Scalar>::translated(place)));
        for (std::uint32_t i = 0; i < count; ++i) {
          const Triangle<Scalar> triangle = piece.view().triangle(i);
          all.add({triangle.a + place, triangle.b + place, triangle.c + place});
        }
      }
    }
    scene.commit();
    flat = Collider<Scalar>(all.view());
  }

  std::vector<SweptSphere<Scalar>> draw_balls(std::size_t size) {
    std::vector<SweptSphere<Scalar>> balls;
    const auto draw = [&](Scalar reach) {
      const Scalar x = reach * random.unit<Scalar>();
      return random.one_in(2) ? std::round(x) : x;
    };
    while (balls.size() < size) {
      const Scalar x = draw(64);
      const Scalar y = draw(64);
      const Vector3<Scalar> start(x, y, draw(8) - 2);
      const Scalar reach = random.one_in(4) ? 64 : 6;
      const Scalar step_x = draw(reach) - reach / 2;
      const Scalar step_y = draw(reach) - reach / 2;
      const Vector3<Scalar> step(step_x, step_y, draw(8) - 4);
      balls.push_back({start, start + step, std::ldexp(draw(2), -static_cast<int>(random.below(8)))});
    }
    return balls;
  }

  Random random{77};
  std::uint32_t count = 0;
  std::vector<InstanceId> ids;
  Scene<Scalar> scene;
  Collider<Scalar> flat;
};
TYPED_TEST_SUITE(SceneSphereFlattened, Scalars, ScalarNames);

TYPED_TEST(SceneSphereFlattened, has_the_bits_of_one_collider) {
  std::size_t hits_in_all = 0;
  for (const auto& ball : this->draw_balls(case_count(2000))) {
    std::vector<SceneShapeHit<TypeParam>> hits;
    std::vector<ShapeHit<TypeParam>> expected;
    this->scene.all_hits(ball, hits);
    this->flat.all_hits(ball, expected);
    ASSERT_EQ(hits.size(), expected.size());
    for (std::size_t i = 0; i < hits.size(); ++i) {
      SceneShapeHit<TypeParam> placed{expected[i], this->ids[expected[i].triangle / this->count]};
      placed.triangle %= this->count;
      ASSERT_EQ(hits[i], placed);
    }
    const auto first = this->scene.first_hit(ball);
    ASSERT_EQ(first.value_or(SceneShapeHit<TypeParam>{}), hits.empty() ? SceneShapeHit<TypeParam>{} : hits.front());
    hits_in_all += hits.size();
  }
  EXPECT_GE(hits_in_all, case_count(2000));
}

TYPED_TEST(SceneSphereFlattened, batches_are_the_same_on_any_number_of_threads) {
  const auto balls = this->draw_balls(1500);
  std::vector<SceneShapeHit<TypeParam>> expected;
  for (const auto& ball : balls) expected.push_back(this->scene.first_hit(ball).value_or(SceneShapeHit<TypeParam>{}));
  QueryStatistics alone;
  for (const std::size_t threads_count : {0U, 1U, 3U}) {
    std::vector<SceneShapeHit<TypeParam>> hits(balls.size());
    std::vector<std::uint8_t> blocked(balls.size());
    QueryStatistics statistics;
    if (threads_count == 0) {
      this->scene.first_hits(balls, hits, {.statistics = &alone});
      this->scene.any_hits(balls, blocked);
    } else {
      const Threads threads(threads_count);
      this->scene.first_hits(balls, hits, {.executor = Executor(threads), .statistics = &statistics});
      this->scene.any_hits(balls, blocked, {.executor = Executor(threads)});
      EXPECT_EQ(statistics.paths, balls.size());
      EXPECT_EQ(statistics.candidates, alone.candidates);
      EXPECT_EQ(statistics.instances, alone.instances);
    }
    EXPECT_EQ(hits, expected);
    for (std::size_t i = 0; i < balls.size(); ++i) ASSERT_EQ(blocked[i] != 0, expected[i].triangle != no_triangle);
  }
  // Each ball with options of its own. A batch ends with the shorter of balls and hits.
  std::vector<SceneShapeQueryOptions<TypeParam>> options(balls.size());
  for (std::size_t i = 0; i < options.size(); i += 2) options[i].instance_mask = 0;
  std::vector<SceneShapeHit<TypeParam>> hits(100);
  this->scene.first_hits(balls, hits, {.path_options = options});
  for (std::size_t i = 0; i < hits.size(); ++i) {
    ASSERT_EQ(hits[i], i % 2 == 0 ? SceneShapeHit<TypeParam>{} : expected[i]);
  }
}

TYPED_TEST(SceneSphereFlattened, small_balls_visit_few_instances) {
  QueryStatistics statistics;
  const std::size_t balls = 200;
  for (std::size_t i = 0; i < balls; ++i) {
    const TypeParam x = 64 * this->random.template unit<TypeParam>();
    const TypeParam y = 64 * this->random.template unit<TypeParam>();
    static_cast<void>(
        this->scene.first_hit(SweptSphere<TypeParam>{{x, y, 8}, {x, y, -8}, TypeParam{0.0625}}, {}, &statistics));
  }
  EXPECT_LT(statistics.instances, 2 * balls);
  EXPECT_LT(statistics.candidates, 40 * balls);
}

}  // namespace
}  // namespace surehit::test::scene_sphere_meaning_test
