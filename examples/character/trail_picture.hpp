#pragma once

#include <span>
#include <vector>

#include "character/walker.hpp"
#include "picture/canvas.hpp"

namespace surehit::example {

/// Where characters have been, step by step, until one of them moves no more.
class Trails {
 public:
  /// Takes up where all characters are after a step.
  void note(std::span<const Character> characters);
  [[nodiscard]] const std::vector<std::vector<Vector3f>>& positions() const { return positions_; }

 private:
  std::vector<std::vector<Vector3f>> positions_;  ///< The positions of each character.
};

/// Draws the great hall of the level, the trails of feet through it, and the bodies at their ends.
[[nodiscard]] Canvas draw_trails(const Trails& trails, int width, int height, unsigned threads);

}  // namespace surehit::example
