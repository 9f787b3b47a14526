#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

#include "support/case_count.hpp"
#include "support/random.hpp"
#include "support/sphere_families.hpp"
#include "support/sphere_oracle.hpp"
#include "surehit/intersect.hpp"

namespace surehit::test::sphere_intersect_test {
namespace {

template <typename Scalar>
class SphereIntersect : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(SphereIntersect, Scalars);

TYPED_TEST(SphereIntersect, IsRightInEveryFieldForAllFamilies) {
  for (const SphereFamily family : all_sphere_families) {
    Random random(7 + static_cast<std::uint64_t>(family));
    std::size_t hits = 0;
    const std::size_t count = case_count(sizeof(TypeParam) == 4 ? 2000 : 300);
    for (std::size_t i = 0; i < count; ++i) {
      const auto [sphere, triangle] = draw_sphere_pair<TypeParam>(family, random);
      const auto hit = intersect(sphere, triangle);
      hits += hit.has_value();
      const auto error = find_error(sphere, triangle, hit);
      ASSERT_EQ(error, std::nullopt) << name_of(family) << ", case " << i;
    }
    EXPECT_GE(hits, count / 20) << name_of(family);
  }
}

// A floor, and a ball of radius 1 that falls on it from a height of 3.
template <typename Scalar>
constexpr Scalar third = Scalar{1} / Scalar{3};
template <typename Scalar>
Triangle<Scalar> floor() {
  return {{0, 0, 0}, {8, 0, 0}, {0, 8, 0}};
}
template <typename Scalar>
SweptSphere<Scalar> falling(Scalar x, Scalar y) {
  return {{x, y, 3}, {x, y, -3}, 1};
}

TYPED_TEST(SphereIntersect, NamesThePartThatIsTouched) {
  using Scalar = TypeParam;
  const auto feature_below = [](Scalar x, Scalar y) {
    const auto hit = intersect(falling<Scalar>(x, y), floor<Scalar>());
    return hit ? std::optional(hit->feature) : std::nullopt;
  };
  EXPECT_EQ(feature_below(1, 2), Feature::face);
  EXPECT_EQ(feature_below(4, 0), Feature::edge_ab);
  EXPECT_EQ(feature_below(4, Scalar(-0.5)), Feature::edge_ab);
  EXPECT_EQ(feature_below(4, 4), Feature::edge_bc);
  EXPECT_EQ(feature_below(Scalar(4.5), Scalar(4.5)), Feature::edge_bc);
  EXPECT_EQ(feature_below(Scalar(-0.5), 4), Feature::edge_ca);
  EXPECT_EQ(feature_below(0, 0), Feature::corner_a);
  EXPECT_EQ(feature_below(Scalar(-0.5), Scalar(-0.5)), Feature::corner_a);
  EXPECT_EQ(feature_below(8, 0), Feature::corner_b);
  EXPECT_EQ(feature_below(0, Scalar(8.5)), Feature::corner_c);
  EXPECT_EQ(feature_below(4, -1), Feature::edge_ab);  // It grazes the edge.
  EXPECT_EQ(feature_below(4, Scalar(-1.001)), std::nullopt);
}

TYPED_TEST(SphereIntersect, RoundsTAndTheWeights) {
  using Scalar = TypeParam;
  const auto hit = intersect(falling<Scalar>(2, 1), floor<Scalar>());
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->t, third<Scalar>);
  EXPECT_EQ(hit->u, Scalar(0.25));
  EXPECT_EQ(hit->v, Scalar(0.125));
  EXPECT_EQ(hit->triangle, 0U);
  EXPECT_FALSE(hit->started_touching);
  // At the edge from b to c, both weights are rounded by themselves.
  const auto beside = intersect(falling<Scalar>(6, 3), floor<Scalar>());
  ASSERT_TRUE(beside);
  EXPECT_EQ(beside->feature, Feature::edge_bc);
  EXPECT_EQ(beside->u, Scalar(0.6875));
  EXPECT_EQ(beside->v, Scalar(0.3125));
}

TYPED_TEST(SphereIntersect, CountsAContactInOnePoint) {
  using Scalar = TypeParam;
  const auto slide = [](Scalar height) {
    return intersect(SweptSphere<Scalar>{{-9, 1, height}, {9, 1, height}, 2}, floor<Scalar>());
  };
  const auto grazing = slide(2);
  ASSERT_TRUE(grazing);
  EXPECT_EQ(grazing->t, Scalar(0.5));
  EXPECT_EQ(grazing->feature, Feature::edge_ca);
  EXPECT_FALSE(slide(std::nextafter(Scalar{2}, Scalar{3})));
  EXPECT_TRUE(slide(std::nextafter(Scalar{2}, Scalar{0})));
}

TYPED_TEST(SphereIntersect, RollsOverTheFirstOfTwoEdges) {
  using Scalar = TypeParam;
  // The ball stays at the height of its radius, and comes to the edges ca and bc, one after the other.
  const SweptSphere<Scalar> there{{-4, 2, 1}, {12, 2, 1}, 1};
  const SweptSphere<Scalar> back{there.end, there.start, 1};
  EXPECT_EQ(intersect(there, floor<Scalar>())->feature, Feature::edge_ca);
  EXPECT_EQ(intersect(there, floor<Scalar>())->t, Scalar(0.25));
  EXPECT_EQ(intersect(back, floor<Scalar>())->feature, Feature::edge_bc);
  EXPECT_EQ(intersect(back, floor<Scalar>())->t, Scalar(0.375));
  // Along an edge, it comes to one corner and then to the other.
  const SweptSphere<Scalar> along{{-8, 0, 1}, {24, 0, 1}, 1};
  EXPECT_EQ(intersect(along, floor<Scalar>())->feature, Feature::corner_a);
  EXPECT_EQ(intersect(SweptSphere<Scalar>{along.end, along.start, 1}, floor<Scalar>())->feature, Feature::corner_b);
}

TYPED_TEST(SphereIntersect, EndsWithAContact) {
  using Scalar = TypeParam;
  const auto until = [](Scalar x, Scalar y, Scalar height) {
    return intersect(SweptSphere<Scalar>{{x, y, 3}, {x, y, height}, 1}, floor<Scalar>());
  };
  for (const auto& [x, y, feature] :
       {std::tuple{2, 1, Feature::face}, std::tuple{4, 0, Feature::edge_ab}, std::tuple{0, 0, Feature::corner_a}}) {
    const auto hit = until(static_cast<Scalar>(x), static_cast<Scalar>(y), 1);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->t, 1);
    EXPECT_EQ(hit->feature, feature);
    EXPECT_FALSE(until(static_cast<Scalar>(x), static_cast<Scalar>(y), std::nextafter(Scalar{1}, Scalar{2})));
  }
}

