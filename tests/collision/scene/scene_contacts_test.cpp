#include <gmpxx.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "exact_matrix.hpp"
#include "scene_meaning.hpp"
#include "support/case_count.hpp"
#include "support/exact_oracle.hpp"
#include "support/scene_drawer.hpp"
#include "support/scene_path_drawer.hpp"
#include "support/sphere_oracle.hpp"
#include "surehit/intersect.hpp"

namespace surehit::test::scene_contacts_test {
namespace {

/// Where shapes touch the triangles of a scene, and in which direction.
template <typename Scalar>
class SceneContacts : public SceneMeaning<Scalar> {
 protected:
  static constexpr bool is_float = sizeof(Scalar) == 4;
  /// What `contact_normal` promises.
  static constexpr double allowed = is_float ? 0x1p-23 : 0x1p-49;

  /// Returns a number of [0, 1] that is hard to multiply.
  static Scalar draw_share(Random& random) {
    switch (random.below(6)) {
      case 0:
        return static_cast<Scalar>(random.below(2));
      case 1:
        return std::numeric_limits<Scalar>::denorm_min() * static_cast<Scalar>(random.between(1, 9));
      case 2:
        return std::nextafter(Scalar{1}, Scalar{0});
      default:
        return random.unit<Scalar>();
    }
  }

