#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <optional>

#include "support/capsule_families.hpp"
#include "support/capsule_oracle.hpp"
#include "support/case_count.hpp"
#include "support/random.hpp"
#include "support/sphere_families.hpp"
#include "surehit/intersect.hpp"

namespace surehit::test::capsule_intersect_test {
namespace {

template <typename Scalar>
class CapsuleIntersect : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(CapsuleIntersect, Scalars);

/// The number of random pairs of a family. Integers of thousands of bits take their time.
template <typename Scalar>
std::size_t count_of(CapsuleFamily family) {
  const bool is_long = family == CapsuleFamily::mixed_magnitudes;
  return case_count(sizeof(Scalar) == 4 ? (is_long ? 300 : 1000) : (is_long ? 10 : 150));
}

TYPED_TEST(CapsuleIntersect, IsRightInEveryFieldForAllFamilies) {
  for (const CapsuleFamily family : all_capsule_families) {
    Random random(7 + static_cast<std::uint64_t>(family));
    std::size_t hits = 0;
    const std::size_t count = count_of<TypeParam>(family);
    for (std::size_t i = 0; i < count; ++i) {
      const auto [capsule, triangle] = draw_capsule_pair<TypeParam>(family, random);
      const auto hit = intersect(capsule, triangle);
      hits += hit.has_value();
      const auto error = find_error(capsule, triangle, hit);
      ASSERT_EQ(error, std::nullopt) << name_of(family) << ", case " << i;
    }
    EXPECT_GE(hits, count / 20) << name_of(family);
  }
}

TYPED_TEST(CapsuleIntersect, WithoutAnAxisHitsWhatABallHits) {
  using Scalar = TypeParam;
  for (const SphereFamily family : all_sphere_families) {
    Random random(3 + static_cast<std::uint64_t>(family));
    const bool is_long = family == SphereFamily::mixed_magnitudes;
    for (std::size_t i = 0; i < case_count(is_long ? 30 : 300); ++i) {
      const auto [sphere, triangle] = draw_sphere_pair<Scalar>(family, random);
      const SweptCapsule<Scalar> capsule{sphere.start, sphere.end, {0, -Scalar{0}, 0}, sphere.radius};
      ASSERT_TRUE(intersect(capsule, triangle) == intersect(sphere, triangle)) << name_of(family) << ", case " << i;
    }
  }
}

TYPED_TEST(CapsuleIntersect, DoesNotDependOnTheDirectionOfItsAxis) {
  using Scalar = TypeParam;
  for (const CapsuleFamily family : all_capsule_families) {
    Random random(5 + static_cast<std::uint64_t>(family));
    for (std::size_t i = 0; i < count_of<Scalar>(family) / 5; ++i) {
      const auto [capsule, triangle] = draw_capsule_pair<Scalar>(family, random);
      const SweptCapsule<Scalar> reversed{capsule.start, capsule.end, -capsule.half_axis, capsule.radius};
      ASSERT_TRUE(intersect(capsule, triangle) == intersect(reversed, triangle)) << name_of(family) << ", case " << i;
    }
  }
}

// A floor, and capsules of radius 1 and a core of length 4 that fall on it from a height of 3 over its radius.
template <typename Scalar>
Triangle<Scalar> floor() {
  return {{0, 0, 0}, {8, 0, 0}, {0, 8, 0}};
}
template <typename Scalar>
SweptCapsule<Scalar> upright(Scalar x, Scalar y) {
  return {{x, y, 6}, {x, y, -6}, {0, 0, 2}, 1};
}
template <typename Scalar>
SweptCapsule<Scalar> lying(Scalar x, Scalar y) {
  return {{x, y, 4}, {x, y, -2}, {2, 0, 0}, 1};
}

TYPED_TEST(CapsuleIntersect, NamesThePartThatAnEndTouches) {
  using Scalar = TypeParam;
  const auto feature_below = [](Scalar x, Scalar y) {
    const auto hit = intersect(upright<Scalar>(x, y), floor<Scalar>());
    return hit ? std::optional(hit->feature) : std::nullopt;
  };
  EXPECT_EQ(feature_below(1, 2), Feature::face);
  EXPECT_EQ(feature_below(4, 0), Feature::edge_ab);
  EXPECT_EQ(feature_below(4, Scalar(-0.5)), Feature::edge_ab);
  EXPECT_EQ(feature_below(4, 4), Feature::edge_bc);
  EXPECT_EQ(feature_below(Scalar(-0.5), 4), Feature::edge_ca);
  EXPECT_EQ(feature_below(0, 0), Feature::corner_a);
  EXPECT_EQ(feature_below(Scalar(-0.5), Scalar(-0.5)), Feature::corner_a);
  EXPECT_EQ(feature_below(Scalar(8.5), 0), Feature::corner_b);
  EXPECT_EQ(feature_below(0, Scalar(8.5)), Feature::corner_c);
  EXPECT_EQ(feature_below(4, -1), Feature::edge_ab);  // It grazes the edge.
  EXPECT_EQ(feature_below(4, Scalar(-1.001)), std::nullopt);
}

TYPED_TEST(CapsuleIntersect, TouchesThePointThatIsNearestToItsCentre) {
  using Scalar = TypeParam;
  struct Case {
    Scalar x, y, u, v;
    Feature feature;
  };
  constexpr Scalar eighth = Scalar(0.125);
  for (const Case& expected : {
           Case{3, 2, 3 * eighth, 2 * eighth, Feature::face},
           Case{1, 2, eighth, 2 * eighth, Feature::face},  // An end is beyond the edge.
           Case{-1, 2, 0, 2 * eighth, Feature::edge_ca},   // The centre is.
           Case{7, 2, 6 * eighth, 2 * eighth, Feature::edge_bc}, Case{-1, 8, 0, 1, Feature::corner_c},
           Case{3, 0, 3 * eighth, 0, Feature::edge_ab},  // The core lies along the edge.
           Case{0, 0, 0, 0, Feature::corner_a}, Case{-1, 0, 0, 0, Feature::corner_a},
           Case{9, 0, 1, 0, Feature::corner_b}, Case{10, 0, 1, 0, Feature::corner_b},
           Case{3, Scalar(-0.5), 3 * eighth, 0, Feature::edge_ab},  // It comes down beside the edge.
           Case{-1, Scalar(-0.5), 0, 0, Feature::corner_a}, Case{9, Scalar(-0.5), 1, 0, Feature::corner_b},
           Case{-2, 0, 0, 0, Feature::corner_a},
           Case{Scalar(-2.5), 3, 0, 3 * eighth, Feature::edge_ca},  // The end comes down beside the edge.
       }) {
    const SweptCapsule<Scalar> capsule = lying<Scalar>(expected.x, expected.y);
    const auto hit = intersect(capsule, floor<Scalar>());
    ASSERT_TRUE(hit) << expected.x << ", " << expected.y;
    EXPECT_EQ(hit->feature, expected.feature) << expected.x << ", " << expected.y;
    EXPECT_EQ(hit->u, expected.u) << expected.x << ", " << expected.y;
    EXPECT_EQ(hit->v, expected.v) << expected.x << ", " << expected.y;
    EXPECT_EQ(find_error(capsule, floor<Scalar>(), hit), std::nullopt);
    // It begins there, and in the plane.
    for (const Scalar height : {Scalar(0.5), Scalar{0}}) {
      if (expected.x == Scalar(-2.5)) continue;
      SweptCapsule<Scalar> resting = capsule;
      resting.start[2] = resting.end[2] = height;
      const auto same = intersect(resting, floor<Scalar>());
      ASSERT_TRUE(same) << expected.x << ", " << expected.y;
      EXPECT_TRUE(same->started_touching);
      EXPECT_EQ(same->feature, expected.feature) << expected.x << ", " << expected.y;
      EXPECT_EQ(same->u, expected.u);
      EXPECT_EQ(same->v, expected.v);
    }
  }
}

TYPED_TEST(CapsuleIntersect, LiesOnFloorsOfAnySize) {
  using Scalar = TypeParam;
  // Products of two such numbers overflow in double, or those of four.
  const int largest = std::numeric_limits<Scalar>::max_exponent * 3 / 5;
  for (const int exponent : {-largest, -largest / 2, largest / 2, largest}) {
    const Scalar unit = std::ldexp(Scalar{1}, exponent);
    const Triangle<Scalar> ground{{0, 0, 0}, {8 * unit, 0, 0}, {0, 8 * unit, 0}};
    const auto feature_below = [&](Scalar x, Scalar y, Scalar height) {
      const SweptCapsule<Scalar> capsule{
          {x * unit, y * unit, height * unit}, {x * unit, y * unit, -2 * unit}, {2 * unit, 0, 0}, unit};
      return intersect(capsule, ground)->feature;
    };
    for (const Scalar height : {Scalar{0}, Scalar{4}}) {
      EXPECT_EQ(feature_below(3, 2, height), Feature::face);
      EXPECT_EQ(feature_below(-1, 2, height), Feature::edge_ca);
      EXPECT_EQ(feature_below(7, 2, height), Feature::edge_bc);
      EXPECT_EQ(feature_below(-1, 8, height), Feature::corner_c);
      EXPECT_EQ(feature_below(3, 0, height), Feature::edge_ab);
      EXPECT_EQ(feature_below(9, 0, height), Feature::corner_b);
    }
  }
}

TYPED_TEST(CapsuleIntersect, StandsAtAWall) {
  using Scalar = TypeParam;
  const Triangle<Scalar> wall{{0, 0, 0}, {0, 8, 0}, {0, 0, 8}};
  const auto walks_at = [&](Scalar y, Scalar z) {
    return intersect(SweptCapsule<Scalar>{{3, y, z}, {-3, y, z}, {0, 0, 2}, 1}, wall);
  };
  const auto face = walks_at(2, 3);
  ASSERT_TRUE(face);
  EXPECT_EQ(face->t, Scalar{1} / 3);
  EXPECT_EQ(face->feature, Feature::face);
  EXPECT_EQ(face->u, Scalar(0.25));
  EXPECT_EQ(face->v, Scalar(0.375));
  EXPECT_EQ(walks_at(Scalar(-0.5), 3)->feature, Feature::edge_ca);  // It passes the corner of a building.
  EXPECT_EQ(walks_at(Scalar(-0.5), 3)->v, Scalar(0.375));
  EXPECT_EQ(walks_at(2, -1)->feature, Feature::edge_ab);
  EXPECT_EQ(walks_at(2, 7)->feature, Feature::edge_bc);
  EXPECT_EQ(walks_at(0, 9)->feature, Feature::corner_c);
}

TYPED_TEST(CapsuleIntersect, TouchesAWallThatIsOneUlpOffWithAnEnd) {
  using Scalar = TypeParam;
  Random random(19);
  for (std::size_t i = 0; i < case_count(100); ++i) {
    const auto draw = [&] { return random.symmetric<Scalar>(); };
    Triangle<Scalar> wall{{draw(), draw(), -2}, {draw(), draw(), draw()}, {0, 0, 2}};
    wall.c[0] = std::nextafter(wall.a[0], Scalar(random.one_in(2) ? 2 : -2));
    wall.c[1] = wall.a[1];
    const Vector3<Scalar> middle = (wall.a + wall.b + wall.c) / 3;
    const Vector3<Scalar> across = (wall.b - wall.a).cross(wall.c - wall.a);
    const Vector3<Scalar> step = across + Vector3<Scalar>(draw(), draw(), draw()) / 8;
    const SweptCapsule<Scalar> capsule{middle + step, middle - step, {0, 0, Scalar(0.125)}, Scalar(0.001)};
    ASSERT_EQ(find_error(capsule, wall, intersect(capsule, wall)), std::nullopt) << i;
  }
}

TYPED_TEST(CapsuleIntersect, CrossesATriangleAtItsStart) {
  using Scalar = TypeParam;
  const auto across = [](Scalar x, Scalar y, Scalar radius) {
    const SweptCapsule<Scalar> capsule{{x, y, 1}, {x, y, 1}, {1, 0, -2}, radius};
    return intersect(capsule, floor<Scalar>());
  };
  for (const Scalar radius : {Scalar{0}, Scalar{1}}) {
    const auto hit = across(Scalar(1.5), 1, radius);
    ASSERT_TRUE(hit);
    EXPECT_TRUE(hit->started_touching);
    EXPECT_EQ(hit->feature, Feature::face);
    EXPECT_EQ(hit->u, Scalar(0.25));
    EXPECT_EQ(hit->v, Scalar(0.125));
    EXPECT_EQ(across(Scalar(1.5), 0, radius)->feature, Feature::edge_ab);
    EXPECT_EQ(across(Scalar(1.5), 0, radius)->u, Scalar(0.25));
    EXPECT_EQ(across(Scalar(-0.5), 0, radius)->feature, Feature::corner_a);
  }
  EXPECT_FALSE(across(-1, 1, 0));
}

TYPED_TEST(CapsuleIntersect, CountsAContactInOnePoint) {
  using Scalar = TypeParam;
  // The core passes over an edge, across it.
  const auto pass = [](Scalar height) {
    return intersect(SweptCapsule<Scalar>{{-9, 0, height}, {9, 0, height}, {0, 3, 0}, 2},
                     Triangle<Scalar>{{0, -4, 0}, {0, 4, 0}, {0, 0, -4}});
  };
  const auto grazing = pass(2);
  ASSERT_TRUE(grazing);
  EXPECT_EQ(grazing->t, Scalar(0.5));
  EXPECT_EQ(grazing->feature, Feature::edge_ab);
  EXPECT_EQ(grazing->u, Scalar(0.5));
  EXPECT_FALSE(pass(std::nextafter(Scalar{2}, Scalar{3})));
  EXPECT_TRUE(pass(std::nextafter(Scalar{2}, Scalar{0})));
}

TYPED_TEST(CapsuleIntersect, TakesATriangleWithoutAreaForASegment) {
  using Scalar = TypeParam;
  const Triangle<Scalar> segment{{0, 0, 0}, {8, 0, 0}, {4, 0, 0}};
  const auto along = intersect(lying<Scalar>(3, 0), segment);
  ASSERT_TRUE(along);
  EXPECT_EQ(along->feature, Feature::edge_ab);
  EXPECT_EQ(along->u, Scalar(0.375));
  EXPECT_EQ(intersect(lying<Scalar>(-1, 0), segment)->feature, Feature::corner_a);
  EXPECT_EQ(intersect(lying<Scalar>(9, 0), segment)->feature, Feature::corner_b);
  // It lies beyond both ends.
  EXPECT_EQ(intersect(SweptCapsule<Scalar>{{9, 0, 4}, {9, 0, -2}, {20, 0, 0}, 1}, segment)->feature, Feature::corner_b);
  EXPECT_EQ(intersect(SweptCapsule<Scalar>{{-1, 0, 4}, {-1, 0, -2}, {20, 0, 0}, 1}, segment)->feature,
            Feature::corner_a);
  const SweptCapsule<Scalar> across{{3, 1, 4}, {3, 1, -2}, {0, 2, 0}, 1};
  EXPECT_EQ(intersect(across, segment)->feature, Feature::edge_ab);
  EXPECT_EQ(intersect(across, segment)->u, Scalar(0.375));
  const auto point = intersect(lying<Scalar>(-1, 0), Triangle<Scalar>{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
  ASSERT_TRUE(point);
  EXPECT_EQ(point->feature, Feature::corner_a);
  EXPECT_EQ(point->t, Scalar(0.5));
}

TYPED_TEST(CapsuleIntersect, ComparesTheExactTWithItsLimit) {
  using Scalar = TypeParam;
  const SweptCapsule<Scalar> capsule{{2, 1, 5}, {2, 1, -1}, {0, 0, 2}, 1};  // The exact t is 1/3.
  const bool is_rounded_up = sizeof(Scalar) == 4;
  const Scalar third = Scalar{1} / 3;
  const Scalar low = is_rounded_up ? std::nextafter(third, Scalar{0}) : third;
  EXPECT_FALSE(intersect(capsule, floor<Scalar>(), {.max_t = low}));
  EXPECT_TRUE(intersect(capsule, floor<Scalar>(), {.max_t = std::nextafter(low, Scalar{1})}));
  EXPECT_FALSE(intersect(capsule, floor<Scalar>(), {.culling = Culling::front}));
  EXPECT_TRUE(intersect(capsule, floor<Scalar>(), {.culling = Culling::back}));
}

TYPED_TEST(CapsuleIntersect, TouchesNothingUnlessAllNumbersAreFinite) {
  using Scalar = TypeParam;
  using Limits = std::numeric_limits<Scalar>;
  for (const Scalar x : {Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN()}) {
    EXPECT_FALSE(intersect(SweptCapsule<Scalar>{{x, 1, 3}, {2, 1, -3}, {0, 0, 1}, 1}, floor<Scalar>()));
    EXPECT_FALSE(intersect(SweptCapsule<Scalar>{{2, 1, 3}, {2, x, -3}, {0, 0, 1}, 1}, floor<Scalar>()));
    EXPECT_FALSE(intersect(SweptCapsule<Scalar>{{2, 1, 3}, {2, 1, -3}, {0, 0, x}, 1}, floor<Scalar>()));
    EXPECT_FALSE(intersect(SweptCapsule<Scalar>{{2, 1, 3}, {2, 1, -3}, {0, 0, 1}, x}, floor<Scalar>()));
  }
  EXPECT_FALSE(intersect(SweptCapsule<Scalar>{{2, 1, 3}, {2, 1, -3}, {0, 0, 1}, -1}, floor<Scalar>()));
}

}  // namespace
}  // namespace surehit::test::capsule_intersect_test
