#include "moving_platforms/recording.hpp"

#include "command_line/thread_executor.hpp"
#include "moving_platforms/gun.hpp"
#include "moving_platforms/way_check.hpp"

namespace surehit::example {
namespace {

/// A shot for each place that no piece has. At first there are few, and then more and more.
std::vector<Shot> draw_shots(Gun& gun, const Game& game, std::uint32_t step) {
  constexpr std::size_t steps_to_fill = 64;
  const std::size_t places = game.pieces().size();
  const std::size_t open = std::min(places, (step + 1) * (1 + places / steps_to_fill));
  std::vector<Shot> shots;
  for (std::size_t slot = 0; slot < open; ++slot) {
    if (!game.pieces()[slot].is_there) shots.push_back(gun.shoot(slot));
  }
  return shots;
}

}  // namespace

Recording record_game(const Hall& hall, const GameOptions& options, const Watch& watch) {
  const ThreadExecutor executor(options.threads);
  WayCheck check(hall);
  Gun gun(hall, options.seed);
  Game game(hall, options.stepping, options.pieces);
  Recording recording;
  recording.pieces = options.pieces;
  for (std::uint32_t step = 0; step < options.steps; ++step) {
    recording.shots.push_back(draw_shots(gun, game, step));
    game.step(recording.shots.back(), executor);
    recording.hashes.push_back(game.hash());
    check.set_step(step);
    for (const Way& way : game.ways()) {
      if (!check.is_breach(way.from, way.to)) continue;
      ++recording.breaches;
      game.remove(way.slot);
    }
    if (watch) watch(step, game);
  }
  recording.counts = game.counts();
  return recording;
}

std::vector<std::uint64_t> replay_game(const Hall& hall, const Recording& recording, unsigned threads) {
  const ThreadExecutor executor(threads);
  Game game(hall, Stepping::by_motion, recording.pieces);
  std::vector<std::uint64_t> hashes;
  for (const std::vector<Shot>& shots : recording.shots) {
    game.step(shots, executor);
    hashes.push_back(game.hash());
  }
  return hashes;
}

}  // namespace surehit::example
