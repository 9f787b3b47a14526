#include "game_physics/wall_check.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "game_physics/exact_sweep.hpp"
#include "level/room.hpp"
#include "support/random.hpp"

namespace surehit::example::wall_check_test {
namespace {

/// A room with one oblique triangle in it, whose plane is x + y + z = 129.
Arena room_with_a_wall() {
  Arena arena{{{32, 32, 32}, {64, 64, 64}}, build_room({32, 32, 32}, {64, 64, 64}, {1, 1, 1})};
  const auto first = static_cast<std::uint32_t>(arena.walls.vertices.size());
  arena.walls.vertices.insert(arena.walls.vertices.end(), {{47, 41, 41}, {41, 47, 41}, {41, 41, 47}});
  arena.walls.triangles.push_back({first, first + 1, first + 2});
  return arena;
}

class WallCheckTest : public testing::Test {
 protected:
  [[nodiscard]] bool is_breach(const Vector3f& from, const Vector3f& to) const {
    EXPECT_EQ(check_.is_breach(from, to), check_.is_breach(to, from));
    return check_.is_breach(from, to);
  }

  Arena arena_ = room_with_a_wall();
  WallCheck check_{arena_};
};

TEST_F(WallCheckTest, sees_a_way_through_a_wall) {
  EXPECT_TRUE(is_breach({42, 42, 42}, {45, 45, 45}));
  EXPECT_FALSE(is_breach({42, 42, 42}, {42.5f, 42.5f, 42.5f}));
  EXPECT_FALSE(is_breach({50, 41, 41}, {41, 41, 50})) << "beside it";
}

TEST_F(WallCheckTest, tells_an_ulp) {
  const float below = std::nextafter(43.0f, 0.0f);
  const float above = std::nextafter(43.0f, 99.0f);
  EXPECT_TRUE(is_breach({42, 42, 42}, {43, 43, 43})) << "ends on it";
  EXPECT_FALSE(is_breach({42, 42, 42}, {43, 43, below}));
  EXPECT_TRUE(is_breach({43, 43, below}, {43, 43, above}));
  EXPECT_FALSE(is_breach({43, 43, above}, {45, 45, 45}));
  EXPECT_TRUE(is_breach({40, 40, 47}, {42, 42, 47})) << "through a corner";
  EXPECT_FALSE(is_breach({40, 40, 47}, {42, 42, std::nextafter(47.0f, 99.0f)}));
  EXPECT_TRUE(is_breach({43, 43, 40}, {45, 45, 42})) << "through an edge";
  EXPECT_FALSE(is_breach({43, 43, 40}, {45, 45, std::nextafter(42.0f, 0.0f)}));
}

TEST_F(WallCheckTest, knows_the_walls_own_plane) {
  EXPECT_TRUE(is_breach({50, 38, 41}, {38, 50, 41})) << "along an edge";
  EXPECT_TRUE(is_breach({50, 37, 42}, {37, 50, 42})) << "through the middle";
  EXPECT_TRUE(is_breach({42, 43, 44}, {43, 42, 44})) << "within";
  EXPECT_FALSE(is_breach({50, 39, 40}, {39, 50, 40})) << "beside it";
  EXPECT_FALSE(is_breach({50, 38, 41}, {48, 40, 41})) << "short of it";
  EXPECT_TRUE(is_breach({47, 46, 36}, {47, 36, 46})) << "over a corner";
  EXPECT_FALSE(is_breach({46.5f, 47, 35.5f}, {48.5f, 35, 45.5f})) << "past a corner";
  EXPECT_TRUE(is_breach({43, 43, 43}, {43, 43, 43})) << "a point on it";
  EXPECT_FALSE(is_breach({50, 38, 41}, {50, 38, 41})) << "a point beside it";
}

TEST_F(WallCheckTest, sees_a_way_out_of_the_room) {
  EXPECT_TRUE(is_breach({33, 33, 33}, {33, 33, 31}));
  EXPECT_TRUE(is_breach({33, 33, 33}, {33, 33, 32})) << "onto the floor";
  EXPECT_FALSE(is_breach({33, 33, 33}, {33, 33, std::nextafter(32.0f, 99.0f)}));
  EXPECT_TRUE(is_breach({33, 33, 33}, {33, 33, 1e30f}));
}

TEST_F(WallCheckTest, finds_the_first_breach_of_a_course) {
  const std::vector<Vector3f> course = {{42, 42, 42}, {41, 42, 42}, {42, 42, 42}, {45, 45, 45}, {42, 42, 42}};
  EXPECT_EQ(check_.first_breach(course), 2u);
  EXPECT_EQ(check_.first_breach(std::span(course).first(3)), std::nullopt);
}

TEST_F(WallCheckTest, agrees_with_the_library_on_ways_that_graze_the_lattice) {
  const Arena arena = build_arena();
  const WallCheck check(arena);
  const Colliderf collider(arena.walls.view());
  test::Random random(7);
  const auto place = [&]() -> Vector3f {
    return {32 + 0.125f * static_cast<float>(random.between(1, 255)),
            32 + 0.125f * static_cast<float>(random.between(1, 31)),
            32 + 0.125f * static_cast<float>(random.between(1, 127))};
  };
  std::size_t breaches = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Vector3f from = place();
    const Vector3f to = from + 0.1f * (place() - from);
    ASSERT_EQ(check.is_breach(from, to), collider.any_hit(Segmentf{from, to})) << i;
    breaches += check.is_breach(from, to);
  }
  EXPECT_GT(breaches, 2'000u);
  EXPECT_LT(breaches, 18'000u);
}

TEST(WallCheck, refuses_a_room_that_it_cannot_check) {
  Arena arena = room_with_a_wall();
  arena.room.low.x() = 31;
  EXPECT_THROW(WallCheck{arena}, std::invalid_argument);
  arena = room_with_a_wall();
  arena.walls.vertices.back()[2] = 65;
  EXPECT_THROW(WallCheck{arena}, std::invalid_argument);
}

}  // namespace
}  // namespace surehit::example::wall_check_test
