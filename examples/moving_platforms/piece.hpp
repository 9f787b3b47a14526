#pragma once

#include <cstddef>
#include <cstdint>
#include <surehit/path.hpp>

namespace surehit::example {

/// A bullet or a piece of debris: a point that flies.
struct Piece {
  enum class Kind : std::uint8_t { bullet, debris };

  Kind kind = Kind::debris;
  bool is_there = false;
  std::uint16_t steps = 0;  ///< since it was shot
  std::uint16_t bounces = 0;
  Vector3f position = Vector3f::Zero();
  Vector3f velocity = Vector3f::Zero();  ///< metres a second
};

/// A piece that comes into the game, in place of one that has left it.
struct Shot {
  std::size_t slot;
  Piece piece;
};

}  // namespace surehit::example
