#include "character/clearance_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <surehit/collider.hpp>

#include "character/capsule_sweep.hpp"
#include "level/level.hpp"
#include "support/random.hpp"

namespace surehit::example::clearance_check_test {
namespace {

/// A floor at z = 0 from 0 to 8, and a thin wall on it at x = 4.
Mesh<float> floor_and_wall() {
  Mesh<float> mesh;
  mesh.vertices = {{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}, {4, 0, 0}, {4, 8, 0}, {4, 8, 3}, {4, 0, 3}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
  return mesh;
}

TEST(ClearanceCheck, sees_what_touches) {
  const ClearanceCheck check(floor_and_wall());
  EXPECT_FALSE(check.check({1, 1, 1}, {3, 7, 1}).is_touching);
  EXPECT_TRUE(check.check({1, 1, 1}, {7, 1, 1}).is_touching) << "through the wall";
  EXPECT_NEAR(check.check({1, 1, 1}, {3.875f, 1, 1}).depth, 0.125, 1e-9);
  EXPECT_FALSE(check.check({1, 1, 4}, {7, 1, 4}).is_touching) << "over it";
  EXPECT_TRUE(check.check({1, 1, 1}, {1, 1, -1}).is_touching) << "through the floor";
  EXPECT_FALSE(check.check({-20, 1, 1}, {-20, 1, -9}).is_touching) << "beside it";
}

TEST(ClearanceCheck, tells_an_ulp) {
  const ClearanceCheck check(floor_and_wall());
  if (!check.check({1, 1, 0.75f}, {1, 1, 0.75f}).is_certain) GTEST_SKIP() << "without GMP";
  EXPECT_TRUE(check.check({1, 1, 0.75f}, {3, 1, 0.75f}).is_touching);
  const float above = std::nextafter(0.75f, 1.0f);
  EXPECT_FALSE(check.check({1, 1, above}, {3, 1, above}).is_touching);
  EXPECT_TRUE(check.check({1, 1, 1}, {3.75f, 1, 1}).is_touching);
  EXPECT_FALSE(check.check({1, 1, 1}, {std::nextafter(3.75f, 0.0f), 1, 1}).is_touching);
}

TEST(ClearanceCheck, agrees_with_the_library_in_the_level) {
  const Level level = build_level();
  const Colliderf collider(level.mesh.view());
  const ClearanceCheck check(level.mesh);
  test::Random random(5);
  const auto between = [&](float low, float high) {
    return low + (high - low) * static_cast<float>(random.between(0, 1 << 20)) * 0x1p-20f;
  };
  std::size_t touching = 0;
  constexpr std::size_t cases = 400;
  for (std::size_t i = 0; i < cases; ++i) {
    const Vector3f from(between(0, 72), between(0, 52), between(0.5f, 3));
    const Vector3f to = from + Vector3f(between(-1, 1), between(-1, 1), between(-0.5f, 0.5f));
    const Clearance clearance = check.check(from, to);
    if (!clearance.is_certain) continue;
    const bool is_hit = collider.any_hit(SweptCapsulef{from, to, Body::half_axis(), Body::radius});
    ASSERT_EQ(clearance.is_touching, is_hit) << "case " << i;
    touching += is_hit;
  }
  EXPECT_GT(touching, cases / 10);
  EXPECT_LT(touching, cases * 9 / 10);
}

}  // namespace
}  // namespace surehit::example::clearance_check_test
