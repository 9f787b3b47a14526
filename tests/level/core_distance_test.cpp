#include "character/core_distance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <surehit/intersect.hpp>

#include "character/capsule_sweep.hpp"
#include "support/random.hpp"

namespace surehit::example::core_distance_test {
namespace {

/// A body that touches a triangle in exactly one point, and a direction that leads away from it.
struct Touch {
  const char* name;
  Vector3f position;
  Vector3f away;
  Trianglef triangle;
};

const Touch touches[] = {
    {"floor", {0, 0, 0.75f}, {0, 0, 1}, {{-4, -4, 0}, {4, -4, 0}, {0, 4, 0}}},
    {"corner", {0, 0, 0.75f}, {0, 0, 1}, {{0, 0, 0}, {4, 0, -1}, {0, 4, -1}}},
    {"edge", {0, 0, 0.75f}, {0, 0, 1}, {{-4, 0, 0}, {4, 0, 0}, {0, 1, -4}}},
    {"wall", {0, 0, 0}, {-1, 0, 0}, {{0.25f, 0.125f, -4}, {-2.75f, 2.375f, 4}, {3.25f, -2.125f, 4}}},
    {"upright edge", {0, 0, 0}, {-1, 0, 0}, {{0.25f, 0, -4}, {0.25f, 0, 4}, {4, 1, 0}}},
    {"slope", {0, 0, -0.5f}, {-1, 0, 0}, {{-8.125f, 4, 1}, {6.875f, -8, 2}, {0.875f, 4, -2}}},
};

TEST(CoreDistance, what_doubles_say_is_true_however_near_the_touch) {
  for (const Touch& touch : touches) {
    const auto exact = touches_exactly(touch.position, touch.position, touch.triangle);
    if (!exact) GTEST_SKIP() << "without GMP";
    ASSERT_TRUE(*exact) << touch.name;
    EXPECT_EQ(core_distance(touch.position, touch.position, touch.triangle).verdict, Verdict::unsure) << touch.name;
    for (int exponent = 1; exponent < 140; ++exponent) {
      for (const float side : {1.0f, -1.0f}) {
        // The triangle moves, because its coordinates may be tiny.
        const Vector3f offset = -side * std::ldexp(1.0f, -exponent) * touch.away;
        Trianglef triangle = touch.triangle;
        Vector3f position = touch.position;
        for (int axis = 0; axis < 3; ++axis) {
          if (offset[axis] == 0) continue;
          if (position[axis] == 0) {
            position[axis] = -offset[axis];
          } else {
            for (Vector3f* corner : {&triangle.a, &triangle.b, &triangle.c}) (*corner)[axis] += offset[axis];
          }
        }
        const bool is_touching = *touches_exactly(position, position, triangle);
        const Verdict verdict = core_distance(position, position, triangle).verdict;
        const auto what =
            std::string(touch.name) + (side > 0 ? " and away by 2^-" : " and nearer by 2^-") + std::to_string(exponent);
        EXPECT_NE(verdict, is_touching ? Verdict::free : Verdict::touching) << what;
        if (exponent > 20) continue;
        EXPECT_NE(verdict, Verdict::unsure) << what;
        EXPECT_EQ(is_touching, side < 0) << what;
      }
    }
  }
}

TEST(CoreDistance, roundings_do_not_part_what_touches) {
  // All corners are on 3 x + 4 y = 1.25, at a distance of 1/4 from the upright core. Their products are rounded.
  test::Random random(8);
  const auto corner = [&](int low, int high, int z) -> Vector3f {
    const float s = static_cast<float>(random.between(low, high)) * 0x1p-20f;
    return {0.25f - 4 * s, 0.125f + 3 * s,
            static_cast<float>(z) + static_cast<float>(random.between(0, 1 << 20)) * 0x1p-20f};
  };
  constexpr int far = 1 << 20;
  for (int i = 0; i < 2'000; ++i) {
    const Trianglef wall{corner(-far, -far / 4, -2), corner(far / 4, far, -2), corner(-far / 16, far / 16, 4)};
    if (i < 50) {
      const auto exact = touches_exactly({0, 0, 0}, {0, 0, 0}, wall);
      if (!exact) GTEST_SKIP() << "without GMP";
      ASSERT_TRUE(*exact);
      ASSERT_FALSE(*touches_exactly({-0x1p-60f, 0, 0}, {-0x1p-60f, 0, 0}, wall));
    }
    ASSERT_NE(core_distance({0, 0, 0}, {0, 0, 0}, wall).verdict, Verdict::free) << "case " << i;
    ASSERT_NE(core_distance({-0x1p-60f, 0, 0}, {-0x1p-60f, 0, 0}, wall).verdict, Verdict::touching) << "case " << i;
  }
}

TEST(CoreDistance, agrees_with_rationals_and_with_the_library) {
  test::Random random(3);
  const auto place = [&](int low, int high, float unit) -> Vector3f {
    const auto x = [&] { return unit * static_cast<float>(random.between(low, high)); };
    return {x(), x(), x()};
  };
  int unsure = 0;
  int touching = 0;
  constexpr int cases = 600;
  for (int i = 0; i < cases; ++i) {
    // Multiples of 1/4, so some touch in exactly one point. The other half has numbers of any kind.
    const bool is_round = i % 2 == 0;
    const float unit = is_round ? 0.25f : 0.123456789f;
    const int size = is_round ? 3 : 8;
    const Trianglef triangle{place(-size, size, unit), place(-size, size, unit), place(-size, size, unit)};
    const Vector3f from = place(-size, size, unit);
    const Vector3f to = i % 5 == 0 ? from : Vector3f(from + place(-3, 3, unit));
    const auto exact = touches_exactly(from, to, triangle);
    if (!exact) GTEST_SKIP() << "without GMP";
    const bool is_hit = intersect(SweptCapsulef{from, to, Body::half_axis(), Body::radius}, triangle).has_value();
    ASSERT_EQ(*exact, is_hit) << "case " << i;
    const Verdict verdict = core_distance(from, to, triangle).verdict;
    ASSERT_NE(verdict, *exact ? Verdict::free : Verdict::touching) << "case " << i;
    unsure += verdict == Verdict::unsure;
    touching += *exact;
  }
  EXPECT_GT(touching, cases / 10);
  EXPECT_LT(touching, cases * 9 / 10);
  EXPECT_GT(unsure, 0);
  EXPECT_LT(unsure, cases / 5);
}

TEST(CoreDistance, measures_how_near_they_come) {
  const Trianglef floor{{-4, -4, 0}, {4, -4, 0}, {0, 4, 0}};
  const CoreDistance near = core_distance({0, 0, 0.625f}, {1, 0, 0.625f}, floor);
  EXPECT_EQ(near.verdict, Verdict::touching);
  EXPECT_NEAR(near.upper, 0.125, 1e-12);
  EXPECT_NEAR(core_distance({0, 0, 0.25f}, {0, 0, 0.25f}, floor).upper, 0, 1e-12) << "the core goes through it";
  EXPECT_EQ(core_distance({0, 0, 3}, {0, 0, -3}, floor).verdict, Verdict::touching);
  EXPECT_EQ(core_distance({0, 0, 3}, {0, 0, 1}, floor).verdict, Verdict::free);
}

TEST(CoreDistance, takes_triangles_without_area) {
  const Trianglef post{{0.5f, 0, -1}, {0.5f, 0, 1}, {0.5f, 0, 0}};
  EXPECT_EQ(core_distance({0, 0, 0}, {0.125f, 0, 0}, post).verdict, Verdict::free);
  EXPECT_EQ(core_distance({0, 0, 0}, {0.375f, 0, 0}, post).verdict, Verdict::touching);
  if (const auto exact = touches_exactly({0, 0, 0}, {0.25f, 0, 0}, post)) {
    EXPECT_TRUE(*exact);
    EXPECT_FALSE(*touches_exactly({0, 0, 0}, {std::nextafter(0.25f, 0.0f), 0, 0}, post));
  }
}

}  // namespace
}  // namespace surehit::example::core_distance_test
