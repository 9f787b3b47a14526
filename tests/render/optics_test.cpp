#include "render/optics.hpp"

#include <gtest/gtest.h>

namespace surehit::example::optics_test {
namespace {

const Vector3f upwards(0, 0, 1);

Vector3f downwards_at(float sine) { return {sine, 0, -std::sqrt(1 - sine * sine)}; }

TEST(Optics, a_mirror_turns_the_part_along_its_normal) {
  EXPECT_EQ(reflected({3, 4, -5}, upwards), Vector3f(3, 4, 5));
  EXPECT_EQ(reflected({3, 4, -5}, -upwards), Vector3f(3, 4, 5));
}

TEST(Optics, glass_follows_Snell) {
  for (const float sine : {0.0f, 0.3f, 0.6f, 0.9f}) {
    const Refraction into_glass = refracted(downwards_at(sine), upwards, 1 / 1.5f);
    EXPECT_NEAR(into_glass.direction.x(), sine / 1.5f, 1e-6);
    EXPECT_LT(into_glass.direction.z(), 0);
    EXPECT_NEAR(into_glass.direction.norm(), 1, 1e-6);
    // The way back is the same.
    const Refraction back = refracted(-into_glass.direction, -upwards, 1.5f);
    EXPECT_NEAR(back.direction.x(), -sine, 1e-5);
    EXPECT_NEAR(back.reflected_share, into_glass.reflected_share, 1e-5);
  }
}

TEST(Optics, glass_follows_Fresnel) {
  EXPECT_NEAR(refracted(downwards_at(0), upwards, 1 / 1.5f).reflected_share, 0.04, 1e-6);
  EXPECT_NEAR(refracted(downwards_at(0), upwards, 1.5f).reflected_share, 0.04, 1e-6);
  EXPECT_EQ(refracted(downwards_at(0.7f), upwards, 1).reflected_share, 0) << "there is no surface to be seen";
  // At Brewster's angle, whose tangent is 1.5, the light in the plane is not reflected at all.
  const float across = (1.5f * 1.5f - 1) / (1.5f * 1.5f + 1);
  EXPECT_NEAR(refracted(downwards_at(1.5f / std::sqrt(3.25f)), upwards, 1 / 1.5f).reflected_share, across * across / 2,
              1e-6);
  EXPECT_GT(refracted(downwards_at(0.9999f), upwards, 1 / 1.5f).reflected_share, 0.9f);
}

TEST(Optics, glass_keeps_light_inside_beyond_the_critical_angle) {
  const Refraction below = refracted(downwards_at(0.66f), upwards, 1.5f);
  EXPECT_LT(below.reflected_share, 1);
  const Refraction beyond = refracted(downwards_at(0.67f), upwards, 1.5f);
  EXPECT_EQ(beyond.reflected_share, 1);
  EXPECT_EQ(beyond.direction, Vector3f(0, 0, 0));
}

TEST(Optics, polish_shows_at_grazing_angles) {
  EXPECT_EQ(polished_share(0.04f, 1), 0.04f);
  EXPECT_EQ(polished_share(0.04f, 0), 1);
  EXPECT_EQ(polished_share(0, 0.5f), 1.0f / 32);
}

TEST(Optics, powers_are_products) {
  EXPECT_EQ(whole_power(3, 1), 3);
  EXPECT_EQ(whole_power(3, 5), 243);
  EXPECT_EQ(whole_power(0.5f, 10), 0x1p-10f);
}

}  // namespace
}  // namespace surehit::example::optics_test
