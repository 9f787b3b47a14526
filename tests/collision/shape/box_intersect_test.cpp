#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

#include "support/box_families.hpp"
#include "support/box_oracle.hpp"
#include "support/case_count.hpp"
#include "support/random.hpp"
#include "surehit/intersect.hpp"

namespace surehit::test::box_intersect_test {
namespace {

template <typename Scalar>
class BoxIntersect : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(BoxIntersect, Scalars);

TYPED_TEST(BoxIntersect, IsRightInEveryFieldForAllFamilies) {
  for (const BoxFamily family : all_box_families) {
    Random random(7 + static_cast<std::uint64_t>(family));
    std::size_t hits = 0;
    const std::size_t count = case_count(sizeof(TypeParam) == 4 ? 2000 : 300);
    for (std::size_t i = 0; i < count; ++i) {
      const auto [box, triangle] = draw_box_pair<TypeParam>(family, random);
      const auto hit = intersect(box, triangle);
      hits += hit.has_value();
      const auto error = find_error(box, triangle, hit);
      ASSERT_EQ(error, std::nullopt) << name_of(family) << ", case " << i;
    }
    EXPECT_GE(hits, count / 20) << name_of(family);
  }
}

// A floor, and a box that falls on it from a height of 3.
template <typename Scalar>
constexpr Scalar third = Scalar{1} / Scalar{3};
template <typename Scalar>
Triangle<Scalar> floor() {
  return {{0, 0, 0}, {8, 0, 0}, {0, 8, 0}};
}
template <typename Scalar>
SweptBox<Scalar> falling(Scalar x, Scalar y) {
  return {{x, y, 3}, {x, y, -3}, {2, Scalar(0.5), 1}};
}

TYPED_TEST(BoxIntersect, TouchesThePointNearestToTheCentre) {
  using Scalar = TypeParam;
  const auto touches = [](Scalar x, Scalar y, Feature feature, Scalar u, Scalar v) {
    const auto hit = intersect(falling<Scalar>(x, y), floor<Scalar>());
    if (!hit) return false;
    EXPECT_EQ(hit->t, third<Scalar>);
    EXPECT_EQ(hit->feature, feature);
    EXPECT_EQ(hit->u, u);
    EXPECT_EQ(hit->v, v);
    return true;
  };
  // Below the centre, where that is in the triangle.
  EXPECT_TRUE(touches(1, 2, Feature::face, Scalar(0.125), Scalar(0.25)));
  EXPECT_TRUE(touches(4, 0, Feature::edge_ab, Scalar(0.5), 0));
  EXPECT_TRUE(touches(0, 0, Feature::corner_a, 0, 0));
  EXPECT_TRUE(touches(8, 0, Feature::corner_b, 1, 0));
  EXPECT_TRUE(touches(0, 8, Feature::corner_c, 0, 1));
  // Beside the triangle, on its outline.
  EXPECT_TRUE(touches(4, Scalar(-0.5), Feature::edge_ab, Scalar(0.5), 0));
  EXPECT_TRUE(touches(-2, 4, Feature::edge_ca, 0, Scalar(0.5)));
  EXPECT_TRUE(touches(-1, -Scalar(0.25), Feature::corner_a, 0, 0));
  EXPECT_TRUE(touches(5, 4, Feature::edge_bc, Scalar(0.5625), Scalar(0.4375)));
  EXPECT_TRUE(touches(9, Scalar(-0.5), Feature::corner_b, 1, 0));
  // The nearest point of the edge is not below the box: the box has a corner and a side there.
  EXPECT_TRUE(touches(6, Scalar(4.25), Feature::edge_bc, Scalar(0.53125), Scalar(0.46875)));
  EXPECT_TRUE(touches(Scalar(6.5), 4, Feature::edge_bc, Scalar(0.5625), Scalar(0.4375)));
  EXPECT_FALSE(touches(Scalar(6.5), Scalar(4.001), Feature::edge_bc, 0, 0));
  EXPECT_FALSE(touches(4, Scalar(-0.501), Feature::edge_ab, 0, 0));
}

TYPED_TEST(BoxIntersect, TouchesASlopeWithACornerAndAnEdgeWithAnEdge) {
  using Scalar = TypeParam;
  // The corner below in front meets x + y + z = 8 at (3, 2, 3).
  const Triangle<Scalar> slope{{8, 0, 0}, {0, 8, 0}, {0, 0, 8}};
  const auto hit = intersect(SweptBox<Scalar>{{4, 4, 8}, {4, 4, -8}, {1, 2, 1}}, slope);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->t, Scalar(0.25));
  EXPECT_EQ(hit->feature, Feature::face);
  EXPECT_EQ(hit->u, Scalar(0.25));
  EXPECT_EQ(hit->v, Scalar(0.375));
  // The lower edge along x meets the ridge y = 0, z = x at (1, 0, 1).
  const Triangle<Scalar> ridge{{-8, 0, -8}, {8, 0, 8}, {0, -8, -8}};
  const auto on_edge = intersect(SweptBox<Scalar>{{0, 2, 3}, {0, -2, 3}, {1, 1, 2}}, ridge);
  ASSERT_TRUE(on_edge);
  EXPECT_EQ(on_edge->t, Scalar(0.25));
  EXPECT_EQ(on_edge->feature, Feature::edge_ab);
  EXPECT_EQ(on_edge->u, Scalar(0.5625));
  EXPECT_EQ(on_edge->v, 0);
}

TYPED_TEST(BoxIntersect, StandsOnTwoTrianglesOfAFloor) {
  using Scalar = TypeParam;
  const Triangle<Scalar> other{{8, 8, 0}, {0, 8, 0}, {8, 0, 0}};
  const auto box = falling<Scalar>(3, 3);
  const auto near = intersect(box, floor<Scalar>());
  const auto beyond = intersect(box, other);
  ASSERT_TRUE(near && beyond);
  EXPECT_EQ(near->t, beyond->t);
  EXPECT_EQ(near->feature, Feature::face);
  EXPECT_EQ(near->u, Scalar(0.375));
  EXPECT_EQ(near->v, Scalar(0.375));
  EXPECT_EQ(beyond->feature, Feature::edge_bc);  // The point (4, 4) would be beyond the box in y.
  EXPECT_EQ(beyond->u, Scalar(0.4375));
  EXPECT_EQ(beyond->v, Scalar(0.5625));
}

TYPED_TEST(BoxIntersect, CountsAContactInOnePoint) {
  using Scalar = TypeParam;
  const auto slide = [](Scalar height) {
    return intersect(SweptBox<Scalar>{{-9, 1, height}, {9, 1, height}, {1, 1, 2}}, floor<Scalar>());
  };
  const auto grazing = slide(2);
  ASSERT_TRUE(grazing);
  EXPECT_EQ(grazing->t, static_cast<Scalar>(4.0 / 9));
  EXPECT_EQ(grazing->feature, Feature::edge_ca);
  EXPECT_FALSE(slide(std::nextafter(Scalar{2}, Scalar{3})));
  EXPECT_TRUE(slide(std::nextafter(Scalar{2}, Scalar{0})));
  // It passes corner b with an edge.
  const auto pass = [](Scalar x) {
    return intersect(SweptBox<Scalar>{{x, -9, 0}, {x, 9, 0}, {1, 1, 1}}, floor<Scalar>());
  };
  EXPECT_EQ(pass(9)->feature, Feature::corner_b);
  EXPECT_FALSE(pass(std::nextafter(Scalar{9}, Scalar{10})));
}

TYPED_TEST(BoxIntersect, EndsWithAContact) {
  using Scalar = TypeParam;
  const auto until = [](Scalar height) {
    return intersect(SweptBox<Scalar>{{2, 1, 3}, {2, 1, height}, {1, 1, 1}}, floor<Scalar>());
  };
  ASSERT_TRUE(until(1));
  EXPECT_EQ(until(1)->t, 1);
  EXPECT_FALSE(until(std::nextafter(Scalar{1}, Scalar{2})));
}

TYPED_TEST(BoxIntersect, BeginsWithAContact) {
  using Scalar = TypeParam;
  const SweptBox<Scalar> rising{{2, 1, 1}, {2, 1, 9}, {3, 3, 1}};  // It stands on the floor, and leaves it.
  const auto hit = intersect(rising, floor<Scalar>());
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->t, 0);
  EXPECT_TRUE(hit->started_touching);
  EXPECT_EQ(hit->feature, Feature::face);
  EXPECT_EQ(hit->u, Scalar(0.25));
  EXPECT_EQ(hit->v, Scalar(0.125));
  EXPECT_FALSE(intersect(rising, floor<Scalar>(), {.ignore_start_contact = true}));
  EXPECT_TRUE(intersect(falling<Scalar>(2, 1), floor<Scalar>(), {.ignore_start_contact = true}));
  EXPECT_TRUE(intersect(SweptBox<Scalar>{{2, 1, 1}, {2, 1, 1}, {1, 1, 1}}, floor<Scalar>()));  // It stays there.
}

