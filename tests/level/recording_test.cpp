#include "moving_platforms/recording.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace surehit::example::recording_test {
namespace {

/// So many pieces that batches are spread over threads.
constexpr GameOptions small{.pieces = 2'500, .steps = 80, .threads = 2};

TEST(Recording, nothing_goes_through_what_translates) {
  const Hall hall = build_hall();
  const Recording recording = record_game(hall, small);
  EXPECT_EQ(recording.breaches, 0u);
  EXPECT_EQ(recording.counts.squeezed, 0u);
  EXPECT_GT(recording.counts.ways, 50'000u);
  EXPECT_GT(recording.counts.contacts, 2'000u);
  EXPECT_GE(recording.counts.asked, recording.counts.ways + recording.counts.contacts);
}

TEST(Recording, pieces_that_come_to_rest_are_safe_too) {
  const Hall hall = build_hall();
  const Recording recording = record_game(hall, {.pieces = 60, .steps = 3 * Hall::period, .seed = 5});
  EXPECT_EQ(recording.breaches, 0u);
  EXPECT_GT(4 * recording.counts.contacts, recording.counts.ways) << "much of the debris lies";
}

TEST(Recording, some_go_through_platforms_that_jump) {
  const Hall hall = build_hall();
  GameOptions options = small;
  options.stepping = Stepping::by_pose;
  const Recording recording = record_game(hall, options);
  EXPECT_GT(recording.breaches, 50u);
  EXPECT_LT(recording.breaches, recording.counts.ways / 100) << "the contrast is to be fair: most ways are right";
}

TEST(Recording, is_replayed_to_the_same_bits_on_any_number_of_threads) {
  const Hall hall = build_hall();
  const Recording recording = record_game(hall, small);
  ASSERT_EQ(recording.hashes.size(), small.steps);
  for (const unsigned threads : {1u, 2u, 8u}) EXPECT_EQ(replay_game(hall, recording, threads), recording.hashes);
}

TEST(Recording, hashes_tell_games_apart) {
  const Hall hall = build_hall();
  const Recording first = record_game(hall, {.pieces = 20, .steps = 10, .seed = 1});
  const Recording second = record_game(hall, {.pieces = 20, .steps = 10, .seed = 2});
  EXPECT_NE(first.hashes, second.hashes);
  Recording changed = first;
  Vector3f& velocity = changed.shots.front().front().piece.velocity;
  velocity.x() = std::nextafter(velocity.x(), 0.0f);
  EXPECT_NE(replay_game(hall, changed, 1), first.hashes);
}

TEST(Recording, shows_each_step) {
  const Hall hall = build_hall();
  std::uint32_t shown = 0;
  const Recording recording = record_game(hall, {.pieces = 20, .steps = 10}, [&](std::uint32_t step, const Game& game) {
    EXPECT_EQ(step, shown++);
    EXPECT_EQ(game.pieces().size(), 20u);
  });
  EXPECT_EQ(shown, recording.hashes.size());
}

}  // namespace
}  // namespace surehit::example::recording_test