TYPED_TEST(SphereIntersect, BeginsWithAContact) {
  using Scalar = TypeParam;
  const SweptSphere<Scalar> rising{{2, 1, 1}, {2, 1, 9}, 1};  // It rests on the floor, and leaves it.
  const auto hit = intersect(rising, floor<Scalar>());
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->t, 0);
  EXPECT_TRUE(hit->started_touching);
  EXPECT_EQ(hit->feature, Feature::face);
  EXPECT_EQ(hit->u, Scalar(0.25));
  EXPECT_FALSE(intersect(rising, floor<Scalar>(), {.ignore_start_contact = true}));
  EXPECT_TRUE(intersect(falling<Scalar>(2, 1), floor<Scalar>(), {.ignore_start_contact = true}));
  EXPECT_TRUE(intersect(SweptSphere<Scalar>{{2, 1, 1}, {2, 1, 1}, 1}, floor<Scalar>()));  // It stays there.
}

TYPED_TEST(SphereIntersect, ComparesTheExactTWithItsLimit) {
  using Scalar = TypeParam;
  const auto until = [](Scalar max_t) {
    return intersect(falling<Scalar>(2, 1), floor<Scalar>(), {.max_t = max_t}).has_value();
  };
  // The exact t is 1/3, which is between two Scalars.
  const bool is_rounded_up = sizeof(Scalar) == 4;  // 1/3 is rounded up to a float, and down to a double.
  const Scalar low = is_rounded_up ? std::nextafter(third<Scalar>, Scalar{0}) : third<Scalar>;
  EXPECT_FALSE(until(low));
  EXPECT_TRUE(until(std::nextafter(low, Scalar{1})));
  EXPECT_TRUE(until(1));
  EXPECT_TRUE(until(std::numeric_limits<Scalar>::infinity()));
  EXPECT_FALSE(until(0));
  EXPECT_FALSE(until(-1));
  EXPECT_FALSE(until(std::numeric_limits<Scalar>::quiet_NaN()));
  const auto at_start = intersect(SweptSphere<Scalar>{{2, 1, 0}, {9, 9, 9}, 1}, floor<Scalar>(), {.max_t = 0});
  EXPECT_TRUE(at_start);
}

