#include "moving_platforms/game.hpp"

#include <gtest/gtest.h>

#include "moving_platforms/way_check.hpp"

namespace surehit::example::game_test {
namespace {

/// A platform that goes its whole way in step 0, and then waits for long.
Platform fast_platform(const Boxf& box, const Vector3f& way) {
  return {Platform::Kind::door, {box}, Vector3f::Zero(), way, 1, 1000, 0};
}

Hall hall_with(std::vector<Platform> platforms) { return {{{32, 32, 32}, {64, 64, 64}}, std::move(platforms), {}}; }

void step_with(Game& game, const Shot& shot) { game.step(std::span(&shot, 1), {}); }

Shot shot(Piece::Kind kind, const Vector3f& position, const Vector3f& velocity) {
  return {0, {.kind = kind, .is_there = true, .position = position, .velocity = velocity}};
}

const Boxf panel{{40, 34, 34}, {40.125f, 44, 44}};

TEST(Game, a_platform_pushes_what_is_in_its_way) {
  const Hall hall = hall_with({fast_platform(panel, {2, 0, 0})});
  Game game(hall, Stepping::by_motion, 1);
  step_with(game, shot(Piece::Kind::bullet, {41, 40, 40}, {0, 0, 0}));
  const Piece& piece = game.pieces().front();
  EXPECT_GT(piece.position.x(), 42.125f);
  EXPECT_LT(piece.position.x(), 42.126f);
  EXPECT_FLOAT_EQ(piece.velocity.x(), 2 * 2 / Game::time_step) << "twice as fast as the platform";
  EXPECT_EQ(game.counts().contacts, 1u);
  WayCheck check(hall);
  check.set_step(0);
  EXPECT_FALSE(check.is_breach(game.ways().front().from, game.ways().front().to));
}

TEST(Game, a_platform_that_jumps_goes_through) {
  const Hall hall = hall_with({fast_platform(panel, {2, 0, 0})});
  Game game(hall, Stepping::by_pose, 1);
  step_with(game, shot(Piece::Kind::bullet, {41, 40, 40}, {0, 0, 0}));
  EXPECT_EQ(game.pieces().front().position.x(), 41);
  WayCheck check(hall);
  check.set_step(0);
  EXPECT_TRUE(check.is_breach(game.ways().front().from, game.ways().front().to));
}

TEST(Game, a_bullet_stops_in_front_and_goes_with_what_it_met) {
  const Hall hall = hall_with({fast_platform(panel, {0.5f, 0, 0})});
  Game game(hall, Stepping::by_motion, 1);
  step_with(game, shot(Piece::Kind::bullet, {41, 40, 40}, {-64, 0, 0}));
  const Piece& piece = game.pieces().front();
  EXPECT_GT(piece.position.x(), 40.625f);
  EXPECT_LT(piece.position.x(), 40.626f);
  EXPECT_FLOAT_EQ(piece.velocity.x(), 64 + 2 * 0.5f / Game::time_step);
  EXPECT_EQ(piece.bounces, 1);
}

TEST(Game, takes_out_what_is_squeezed) {
  const Boxf opposite{{42.125f, 34, 34}, {42.25f, 44, 44}};
  const Hall hall = hall_with({fast_platform(panel, {1, 0, 0}), fast_platform(opposite, {-1, 0, 0})});
  Game game(hall, Stepping::by_motion, 1);
  step_with(game, shot(Piece::Kind::debris, {41, 40, 40}, {0, 0, 0}));
  EXPECT_FALSE(game.pieces().front().is_there);
  EXPECT_EQ(game.counts().squeezed, 1u);
  EXPECT_TRUE(game.ways().empty());
}

TEST(Game, debris_rides_on_a_lift) {
  const Hall hall =
      hall_with({{Platform::Kind::lift, {{{0, 0, 0}, {8, 8, 0.125f}}}, {40, 40, 36}, {0, 0, 4}, 100, 20, 0}});
  Game game(hall, Stepping::by_motion, 1);
  WayCheck check(hall);
  std::vector<Shot> shots = {shot(Piece::Kind::debris, {44, 44, 37}, {0, 0, 0})};
  std::size_t steps_on_top = 0;
  for (std::uint32_t step = 0; step < 400; ++step) {
    game.step(shots, {});
    shots.clear();
    check.set_step(step);
    for (const Way& way : game.ways()) ASSERT_FALSE(check.is_breach(way.from, way.to)) << "step " << step;
    const float top = hall.platforms.front().position(step + 1).z() + 0.125f;
    ASSERT_GT(game.pieces().front().position.z(), top);
    steps_on_top += game.pieces().front().position.z() < top + 0.01f;
  }
  EXPECT_GT(steps_on_top, 200u);
  EXPECT_EQ(game.counts().ways, 400u);
}

TEST(Game, a_fan_that_turned_throws_pieces_off) {
  Hall hall = hall_with({});
  hall.fans.push_back({{40, 40, 40}, 4, 0.05f});
  Game game(hall, Stepping::by_motion, 1);
  step_with(game, shot(Piece::Kind::bullet, {42, 40, 41}, {0, 0, -80}));
  const Piece& piece = game.pieces().front();
  EXPECT_EQ(piece.bounces, 1);
  EXPECT_GT(piece.position.z(), 39.5f);
  EXPECT_NE(piece.velocity.y(), 0) << "the blades are tilted";
}

}  // namespace
}  // namespace surehit::example::game_test
