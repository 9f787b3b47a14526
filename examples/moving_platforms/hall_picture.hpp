#pragma once

#include <cstdint>
#include <vector>

#include "moving_platforms/game.hpp"
#include "moving_platforms/hall.hpp"
#include "picture/canvas.hpp"

namespace surehit::example {

/// The hall as seen from the front and a little from above, while a game is played in it.
class HallPicture {
 public:
  HallPicture(const Hall& hall, int width) : hall_(hall), width_(width), turns_(hall.fans.size()) {}

  /// Takes up what the last step was.
  void note_step(std::uint32_t step, const Game& game);
  /// Draws the end of the last step, and the ways of the pieces since the picture before.
  [[nodiscard]] Canvas draw();

 private:
  /// A way of a piece, to be drawn.
  struct Trace {
    Way way;
    Piece::Kind kind;
    std::uint32_t step;
  };

  const Hall& hall_;
  int width_;
  std::uint32_t step_ = 0;
  std::vector<FanTurn> turns_;
  std::vector<Trace> traces_;
};

}  // namespace surehit::example