TYPED_TEST(SphereIntersect, LeavesOutSidesByTheDirectionOfTheStep) {
  using Scalar = TypeParam;
  const auto falls = falling<Scalar>(2, 1);
  const SweptSphere<Scalar> rises{falls.end, falls.start, 1};
  const SweptSphere<Scalar> slides{{-9, 1, 0}, {9, 1, 0}, 1};
  for (const auto& [sphere, front, back] :
       {std::tuple{falls, true, false}, std::tuple{rises, false, true}, std::tuple{slides, false, false}}) {
    EXPECT_TRUE(intersect(sphere, floor<Scalar>()));
    EXPECT_EQ(intersect(sphere, floor<Scalar>(), {.culling = Culling::back}).has_value(), front);
    EXPECT_EQ(intersect(sphere, floor<Scalar>(), {.culling = Culling::front}).has_value(), back);
  }
}

TYPED_TEST(SphereIntersect, TouchesNothingUnlessAllNumbersAreFinite) {
  using Scalar = TypeParam;
  using Limits = std::numeric_limits<Scalar>;
  for (const Scalar x : {Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN()}) {
    EXPECT_FALSE(intersect(SweptSphere<Scalar>{{x, 1, 3}, {2, 1, -3}, 1}, floor<Scalar>()));
    EXPECT_FALSE(intersect(SweptSphere<Scalar>{{2, 1, 3}, {2, x, -3}, 1}, floor<Scalar>()));
    EXPECT_FALSE(intersect(SweptSphere<Scalar>{{2, 1, 3}, {2, 1, -3}, x}, floor<Scalar>()));
    Triangle<Scalar> triangle = floor<Scalar>();
    triangle.b[0] = x;
    EXPECT_FALSE(intersect(falling<Scalar>(2, 1), triangle));
  }
  EXPECT_FALSE(intersect(SweptSphere<Scalar>{{2, 1, 3}, {2, 1, -3}, -1}, floor<Scalar>()));
  EXPECT_FALSE(intersect(SweptSphere<Scalar>{{2, 1, 3}, {2, 1, -3}, -Limits::denorm_min()}, floor<Scalar>()));
}

// What other engines pass over: Jolt takes an edge for parallel to so short a step, and PhysX gives up a triangle in
// whose plane the ball moves.
TYPED_TEST(SphereIntersect, TouchesAnEdgeWithAShortStepInItsPlane) {
  using Scalar = TypeParam;
  const Triangle<Scalar> triangle{{Scalar(-0.05), 0, 0}, {Scalar(0.05), 0, 0}, {0, Scalar(0.1), 0}};
  const SweptSphere<Scalar> sphere{{0, Scalar(-0.055), 0}, {0, Scalar(-0.046), 0}, Scalar(0.05)};
  const auto hit = intersect(sphere, triangle);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->feature, Feature::edge_ab);
  EXPECT_NEAR(hit->t, 0.5556, 1e-4);
  EXPECT_EQ(find_error(sphere, triangle, hit), std::nullopt);
}

}  // namespace
}  // namespace surehit::test::sphere_intersect_test