  /// Returns the exact image of a triangle, and its motion.
  static std::array<ExactVector, 4> exact_image(const JudgedScene<Scalar>& judged, InstanceId id,
                                                std::uint32_t triangle) {
    const auto [a, b, c] = judged.oracle.corners(id, triangle);
    return {a, b, c, exact(judged.scene.motion(id))};
  }
};
TYPED_TEST_SUITE(SceneContacts, Scalars, ScalarNames);

// "Each coordinate is the exact one for the t, u and v of the hit, rounded once to nearest."

TYPED_TEST(SceneContacts, point_is_exact_for_the_numbers_of_the_hit) {
  using Scalar = TypeParam;
  Random random(51);
  std::size_t moving = 0;
  for (const SceneFamily family : all_scene_families) {
    for (std::size_t i = case_count(8); i > 0; --i) {
      const DrawnScene<Scalar> drawn = draw_scene<Scalar>(family, random);
      const JudgedScene<Scalar> judged(drawn);
      for (int k = 0; k < 60; ++k) {
        const std::size_t index = random.below(judged.ids.size());
        SceneShapeHit<Scalar> hit;
        hit.instance = judged.ids[index];
        const std::size_t count = judged.scene.triangle_count(hit.instance);
        if (count == 0) continue;
        hit.triangle = static_cast<std::uint32_t>(random.below(count));
        hit.t = this->draw_share(random);
        hit.u = this->draw_share(random);
        hit.v = this->draw_share(random);
        const auto [a, b, c, motion] = this->exact_image(judged, hit.instance, hit.triangle);
        const auto number = [](Scalar x) { return mpq_class(double{x}); };
        const ExactVector expected = a + number(hit.u) * (b - a) + number(hit.v) * (c - a) + number(hit.t) * motion;
        const Vector3<Scalar> point = judged.scene.contact_point(hit);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          ASSERT_TRUE(same_bits(point[static_cast<Eigen::Index>(axis)], nearest<Scalar>(expected[axis])))
              << name_of(family) << ", scene " << i << ", hit " << k;
        }
        moving += hit.t != 0 && !judged.scene.motion(hit.instance).isZero(0) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(moving, case_count(500));
}

// "It is that of the exact image, before any corner is rounded, and its error is the same."

TYPED_TEST(SceneContacts, normal_of_a_ball_is_that_of_the_exact_image) {
  using Scalar = TypeParam;
  Random random(52);
  std::size_t judged_normals = 0;
  for (const SceneFamily family : all_scene_families) {
    for (std::size_t i = case_count(this->is_float ? 20 : 4); i > 0; --i) {
      const DrawnScene<Scalar> drawn = draw_scene<Scalar>(family, random);
      const JudgedScene<Scalar> judged(drawn);
      ScenePathDrawer<Scalar> drawer(drawn, judged.oracle, judged.ids, random);
      const Path<Scalar> path = drawer.draw();
      const Scalar size = (path.toward - path.start).cwiseAbs().maxCoeff();
      const SweptSphere<Scalar> ball{path.start, path.toward,
                                     std::ldexp(size, -static_cast<int>(random.below(6))) * random.unit<Scalar>()};
      if (!std::isfinite(ball.radius)) continue;
      const auto hit = judged.scene.first_hit(ball);
      if (!hit) continue;
      const auto [a, b, c, motion] = this->exact_image(judged, hit->instance, hit->triangle);
      const ExactVector start = exact(ball.start);
      const mpq_class radius(double{ball.radius});
      const RationalPair pair = {start, exact(ball.end) - start - motion, a, b, c, radius * radius};
      const auto error =
          find_error_of_normal<Scalar>(pair, *hit, judged.scene.contact_normal(ball, *hit), this->allowed);
      ASSERT_EQ(error, std::nullopt) << name_of(family) << ", scene " << i;
      ++judged_normals;
    }
  }
  EXPECT_GT(judged_normals, case_count(this->is_float ? 80 : 10));
}

// "Returns the touched point of a hit, where the instance is at `hit.t`." "Steps are as the instance sees them."

TYPED_TEST(SceneContacts, are_where_a_moving_instance_is_by_then) {
  const auto lift = this->add();
  this->scene.set_motion(lift, {0, 0, 2});
  this->scene.commit();
  const auto ball = this->falling(4, 2, 1);
  const auto hit = this->scene.first_hit(ball);
  ASSERT_TRUE(hit);
  ASSERT_EQ(hit->t, TypeParam{0.75});
  EXPECT_EQ(this->scene.contact_point(*hit), (Vector3<TypeParam>{this->quarter, this->quarter, TypeParam{1.5}}));
  EXPECT_EQ(this->scene.contact_normal(ball, *hit), (Vector3<TypeParam>{0, 0, 1}));
  // Where the lift is at its start, the ball never touches it.
  EXPECT_EQ(contact_normal(ball, this->scene.triangle(lift, 0)), (Vector3<TypeParam>{0, 0, 0}));
}

TYPED_TEST(SceneContacts, normal_of_a_centre_on_the_triangle_is_against_the_step_that_the_instance_sees) {
  const auto floor = this->add();
  const auto ball = this->falling(0, 0, 1);
  for (const TypeParam up : {TypeParam{3}, TypeParam{0}, TypeParam{-3}}) {
    this->scene.set_motion(floor, {0, 0, up});
    this->scene.commit();
    const auto hit = this->scene.first_hit(ball);
    ASSERT_TRUE(hit);
    EXPECT_EQ(this->scene.contact_normal(ball, *hit),
              (Vector3<TypeParam>{0, 0, up < 0 ? TypeParam{-1} : TypeParam{1}}));
  }
  this->scene.remove(floor);
  this->add(with_rows<TypeParam>({0, 1, 0}, {1, 0, 0}, {0, 0, 1}));  // mirrored
  this->scene.commit();
  EXPECT_EQ(this->scene.contact_normal(ball, *this->scene.first_hit(ball)), (Vector3<TypeParam>{0, 0, -1}));
}

// "The result is zero if its instance is not committed."

TYPED_TEST(SceneContacts, are_zero_for_what_is_not_there) {
  using Scalar = TypeParam;
  const auto ball = this->falling(4, 0, 1);
  const auto are_zero = [&](const SceneShapeHit<Scalar>& hit) {
    return this->scene.contact_point(hit).isZero(0) && this->scene.contact_normal(ball, hit).isZero(0);
  };
  EXPECT_TRUE(are_zero({}));
  const auto floor = this->add(at_height<Scalar>(1));
  EXPECT_TRUE(are_zero({{Scalar{0.5}, 0, 0, 0}, floor}));  // not committed yet
  this->scene.commit();
  const auto hit = this->scene.first_hit(ball);
  ASSERT_TRUE(hit);
  EXPECT_FALSE(are_zero(*hit));
  EXPECT_TRUE(are_zero({}));
  auto other = *hit;
  other.triangle = 1;
  EXPECT_TRUE(are_zero(other));
  other = *hit;
  ++other.instance.generation;
  EXPECT_TRUE(are_zero(other));
  other.instance = {7, 0};
  EXPECT_TRUE(are_zero(other));
  // No hit has such numbers.
  for (Scalar ShapeHit<Scalar>::*const number : {&ShapeHit<Scalar>::t, &ShapeHit<Scalar>::u, &ShapeHit<Scalar>::v}) {
    for (const Scalar wrong : {std::nextafter(Scalar{1}, Scalar{2}), -this->quarter, std::numeric_limits<Scalar>::max(),
                               std::numeric_limits<Scalar>::quiet_NaN()}) {
      other = *hit;
      other.*number = wrong;
      EXPECT_TRUE(this->scene.contact_point(other).isZero(0)) << wrong;
    }
  }
  // Nor does this shape touch anything, and these are no shapes.
  EXPECT_TRUE(this->scene.contact_normal(this->falling(4, 3, 1), *hit).isZero(0));
  EXPECT_TRUE(this->scene.contact_normal(this->falling(4, 0, -1), *hit).isZero(0));
  EXPECT_TRUE(
      this->scene.contact_normal(this->falling(std::numeric_limits<Scalar>::quiet_NaN(), 0, 1), *hit).isZero(0));
  this->scene.remove(floor);
  this->scene.commit();
  EXPECT_TRUE(are_zero(*hit));
}

}  // namespace
}  // namespace surehit::test::scene_contacts_test
