#include "character/crowd_walk.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "character/bullet_capsule_sweep.hpp"
#include "character/exact_capsule_sweep.hpp"
#include "level/level.hpp"
#include "support/case_count.hpp"

namespace surehit::example::crowd_walk_test {
namespace {

class CrowdWalkTest : public testing::Test {
 protected:
  Level level_ = build_level();
  Colliderf collider_{level_.mesh.view()};
  ClearanceCheck check_{level_.mesh};
  ExactCapsuleSweep sweep_{collider_};
  WalkOptions small_{.characters = 70, .steps = static_cast<std::uint32_t>(test::case_count(40)), .threads = 2};
  std::vector<Vector3f> starts_ = draw_starts(collider_, whole_level, small_.characters, 1);
};

/// Sees no level at all.
class BlindCapsuleSweep : public CapsuleSweep {
 public:
  [[nodiscard]] std::optional<Stop> find_stop(const Vector3f&, const Vector3f&, std::size_t&) const override {
    return std::nullopt;
  }
};

/// Stops each body where it is.
class StickyCapsuleSweep : public CapsuleSweep {
 public:
  [[nodiscard]] std::optional<Stop> find_stop(const Vector3f& from, const Vector3f&, std::size_t&) const override {
    return Stop{from, {0, 0, 1}};
  }
};

TEST_F(CrowdWalkTest, nobody_touches_the_level_and_replays_have_the_same_bits) {
  const WalkRecording recording = record_walk(starts_, sweep_, check_, small_);
  EXPECT_EQ(recording.counts.steps, small_.characters * small_.steps);
  EXPECT_EQ(recording.counts.touching_ways, 0u);
  EXPECT_EQ(recording.counts.unsure_ways, 0u);
  EXPECT_EQ(recording.counts.lost, 0u);
  EXPECT_EQ(recording.counts.stuck, 0u);
  EXPECT_GT(recording.counts.ways, 0u);
  for (const unsigned threads : {1u, 2u, 8u}) EXPECT_EQ(replay_walk(sweep_, recording, threads), recording.hashes);
}

TEST_F(CrowdWalkTest, replays_tell_walks_apart) {
  const std::vector<Vector3f> few(starts_.begin(), starts_.begin() + 4);
  WalkRecording recording = record_walk(few, sweep_, check_, {.characters = 4, .steps = 6});
  float& x = recording.velocities[2][1].x();
  x = std::nextafter(x, 9.0f) + 1e-3f;
  const auto hashes = replay_walk(sweep_, recording, 1);
  EXPECT_EQ(hashes[1], recording.hashes[1]);
  EXPECT_NE(hashes[2], recording.hashes[2]);
}

TEST_F(CrowdWalkTest, counts_who_goes_through_the_ground) {
  const BlindCapsuleSweep blind;
  const WalkRecording recording = record_walk(starts_, blind, check_, {.characters = 70, .steps = 90});
  EXPECT_EQ(recording.counts.touching, starts_.size());
  EXPECT_EQ(recording.counts.deep, starts_.size());
  EXPECT_EQ(recording.counts.lost, starts_.size());
  EXPECT_EQ(recording.counts.stuck, 0u);
}

TEST_F(CrowdWalkTest, counts_who_is_stuck) {
  const StickyCapsuleSweep sticky;
  const WalkRecording recording = record_walk(starts_, sticky, check_, {.characters = 70, .steps = 160});
  EXPECT_EQ(recording.counts.stuck, starts_.size());
  EXPECT_EQ(recording.counts.touching_ways, 0u);
  EXPECT_EQ(recording.counts.lost, 0u);
}

TEST_F(CrowdWalkTest, bullet_walks_the_same_ways_and_touches_without_a_skin) {
  const auto bullet = make_bullet_capsule_sweep(level_.mesh, {.skin = 0});
  if (!bullet) GTEST_SKIP() << "without Bullet";
  const WalkRecording recording = record_walk(starts_, *bullet, check_, {.characters = 70, .steps = 20});
  EXPECT_GT(recording.counts.touching_ways, 0u);
  EXPECT_LT(recording.counts.lost, starts_.size() / 10) << "the contrast is to be fair";
}

TEST_F(CrowdWalkTest, starts_are_free_and_on_the_ground) {
  for (const Vector3f& start : starts_) {
    EXPECT_FALSE(check_.check(start, start).is_touching);
    EXPECT_TRUE(check_.check(start, start - Vector3f(0, 0, 0.5f)).is_touching);
  }
}

}  // namespace
}  // namespace surehit::example::crowd_walk_test
