#include "game_physics/trial.hpp"

#include <gtest/gtest.h>

#include "game_physics/epsilon_sweep.hpp"
#include "game_physics/exact_sweep.hpp"
#include "game_physics/wall_check.hpp"

namespace surehit::example::trial_test {
namespace {

constexpr TrialOptions small{.points = 200, .steps = 100, .threads = 2};

/// Sees no wall at all.
class BlindSweep : public Sweep {
 public:
  [[nodiscard]] std::optional<Contact> first_contact(const Segmentf&) const override { return std::nullopt; }
};

/// Stops every point where it is.
class StickySweep : public Sweep {
 public:
  [[nodiscard]] std::optional<Contact> first_contact(const Segmentf& move) const override {
    return Contact{0, Side::front, 0, move.start};
  }
};

TEST(Trial, nothing_escapes_the_library) {
  const Arena arena = build_arena();
  const TrialReport report = run_trial("", arena, ExactSweep(arena.walls), small);
  EXPECT_EQ(report.points, small.points);
  EXPECT_EQ(report.steps, small.points * small.steps);
  EXPECT_EQ(report.escaped, 0u);
  EXPECT_EQ(report.outside, 0u);
  EXPECT_EQ(report.stuck, 0u);
  EXPECT_GT(report.share_completed(), 0.9999);
  EXPECT_GT(report.bounces, 2 * report.steps) << "several walls a step";
}

TEST(Trial, some_escape_float_arithmetic_with_epsilon) {
  const Arena arena = build_arena();
  const TrialReport report = run_trial("", arena, EpsilonSweep(arena.walls, 1e-3f), small);
  EXPECT_GT(report.escaped, 0u);
  EXPECT_LT(report.escaped, small.points / 4) << "the contrast is to be fair: most bounces are right";
  EXPECT_GT(report.bounces, 2 * report.steps);
  ASSERT_EQ(report.escapes.size(), std::min<std::size_t>(report.escaped, 24));
  const WallCheck check(arena);
  for (const Trail& escape : report.escapes) {
    EXPECT_TRUE(check.is_breach(escape.positions[escape.breach], escape.positions[escape.breach + 1]));
  }
}

TEST(Trial, counts_escapes_and_points_outside) {
  const Arena arena = build_arena();
  const TrialReport report = run_trial("", arena, BlindSweep(), small);
  EXPECT_EQ(report.escaped, small.points);
  EXPECT_EQ(report.outside, small.points);
  EXPECT_EQ(report.stuck, 0u);
  EXPECT_EQ(report.bounces, 0u);
}

TEST(Trial, counts_points_that_never_move) {
  const Arena arena = build_arena();
  TrialOptions options = small;
  options.steps = 2;
  const TrialReport report = run_trial("", arena, StickySweep(), options);
  EXPECT_EQ(report.stuck, small.points);
  EXPECT_EQ(report.escaped, 0u);
  EXPECT_EQ(report.length_completed, 0);
}

TEST(Trial, is_the_same_for_any_number_of_threads) {
  const Arena arena = build_arena();
  TrialOptions options = small;
  options.points = 20;
  const TrialReport two = run_trial("", arena, ExactSweep(arena.walls), options);
  options.threads = 1;
  const TrialReport one = run_trial("", arena, ExactSweep(arena.walls), options);
  EXPECT_EQ(one.bounces, two.bounces);
  EXPECT_EQ(one.length_completed, two.length_completed);
  ASSERT_EQ(one.trails.size(), two.trails.size());
  for (std::size_t i = 0; i < one.trails.size(); ++i) EXPECT_EQ(one.trails[i].positions, two.trails[i].positions);
}

TEST(Flight, keeps_its_energy) {
  const Arena arena = build_arena();
  const ExactSweep sweep(arena.walls);
  const Course course = Flight(arena, sweep).fly({{40.5f, 34, 33}, {0, 48, 1}}, 400);
  EXPECT_NEAR(course.length_wanted / 400 / double{Flight::time_step}, 47, 2);
}

}  // namespace
}  // namespace surehit::example::trial_test
