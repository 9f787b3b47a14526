#include "character/walker.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <surehit/collider.hpp>

#include "character/clearance_check.hpp"
#include "character/exact_capsule_sweep.hpp"
#include "level/level.hpp"
#include "level/solid_builder.hpp"

namespace surehit::example::walker_test {
namespace {

constexpr float on_floor = Body::radius + Body::half_height;

/// Lets one character walk in a mesh, and checks each of its ways.
class Walk {
 public:
  Walk(const Mesh<float>& mesh, const Vector3f& start) : collider_(mesh.view()), check_(mesh) {
    character_.position = start;
  }

  const Character& go(const Vector3f& velocity, int steps) {
    for (int i = 0; i < steps; ++i) {
      std::vector<Vector3f> positions;
      Vector3f from = character_.position;
      walker_.step(character_, velocity, positions, queries_);
      for (const Vector3f& to : positions) {
        const Clearance clearance = check_.check(from, to);
        EXPECT_FALSE(clearance.is_touching) << "at " << from.transpose();
        from = to;
      }
      EXPECT_EQ(from, character_.position);
    }
    return character_;
  }

 private:
  Colliderf collider_;
  ClearanceCheck check_;
  ExactCapsuleSweep sweep_{collider_};
  Walker walker_{sweep_};
  Character character_;
  std::size_t queries_ = 0;
};

/// A floor from 0 to 16 on both axes, with boxes.
Mesh<float> floor_with(const std::vector<std::array<Point, 2>>& boxes) {
  SolidBuilder builder(16);
  builder.add_parallelogram({0, 0, 0}, {16, 0, 0}, {0, 16, 0});
  for (const auto& [low, high] : boxes) builder.add_box(low, high);
  return builder.take();
}

/// A plane that rises along x, by `rise` on each metre.
Mesh<float> slope(float rise) {
  SolidBuilder builder(1);
  builder.add_parallelogram({0, 0, 0}, {16, 0, 16 * rise}, {0, 16, 0});
  return builder.take();
}

TEST(Walker, falls_to_the_floor_and_walks_on_it) {
  Walk walk(floor_with({}), {2, 2, 3});
  EXPECT_FALSE(walk.go({0, 0, 0}, 4).is_standing);
  const Character landed = walk.go({0, 0, 0}, 40);
  EXPECT_TRUE(landed.is_standing);
  EXPECT_GT(landed.position.z(), on_floor);
  EXPECT_LT(landed.position.z(), on_floor + 1e-5f);
  const Character walked = walk.go({4, 0, 0}, 32);
  EXPECT_NEAR(walked.position.x(), 6, 1e-4f);
  EXPECT_TRUE(walked.is_standing);
  EXPECT_LT(walked.position.z(), on_floor + 1e-5f);
}

TEST(Walker, slides_along_a_wall) {
  Walk walk(floor_with({{{{8, 0, 0}, {9, 16, 3}}}}), {6, 2, 1});
  const Character slid = walk.go({3, 3, 0}, 64);
  EXPECT_NEAR(slid.position.x(), 7.75f, 0.002f);
  EXPECT_LT(slid.position.x(), 7.75f);
  EXPECT_NEAR(slid.position.y(), 8, 0.05f);
}

TEST(Walker, stops_in_a_corner) {
  Walk walk(floor_with({{{{8, 0, 0}, {9, 16, 3}}}, {{{0, 8, 0}, {9, 9, 3}}}}), {6, 6, 1});
  const Vector3f there = walk.go({3, 4, 0}, 64).position;
  EXPECT_NEAR(there.x(), 7.75f, 0.002f);
  EXPECT_NEAR(there.y(), 7.75f, 0.002f);
  const Vector3f back = walk.go({-3, -4, 0}, 16).position;
  EXPECT_NEAR(there.x() - back.x(), 1.5f, 0.002f) << "nothing sticks";
}

TEST(Walker, climbs_a_low_step_and_no_high_one) {
  for (const float height : {0.125f, 0.25f, 0.3f, 0.375f, 0.5f, 1.0f}) {
    Walk walk(floor_with({{{{8, 0, 0}, {12, 16, height}}}}), {6, 2, 1});
    const Character character = walk.go({3, 0, 0}, 64);
    EXPECT_TRUE(character.is_standing);
    const bool has_climbed = character.position.x() > 9;
    EXPECT_EQ(has_climbed, height < Walker::step_height) << height;
    EXPECT_NEAR(character.position.z(), on_floor + (has_climbed ? height : 0), 1e-4f) << height;
  }
}

TEST(Walker, walks_down_a_step_without_a_fall) {
  Walk walk(floor_with({{{{0, 0, 0}, {8, 16, 0.25f}}}}), {6, 2, 1.25f});
  walk.go({0, 0, 0}, 20);
  for (int i = 0; i < 40; ++i) EXPECT_TRUE(walk.go({3, 0, 0}, 1).is_standing);
  EXPECT_NEAR(walk.go({0, 0, 0}, 1).position.z(), on_floor, 1e-4f);
}

TEST(Walker, does_not_climb_below_a_low_ceiling) {
  Walk walk(floor_with({{{{8, 0, 0}, {12, 16, 0.25f}}}, {{{0, 0, 1.625f}, {16, 16, 2}}}}), {6, 2, 0.8125f});
  const Character character = walk.go({3, 0, 0}, 64);
  EXPECT_LT(character.position.x(), 8);
  EXPECT_TRUE(character.is_standing);
}

TEST(Walker, walks_up_a_slope_and_slides_down_a_steep_one) {
  Walk gentle(slope(0.5f), {2, 8, 2.5f});
  const Character up = gentle.go({2, 0, 0}, 96);
  EXPECT_TRUE(up.is_standing);
  EXPECT_GT(up.position.x(), 6);
  const Vector3f rest = gentle.go({0, 0, 0}, 32).position;
  EXPECT_NEAR(rest.x(), up.position.x(), 1e-3f) << "it stays there";

  Walk steep(slope(1.75f), {8, 8, 15.5f});
  const Character down = steep.go({2, 0, 0}, 48);
  EXPECT_FALSE(down.is_standing);
  EXPECT_LT(down.position.z(), 14.5f);
}

TEST(Walker, goes_up_the_stairs_of_the_level) {
  Walk walk(build_level().mesh, {36.5f, 29, 1});
  const Character character = walk.go({0, 3, 0}, 70);
  EXPECT_TRUE(character.is_standing);
  EXPECT_GT(character.position.y(), 34.75f);
  EXPECT_NEAR(character.position.z(), 2.25f + on_floor, 1e-4f);
}

}  // namespace
}  // namespace surehit::example::walker_test
