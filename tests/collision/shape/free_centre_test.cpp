#include <gmpxx.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "support/box_families.hpp"
#include "support/capsule_families.hpp"
#include "support/case_count.hpp"
#include "support/exact_oracle.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/neighbour.hpp"
#include "support/random.hpp"
#include "support/scalars.hpp"
#include "support/sphere_families.hpp"
#include "surehit/collider.hpp"
#include "surehit/intersect.hpp"
#include "surehit/scene.hpp"

namespace surehit::test::free_centre_test {
namespace {

/// `last_free_point` of moving shapes, in colliders and in scenes.
template <typename Scalar>
class FreeCentre : public testing::Test {
 protected:
  using Shape = SweptShape<Scalar>;
  using Point = Vector3<Scalar>;

  static Point start_of(const Shape& shape) {
    return std::visit([](const auto& any) { return any.start; }, shape);
  }
  static Point end_of(const Shape& shape) {
    return std::visit([](const auto& any) { return any.end; }, shape);
  }
  static Shape ending_at(Shape shape, const Point& end) {
    std::visit([&](auto& any) { any.end = end; }, shape);
    return shape;
  }

  /// Returns the first candidate that is free, by the definition and with fractions.
  template <typename IsBlocked>
  static Point defined(const Shape& shape, Scalar t, const IsBlocked& is_blocked) {
    const Point start = start_of(shape);
    const Point end = end_of(shape);
    const mpq_class exact_t = double{t};
    mpq_class back = mpq_class(double{neighbour(t, 1)}) - exact_t;
    for (mpq_class s = exact_t - back; s >= mpq_class(0x1p-64); back *= 2, s = exact_t - back) {
      Point candidate;
      for (Eigen::Index i = 0; i < 3; ++i) {
        const mpq_class from = double{start[i]};
        candidate[i] = nearest<Scalar>(from + s * (mpq_class(double{end[i]}) - from));
      }
      if (!is_blocked(candidate, s)) return candidate;
    }
    return start;
  }

  /// A floor under (2, 1), and shapes of each kind that come down to it by `reach` from their centre.
  static GeneratedMesh<Scalar> floor() {
    GeneratedMesh<Scalar> mesh;
    mesh.add({{0, 0, 0}, {8, 0, 0}, {0, 8, 0}});
    return mesh;
  }
  struct Falling {
    Shape shape;
    mpq_class reach;
  };
  static Falling falling(std::size_t kind, Scalar from, Scalar to, Scalar size) {
    const Point start{2, 1, from};
    const Point end{2, 1, to};
    if (kind == 0) return {SweptSphere<Scalar>{start, end, size}, double{size}};
    if (kind == 1) return {SweptBox<Scalar>{start, end, {1, 0, size}}, double{size}};
    return {SweptCapsule<Scalar>{start, end, {0, 0, size}, size}, 2 * mpq_class(double{size})};
  }

  template <typename Draw>
  void expect_the_definition(const Draw& draw, const std::string& family, Random& random) {
    GeneratedMesh<Scalar> mesh;
    std::vector<Shape> shapes;
    while (shapes.size() < 6) {
      const auto [shape, triangle] = draw();
      mesh.add(triangle);
      shapes.push_back(shape);
    }
    const auto collider = std::make_shared<Collider<Scalar>>(mesh.view());
    Scene<Scalar> scene;
    const InstanceId id = scene.add(collider);
    scene.commit();
    for (const Shape& shape : shapes) {
      ShapeQueryOptions<Scalar> options;
      options.ignore_start_contact = random.one_in(2);
      if (random.one_in(4)) options.culling = Culling::back;
      if (random.one_in(4)) options.ignored_triangle = static_cast<std::uint32_t>(random.below(6));
      const auto hit = collider->first_hit(shape, options);
      if (!hit) continue;
      const auto is_blocked = [&](const Point& candidate, const mpq_class&) {
        for (std::uint32_t k = 0; k < 6; ++k) {
          if (k == options.ignored_triangle) continue;
          if (intersect(ending_at(shape, candidate), mesh.view().triangle(k), options)) return true;
        }
        return false;
      };
      const Point free = collider->last_free_point(shape, *hit, options);
      ASSERT_EQ(free, defined(shape, hit->t, is_blocked)) << family;
      if (free != start_of(shape)) {
        ++moved;
        ASSERT_FALSE(collider->any_hit(ending_at(shape, free), options));
      }
      const SceneShapeQueryOptions<Scalar> in_scene{.culling = options.culling,
                                                    .ignored_instance = id,
                                                    .ignored_triangle = options.ignored_triangle,
                                                    .ignore_start_contact = options.ignore_start_contact};
      if (options.ignored_triangle == no_triangle) continue;
      ASSERT_EQ(free, scene.last_free_point(shape, SceneShapeHit<Scalar>{*hit, id}, in_scene)) << family;
    }
  }

