#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <surehit/executor.hpp>
#include <surehit/scene.hpp>
#include <vector>

#include "moving_platforms/hall.hpp"
#include "moving_platforms/hall_scene.hpp"
#include "moving_platforms/piece.hpp"

namespace surehit::example {

/// The straight way of a piece through a step.
struct Way {
  std::size_t slot;
  Vector3f from;
  Vector3f to;
};

/// What the steps of a game came to.
struct GameCounts {
  std::size_t ways = 0;      ///< steps of pieces
  std::size_t contacts = 0;  ///< ways that met something
  std::size_t asked = 0;     ///< paths of all batches
  std::size_t squeezed = 0;  ///< pieces taken out because no way was free
};

/// Lets pieces fly among what moves in a hall.
///
/// In each step, a piece goes straight while the platforms move. The ways of all pieces are one batch. A piece that
/// meets something stops in front of it. For the rest of the step, it goes where that goes. Seen from there, it still
/// goes straight, but not as far. So its whole way through the step is straight in the hall too. Another batch asks
/// whether this way is free, because it may meet something else.
class Game {
 public:
  static constexpr float time_step = 1.0f / 64;

  /// The game has as many pieces at the same time, and none at first.
  Game(const Hall& hall, Stepping stepping, std::size_t pieces);

  /// Lets shots in, and then lets all pieces go through one step. The executor spreads the batches over threads, and
  /// the result is the same.
  void step(std::span<const Shot> shots, const std::optional<Executor>& executor);
  /// Takes a piece out of the game.
  void remove(std::size_t slot) { pieces_[slot].is_there = false; }

  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }
  /// The ways of the last step.
  [[nodiscard]] const std::vector<Way>& ways() const { return ways_; }
  [[nodiscard]] const GameCounts& counts() const { return counts_; }
  /// A hash of all bits of all pieces.
  [[nodiscard]] std::uint64_t hash() const;

 private:
  /// A piece whose way through the step is not yet known to be free.
  struct Attempt {
    std::size_t slot;
    Vector3f end;
  };

  [[nodiscard]] std::vector<Attempt> begin_step();
  /// Asks for the first hits of all attempts. Returns those that met something, with other ends.
  [[nodiscard]] std::vector<Attempt> try_ways(const std::vector<Attempt>& attempts, int round,
                                              const std::optional<Executor>& executor);
  void finish_way(const Attempt& attempt);
  /// Turns the piece's velocity, and returns where it should be at the end of the step.
  [[nodiscard]] Vector3f respond(Piece& piece, const Segmentf& way, const SceneHitf& hit, int round) const;

  HallScene hall_scene_;
  std::vector<Piece> pieces_;
  std::vector<Way> ways_;
  GameCounts counts_;
};

}  // namespace surehit::example
