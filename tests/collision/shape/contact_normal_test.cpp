#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "support/box_families.hpp"
#include "support/capsule_families.hpp"
#include "support/capsule_oracle.hpp"
#include "support/case_count.hpp"
#include "support/random.hpp"
#include "support/sphere_families.hpp"
#include "support/sphere_oracle.hpp"
#include "surehit/hit.hpp"
#include "surehit/intersect.hpp"

namespace surehit::test {
namespace {

template <typename Scalar>
class ContactNormal : public testing::Test {
 protected:
  /// What `contact_normal` promises.
  static constexpr double allowed = sizeof(Scalar) == 4 ? 0x1p-23 : 0x1p-49;
  static constexpr std::size_t count = sizeof(Scalar) == 4 ? 150 : 25;
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(ContactNormal, Scalars);

TYPED_TEST(ContactNormal, LeadsFromTheTouchedPointToTheCentreOfABall) {
  for (const SphereFamily family : all_sphere_families) {
    Random random(7 + static_cast<std::uint64_t>(family));
    for (std::size_t i = 0; i < case_count(this->count); ++i) {
      const auto [sphere, triangle] = draw_sphere_pair<TypeParam>(family, random);
      const auto hit = intersect(sphere, triangle);
      const Vector3<TypeParam> normal = contact_normal(sphere, triangle);
      if (!hit) {
        ASSERT_TRUE(normal.isZero(0)) << name_of(family) << ", case " << i;
        continue;
      }
      const auto error = find_error_of_normal(sphere, triangle, *hit, normal, this->allowed);
      ASSERT_EQ(error, std::nullopt) << name_of(family) << ", case " << i;
    }
  }
}

TYPED_TEST(ContactNormal, LeadsFromTheTouchedPointToTheCoreOfACapsule) {
  for (const CapsuleFamily family : all_capsule_families) {
    Random random(7 + static_cast<std::uint64_t>(family));
    for (std::size_t i = 0; i < case_count(this->count); ++i) {
      const auto [capsule, triangle] = draw_capsule_pair<TypeParam>(family, random);
      const auto hit = intersect(capsule, triangle);
      const Vector3<TypeParam> normal = contact_normal(capsule, triangle);
      if (!hit) {
        ASSERT_TRUE(normal.isZero(0)) << name_of(family) << ", case " << i;
        continue;
      }
      const auto error = find_error_of_normal(capsule, triangle, *hit, normal, this->allowed);
      ASSERT_EQ(error, std::nullopt) << name_of(family) << ", case " << i;
    }
  }
}

// Along the normal, all of the triangle is below all of the box.
TYPED_TEST(ContactNormal, SeparatesABoxFromTheTriangle) {
  using Scalar = TypeParam;
  for (const BoxFamily family : {BoxFamily::general, BoxFamily::small_integers}) {
    Random random(7 + static_cast<std::uint64_t>(family));
    std::size_t tested = 0;
    for (std::size_t i = 0; i < case_count(4 * this->count); ++i) {
      const auto [box, triangle] = draw_box_pair<Scalar>(family, random);
      const auto hit = intersect(box, triangle);
      const Vector3d normal = contact_normal(box, triangle).template cast<double>();
      if (!hit || hit->started_touching) continue;
      ASSERT_NEAR(normal.norm(), 1, this->allowed * 2);
      const Vector3d start = box.start.template cast<double>();
      const Vector3d centre = start + double{hit->t} * (box.end.template cast<double>() - start);
      const double reach = normal.cwiseAbs().dot(box.half_extents.template cast<double>());
      const double size = centre.norm() + reach + (box.end - box.start).template cast<double>().norm();
      for (const auto* corner : {&triangle.a, &triangle.b, &triangle.c}) {
        ASSERT_GE(normal.dot(centre - corner->template cast<double>()), reach - size * 8 * this->allowed)
            << name_of(family) << ", case " << i;
      }
      ++tested;
    }
    EXPECT_GE(tested, case_count(4 * this->count) / 10) << name_of(family);
  }
}

TYPED_TEST(ContactNormal, TakesTheAxesOfABoxFirst) {
  using Scalar = TypeParam;
  const Triangle<Scalar> floor = {{0, 0, 0}, {8, 0, 0}, {0, 8, 0}};
  const SweptBox<Scalar> falling = {{1, 1, 5}, {1, 1, 0}, {1, 1, 1}};
  EXPECT_EQ(contact_normal(falling, floor), (Vector3<Scalar>{0, 0, 1}));
  const SweptBox<Scalar> rising = {{1, 1, -5}, {1, 1, 0}, {1, 1, 1}};
  EXPECT_EQ(contact_normal(rising, floor), (Vector3<Scalar>{0, 0, -1}));
  // From the start, the shortest way out leads up by 1/2, or aside by 3/4.
  const SweptBox<Scalar> inside = {{4, Scalar(-0.25), Scalar(0.5)}, {4, 0, 0}, {1, 1, 1}};
  EXPECT_EQ(contact_normal(inside, floor), (Vector3<Scalar>{0, 0, 1}));
  const SweptBox<Scalar> beside = {{4, Scalar(-0.75), Scalar(0.5)}, {4, 0, 0}, {1, 1, 1}};
  EXPECT_EQ(contact_normal(beside, floor), (Vector3<Scalar>{0, -1, 0}));
}

// The centre is on the triangle, so the step decides the side.
TYPED_TEST(ContactNormal, IsThatOfTheTriangleAgainstTheStepWhereTheCentreMeetsIt) {
  using Scalar = TypeParam;
  const Triangle<Scalar> floor = {{0, 0, 0}, {8, 0, 0}, {0, 8, 0}};
  const auto normal_of = [&](const Vector3<Scalar>& end) {
    return contact_normal(SweptSphere<Scalar>{{1, 1, 0}, end, 1}, floor);
  };
  EXPECT_EQ(normal_of({1, 1, -3}), (Vector3<Scalar>{0, 0, 1}));
  EXPECT_EQ(normal_of({1, 1, 3}), (Vector3<Scalar>{0, 0, -1}));
  EXPECT_EQ(normal_of({1, 1, 0}), (Vector3<Scalar>{0, 0, 1}));
  const SweptCapsule<Scalar> across = {{1, 1, 0}, {1, 1, 2}, {0, 0, 3}, 1};
  EXPECT_EQ(contact_normal(across, floor), (Vector3<Scalar>{0, 0, -1}));
  const Triangle<Scalar> needle = {{0, 0, 0}, {8, 0, 0}, {4, 0, 0}};
  EXPECT_EQ(contact_normal(SweptSphere<Scalar>{{1, 0, 0}, {1, 0, 3}, 1}, needle), (Vector3<Scalar>{0, 0, 0}));
}

TYPED_TEST(ContactNormal, BelongsToAPointThatIsNearTheTouchedOne) {
  using Scalar = TypeParam;
  const Triangle<Scalar> triangle = {{1, 2, 3}, {5, 2, 3}, {1, 10, 7}};
  ShapeHit<Scalar> hit;
  hit.u = Scalar(0.25);
  hit.v = Scalar(0.5);
  EXPECT_EQ(contact_point(triangle, hit), (Vector3<Scalar>{2, 6, 5}));
  const Scalar large = std::numeric_limits<Scalar>::max();
  ShapeHit<Scalar> above_one;  // Weights are rounded, so their sum may be above 1.
  above_one.u = std::nextafter(Scalar(0.75), Scalar{1});
  above_one.v = Scalar(0.25);
  EXPECT_EQ(contact_point({{-large, 0, 0}, {large, 0, 0}, {large, 1, 0}}, above_one)[0], large);
  EXPECT_EQ(contact_point({{-large, 0, 0}, {large, 0, 0}, {0, large, 0}}, hit), (Vector3<Scalar>{0, large / 2, 0}));
}

}  // namespace
}  // namespace surehit::test
