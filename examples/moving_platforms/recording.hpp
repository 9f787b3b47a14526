#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "moving_platforms/game.hpp"

namespace surehit::example {

struct GameOptions {
  std::size_t pieces = 4'000;
  std::uint32_t steps = Hall::period;
  std::uint64_t seed = 1;
  unsigned threads = 1;
  Stepping stepping = Stepping::by_motion;
};

/// A game that was played: what came into it, and what it was after each step.
struct Recording {
  std::size_t pieces = 0;
  std::vector<std::vector<Shot>> shots;  ///< of each step
  std::vector<std::uint64_t> hashes;     ///< of all pieces, after each step
  GameCounts counts;
  std::size_t breaches = 0;  ///< ways that touched a platform or left the room, by the exact check
};

/// Is shown the game after a step.
using Watch = std::function<void(std::uint32_t step, const Game& game)>;

/// Plays a game with shots drawn from the seed, and checks every way of every piece. A piece that went through a
/// platform leaves the game.
[[nodiscard]] Recording record_game(const Hall& hall, const GameOptions& options, const Watch& watch = {});

/// Plays the shots of a recording again, without the check. Returns the hashes.
[[nodiscard]] std::vector<std::uint64_t> replay_game(const Hall& hall, const Recording& recording, unsigned threads);

}  // namespace surehit::example
