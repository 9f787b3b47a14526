#include "moving_platforms/way_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "moving_platforms/hall_scene.hpp"
#include "support/random.hpp"

namespace surehit::example::way_check_test {
namespace {

/// A slab whose top is at 41 in step 0, and moves up by a half meanwhile. Then it waits.
Hall hall_with_a_slab() {
  return {{{32, 32, 32}, {64, 64, 64}},
          {{Platform::Kind::lift, {{{0, 0, 0}, {8, 8, 1}}}, {40, 40, 40}, {0, 0, 0.5f}, 1, 100, 0}},
          {}};
}

class WayCheckTest : public testing::Test {
 protected:
  Hall hall_ = hall_with_a_slab();
  WayCheck check_{hall_};

  void SetUp() override { check_.set_step(0); }
};

TEST_F(WayCheckTest, sees_a_way_through_a_platform) {
  EXPECT_TRUE(check_.is_breach({44, 44, 45}, {44, 44, 36}));
  EXPECT_TRUE(check_.is_breach({36, 44, 40.75f}, {52, 44, 40.75f}));
  EXPECT_FALSE(check_.is_breach({36, 36, 45}, {36, 36, 36})) << "beside it";
}

TEST_F(WayCheckTest, sees_a_platform_that_moves_through_a_piece) {
  EXPECT_TRUE(check_.is_breach({44, 44, 41.25f}, {44, 44, 41.25f}));
  EXPECT_FALSE(check_.is_breach({44, 44, 41.25f}, {44, 44, 41.75f})) << "a piece that moves with it";
  EXPECT_TRUE(check_.is_breach({44, 44, 41.25f}, {44, 44, 41.5f})) << "one that is too slow";
  check_.set_step(1);
  EXPECT_FALSE(check_.is_breach({44, 44, 41.75f}, {44, 44, 41.75f})) << "the platform waits";
}

TEST_F(WayCheckTest, knows_when_a_piece_is_where) {
  // Both ways pass the height of 41.25, over the edge at 48. One does so before the slab is there.
  EXPECT_FALSE(check_.is_breach({47, 44, 41.25f}, {51, 44, 41.25f}));
  EXPECT_TRUE(check_.is_breach({51, 44, 41.25f}, {47, 44, 41.25f}));
}

TEST_F(WayCheckTest, tells_an_ulp) {
  const float above = std::nextafter(41.5f, 64.0f);
  EXPECT_TRUE(check_.is_breach({44, 44, 42}, {44, 44, 41.5f})) << "ends on it";
  EXPECT_FALSE(check_.is_breach({44, 44, 42}, {44, 44, above}));
  EXPECT_TRUE(check_.is_breach({44, 44, 41}, {44, 44, 42})) << "starts on it";
  EXPECT_FALSE(check_.is_breach({44, 44, std::nextafter(41.0f, 64.0f)}, {44, 44, 42}));
  EXPECT_TRUE(check_.is_breach({48, 44, 40.75f}, {48, 44, 40.75f})) << "in the plane of a side";
  EXPECT_FALSE(check_.is_breach({std::nextafter(48.0f, 64.0f), 44, 40.75f}, {49, 44, 40.75f}));
}

TEST_F(WayCheckTest, sees_a_way_out_of_the_room) {
  EXPECT_TRUE(check_.is_breach({33, 33, 33}, {33, 33, 31}));
  EXPECT_TRUE(check_.is_breach({33, 33, 33}, {33, 33, 32})) << "onto the floor";
  EXPECT_FALSE(check_.is_breach({33, 33, 33}, {33, 33, std::nextafter(32.0f, 64.0f)}));
  EXPECT_TRUE(check_.is_breach({33, 33, 33}, {33, 33, 1e30f}));
}

TEST(WayCheck, agrees_with_the_library) {
  Hall hall = build_hall();
  hall.fans.clear();
  WayCheck check(hall);
  HallScene scene(hall, Stepping::by_motion);
  test::Random random(11);
  // Multiples of 1/8, as many faces have.
  const auto place = [&]() -> Vector3f {
    return {32 + 0.125f * static_cast<float>(random.between(1, 255)),
            32 + 0.125f * static_cast<float>(random.between(1, 63)),
            32 + 0.125f * static_cast<float>(random.between(1, 127))};
  };
  std::size_t breaches = 0;
  std::size_t asked = 0;
  for (std::uint32_t step = 0; step < Hall::period; ++step) {
    scene.next_step({});
    check.set_step(step);
    for (int i = 0; i < 100; ++i) {
      const Vector3f from = place();
      const Vector3f to = from + 0.1f * (place() - from);
      const bool is_breach = check.is_breach(from, to);
      const bool is_hit = scene.scene().any_hit(Segmentf{from, to});
      // What flies inside of a solid touches no triangle.
      const bool is_inside = is_breach && !is_hit;
      if (is_inside) {
        const auto first = scene.scene().first_hit(Segmentf{from, from + Vector3f(0, 0, 32)});
        ASSERT_TRUE(first && first->side == Side::back) << "step " << step;
      } else {
        ASSERT_EQ(is_breach, is_hit) << "step " << step;
        ++asked;
      }
      breaches += is_breach;
    }
  }
  EXPECT_GT(asked, 15'000u);
  EXPECT_GT(breaches, 500u);
}

TEST(WayCheck, refuses_a_hall_that_it_cannot_check) {
  Hall hall = hall_with_a_slab();
  hall.room.low.x() = 31;
  EXPECT_THROW(WayCheck{hall}, std::invalid_argument);
  hall = hall_with_a_slab();
  hall.platforms.front().way.z() = 30;
  EXPECT_THROW(WayCheck{hall}, std::invalid_argument);
}

}  // namespace
}  // namespace surehit::example::way_check_test