TYPED_TEST(BoxIntersect, ComparesTheExactTWithItsLimit) {
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
  EXPECT_TRUE(intersect(SweptBox<Scalar>{{2, 1, 0}, {9, 9, 9}, {1, 1, 1}}, floor<Scalar>(), {.max_t = 0}));
}

TYPED_TEST(BoxIntersect, LeavesOutSidesByTheDirectionOfTheStep) {
  using Scalar = TypeParam;
  const auto falls = falling<Scalar>(2, 1);
  const SweptBox<Scalar> rises{falls.end, falls.start, falls.half_extents};
  const SweptBox<Scalar> slides{{-9, 1, 0}, {9, 1, 0}, falls.half_extents};
  for (const auto& [box, front, back] :
       {std::tuple{falls, true, false}, std::tuple{rises, false, true}, std::tuple{slides, false, false}}) {
    EXPECT_TRUE(intersect(box, floor<Scalar>()));
    EXPECT_EQ(intersect(box, floor<Scalar>(), {.culling = Culling::back}).has_value(), front);
    EXPECT_EQ(intersect(box, floor<Scalar>(), {.culling = Culling::front}).has_value(), back);
  }
}

TYPED_TEST(BoxIntersect, TouchesNothingUnlessAllNumbersAreFinite) {
  using Scalar = TypeParam;
  using Limits = std::numeric_limits<Scalar>;
  const SweptBox<Scalar> good{{2, 1, 3}, {2, 1, -3}, {1, 1, 1}};
  EXPECT_TRUE(intersect(good, floor<Scalar>()));
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    for (const Scalar x : {Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN()}) {
      for (Vector3<Scalar> SweptBox<Scalar>::*member :
           {&SweptBox<Scalar>::start, &SweptBox<Scalar>::end, &SweptBox<Scalar>::half_extents}) {
        SweptBox<Scalar> box = good;
        (box.*member)[axis] = x;
        EXPECT_FALSE(intersect(box, floor<Scalar>()));
      }
      Triangle<Scalar> triangle = floor<Scalar>();
      triangle.b[axis] = x;
      EXPECT_FALSE(intersect(good, triangle));
    }
    for (const Scalar x : {Scalar{-1}, -Limits::denorm_min()}) {
      SweptBox<Scalar> box = good;
      box.half_extents[axis] = x;
      EXPECT_FALSE(intersect(box, floor<Scalar>()));
    }
  }
}

TYPED_TEST(BoxIntersect, NamesThePartsOfTrianglesWithoutArea) {
  using Scalar = TypeParam;
  // The edge goes from c to b, and a is between them.
  const Triangle<Scalar> needle{{2, 0, 0}, {8, 0, 0}, {0, 0, 0}};
  const auto touched = [&](Scalar x) {
    const auto hit = intersect(SweptBox<Scalar>{{x, 0, 3}, {x, 0, -3}, {1, 1, 1}}, needle);
    return std::tuple(hit->feature, hit->u, hit->v);
  };
  EXPECT_EQ(touched(2), std::tuple(Feature::edge_bc, Scalar(0.25), Scalar(0.75)));
  EXPECT_EQ(touched(-1), std::tuple(Feature::corner_c, Scalar(0), Scalar(1)));
  EXPECT_EQ(touched(9), std::tuple(Feature::corner_b, Scalar(1), Scalar(0)));
  const Vector3<Scalar> point = {1, 1, 0};
  const auto hit = intersect(falling<Scalar>(1, 1), Triangle<Scalar>{point, point, point});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->feature, Feature::corner_a);
  EXPECT_EQ(hit->t, third<Scalar>);
}

}  // namespace
}  // namespace surehit::test::box_intersect_test