  std::size_t moved = 0;
};
TYPED_TEST_SUITE(FreeCentre, Scalars, ScalarNames);

TYPED_TEST(FreeCentre, is_the_first_candidate_before_the_hit_where_that_is_free) {
  const Collider<TypeParam> collider(this->floor().view());
  for (std::size_t kind = 0; kind < 3; ++kind) {
    const auto [shape, reach] = this->falling(kind, 4, 0, kind == 2 ? TypeParam{0.5} : TypeParam{1});
    const auto hit = collider.first_hit(shape);
    ASSERT_TRUE(hit);
    ASSERT_EQ(hit->t, TypeParam{0.75});
    const auto free = collider.last_free_point(shape, *hit);
    // 4 - 4 s, for s one ulp(3/4) less than 3/4, is two ulp(1) above 1.
    EXPECT_EQ(free[2], 1 + 2 * std::numeric_limits<TypeParam>::epsilon());
    EXPECT_FALSE(collider.overlaps(this->ending_at(shape, free)));
  }
}

TYPED_TEST(FreeCentre, is_the_definitions_to_the_bit) {
  Random random(94);
  for (std::size_t i = case_count(15); i > 0; --i) {
    for (const auto family :
         {SphereFamily::general, SphereFamily::tangent, SphereFamily::beside_tangent, SphereFamily::starts_at_distance,
          SphereFamily::small_steps, SphereFamily::far_away, SphereFamily::no_radius, SphereFamily::small_integers}) {
      const auto draw = [&] { return draw_sphere_pair<TypeParam>(family, random); };
      ASSERT_NO_FATAL_FAILURE(this->expect_the_definition(draw, name_of(family), random));
    }
    for (const auto family : {BoxFamily::general, BoxFamily::grazing, BoxFamily::small_integers}) {
      const auto draw = [&] { return draw_box_pair<TypeParam>(family, random); };
      ASSERT_NO_FATAL_FAILURE(this->expect_the_definition(draw, name_of(family), random));
    }
    for (const auto family : {CapsuleFamily::general, CapsuleFamily::small_integers}) {
      const auto draw = [&] { return draw_capsule_pair<TypeParam>(family, random); };
      ASSERT_NO_FATAL_FAILURE(this->expect_the_definition(draw, name_of(family), random));
    }
  }
  EXPECT_GE(this->moved, case_count(150));
}

TYPED_TEST(FreeCentre, of_a_moving_instance_goes_the_same_share) {
  Random random(95);
  const auto collider = std::make_shared<Collider<TypeParam>>(this->floor().view());
  std::size_t further = 0;
  for (std::size_t i = case_count(1000); i > 0; --i) {
    const auto number = [&](double low, double high) {
      return static_cast<TypeParam>(low + (high - low) * random.unit<double>());
    };
    const TypeParam place = random.one_in(2) ? number(-1, 1) : number(0, 1) * TypeParam(0x1p-60);
    const TypeParam motion = number(-1, 1) * (random.one_in(4) ? TypeParam(0x1p-90) : TypeParam{1});
    const auto [shape, reach] =
        this->falling(random.below(3), number(4, 8), number(-8, -4), random.one_in(4) ? TypeParam{0} : number(0, 1));
    Scene<TypeParam> scene;
    const InstanceId id = scene.add(collider, Pose<TypeParam>::translated({0, 0, place}));
    scene.set_motion(id, {0, 0, motion});
    scene.commit();
    const auto hit = scene.first_hit(shape);
    ASSERT_TRUE(hit);
    TypeParam share = -1;
    const auto free = scene.last_free_point(shape, *hit, {}, &share);
    EXPECT_TRUE(share > 0 && share < hit->t) << share;
    // Before, it was above. So only the end of the way can touch the floor.
    const auto is_blocked = [&, &size = reach](const Vector3<TypeParam>& candidate, const mpq_class& s) {
      const mpq_class height = mpq_class(double{place}) + s * mpq_class(double{motion});
      return mpq_class(double{candidate[2]}) - height <= size;
    };
    ASSERT_EQ(free, this->defined(shape, hit->t, is_blocked)) << i;
    further += free[2] < this->start_of(shape)[2] ? 1 : 0;
  }
  EXPECT_EQ(further, case_count(1000));
}

TYPED_TEST(FreeCentre, is_asked_about_again_where_a_lift_is_lower) {
  // The shape hardly moves, so many candidates are the same point. The lift may be there at one share, and not yet
  // there at a lower one.
  Random random(96);
  const auto collider = std::make_shared<Collider<TypeParam>>(this->floor().view());
  std::size_t further = 0;
  for (std::size_t i = case_count(1000); i > 0; --i) {
    const TypeParam from = 4 + 4 * random.unit<TypeParam>();
    const TypeParam to = neighbour(from, -1 - static_cast<int>(random.below(40)));
    const auto [shape, reach] = this->falling(random.below(3), from, to, random.unit<TypeParam>());
    const TypeParam motion = 8 + 8 * random.unit<TypeParam>();
    Scene<TypeParam> scene;
    const InstanceId lift = scene.add(collider);
    scene.set_motion(lift, {0, 0, motion});
    scene.commit();
    const auto hit = scene.first_hit(shape).value();
    mpq_class free_share = 0;
    const auto is_blocked = [&, &size = reach](const Vector3<TypeParam>& candidate, const mpq_class& s) {
      const bool is_low = mpq_class(double{candidate[2]}) - s * mpq_class(double{motion}) <= size;
      if (!is_low) free_share = s;
      return is_low;
    };
    TypeParam share = -1;
    const auto free = scene.last_free_point(shape, hit, {}, &share);
    ASSERT_EQ(free, this->defined(shape, hit.t, is_blocked)) << i;
    ASSERT_EQ(mpq_class(double{share}), free_share) << i;
    further += free[2] < from ? 1 : 0;
  }
  EXPECT_GT(further, case_count(500));
}

TYPED_TEST(FreeCentre, of_a_contact_at_the_start_is_the_start) {
  const Collider<TypeParam> collider(this->floor().view());
  const auto [shape, reach] = this->falling(0, 1, -1, 1);
  const auto hit = collider.first_hit(shape);
  ASSERT_TRUE(hit && hit->started_touching);
  EXPECT_EQ(collider.last_free_point(shape, *hit), this->start_of(shape));
}

TYPED_TEST(FreeCentre, leaves_the_triangle_of_an_ignored_start_contact) {
  auto mesh = this->floor();
  mesh.add({{0, 0, 5}, {8, 0, 5}, {0, 8, 5}});
  const Collider<TypeParam> collider(mesh.view());
  const auto [shape, reach] = this->falling(0, 1, 9, 1);
  const ShapeQueryOptions<TypeParam> options{.ignore_start_contact = true};
  const auto hit = collider.first_hit(shape, options);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->triangle, 1U);
  const auto free = collider.last_free_point(shape, *hit, options);
  EXPECT_LT(free[2], 4);
  EXPECT_GT(free[2], TypeParam(3.99));
  EXPECT_FALSE(collider.overlaps(this->ending_at(shape, free)) && free == this->start_of(shape));
}

TYPED_TEST(FreeCentre, is_that_of_the_hits_that_count) {
  auto mesh = this->floor();
  mesh.add({{0, 0, -2}, {8, 0, -2}, {0, 8, -2}});
  const auto collider = std::make_shared<Collider<TypeParam>>(mesh.view());
  Scene<TypeParam> scene;
  scene.add(collider);
  scene.commit();
  const auto [shape, reach] = this->falling(0, 4, -4, 1);
  const auto is_lower = [](const auto& hit) { return hit.triangle == 1; };
  const auto hit = collider->first_hit(shape, is_lower);
  const auto hit_in_scene = scene.first_hit(shape, is_lower);
  ASSERT_TRUE(hit && hit_in_scene);
  const auto free = collider->last_free_point(shape, *hit, is_lower);
  EXPECT_GT(free[2], -1);
  EXPECT_LT(free[2], TypeParam(-0.999));
  EXPECT_EQ(free, scene.last_free_point(shape, *hit_in_scene, is_lower));
}

TYPED_TEST(FreeCentre, is_the_start_where_no_share_is_tried) {
  const auto collider = std::make_shared<Collider<TypeParam>>(this->floor().view());
  for (const TypeParam height : {TypeParam(0x1p-70), TypeParam(0x1p-66)}) {
    const auto [shape, reach] = this->falling(0, height, -1, 0);
    const auto hit = collider->first_hit(shape);
    ASSERT_TRUE(hit && hit->t > 0);
    EXPECT_EQ(collider->last_free_point(shape, *hit), this->start_of(shape));
  }
  const auto [shape, reach] = this->falling(0, TypeParam(0x1p-60), -1, 0);
  const auto free = collider->last_free_point(shape, collider->first_hit(shape).value());
  EXPECT_GT(free[2], 0);
  EXPECT_LT(free[2], TypeParam(0x1p-80));
}

TYPED_TEST(FreeCentre, is_the_start_without_finite_numbers) {
  const Collider<TypeParam> collider(this->floor().view());
  constexpr TypeParam infinity = std::numeric_limits<TypeParam>::infinity();
  const auto [shape, reach] = this->falling(0, 4, -4, 1);
  auto hit = collider.first_hit(shape).value();
  for (const TypeParam t : {infinity, -infinity, std::numeric_limits<TypeParam>::quiet_NaN(), TypeParam{0},
                            std::nextafter(TypeParam{1}, infinity), TypeParam{0x1p100}}) {
    hit.t = t;
    EXPECT_EQ(collider.last_free_point(shape, hit), this->start_of(shape));
  }
  hit.t = TypeParam{0.5};
  const auto endless = this->ending_at(shape, {0, 0, infinity});
  EXPECT_EQ(collider.last_free_point(endless, hit), this->start_of(shape));
}

TYPED_TEST(FreeCentre, of_a_resting_shape_has_the_share_of_the_lift) {
  Scene<TypeParam> scene;
  const InstanceId lift = scene.add(std::make_shared<Collider<TypeParam>>(this->floor().view()));
  scene.set_motion(lift, {0, 0, 8});
  scene.commit();
  const SweptSphere<TypeParam> ball{{2, 1, 4}, {2, 1, 4}, 1};
  TypeParam share = -1;
  EXPECT_EQ(scene.last_free_point(ball, scene.first_hit(ball).value(), {}, &share), ball.start);
  EXPECT_EQ(share, neighbour(TypeParam{0.375}, -1));
  const Segment<TypeParam> point{{2, 1, 3}, {2, 1, 3}};
  EXPECT_EQ(scene.last_free_point(point, scene.first_hit(point).value(), {}, &share), point.start);
  EXPECT_EQ(share, neighbour(TypeParam{0.375}, -1));
}

/// The integers for a moving instance have room for a share of its motion, and not for many times as much.
TYPED_TEST(FreeCentre, of_a_hit_after_the_step_is_the_start) {
  GeneratedMesh<TypeParam> mesh;
  mesh.add({{0, 0, std::numeric_limits<TypeParam>::denorm_min()}, {8, 0, 0}, {0, 8, 0}});
  const bool is_float = std::is_same_v<TypeParam, float>;
  Scene<TypeParam> scene;
  const InstanceId lift = scene.add(std::make_shared<Collider<TypeParam>>(mesh.view()));
  scene.set_motion(lift, {0, 0, std::ldexp(TypeParam{1}, is_float ? 100 : 1000)});
  scene.commit();
  const SweptSphere<TypeParam> ball{{0, 0, 0}, {0, 0, std::ldexp(TypeParam{1}, is_float ? -100 : -1000)}, 0};
  SceneShapeHit<TypeParam> hit = scene.first_hit(ball).value_or(SceneShapeHit<TypeParam>{});
  hit.instance = lift;
  hit.started_touching = false;
  hit.t = std::ldexp(TypeParam{1}, is_float ? 99 : 999);
  EXPECT_EQ(scene.last_free_point(ball, hit), ball.start);
}

}  // namespace
}  // namespace surehit::test::free_centre_test
