#pragma once

#include <cstddef>
#include <cstdint>
#include <random>

#include "moving_platforms/hall.hpp"
#include "moving_platforms/piece.hpp"

namespace surehit::example {

/// Draws shots where no platform ever is. The standard's distributions differ between libraries, its engines do not.
class Gun {
 public:
  Gun(const Hall& hall, std::uint64_t seed) : room_(hall.room), bits_(seed) {}

  /// One shot in four is a bullet from an end wall. The others are debris from the ceiling.
  [[nodiscard]] Shot shoot(std::size_t slot);

 private:
  [[nodiscard]] Piece bullet();
  [[nodiscard]] Piece debris();
  float between(float low, float high) { return low + (high - low) * (static_cast<float>(bits_() >> 40) * 0x1p-24f); }

  Boxf room_;
  std::mt19937_64 bits_;
};

}  // namespace surehit::example
