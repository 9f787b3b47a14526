#pragma once

#include <surehit/box.hpp>
#include <vector>

#include "moving_platforms/fan.hpp"
#include "moving_platforms/platform.hpp"

namespace surehit::example {

/// A closed hall with lifts, sliding doors, a train and fans.
///
/// All of it lies in [32, 64] on each axis, where every float is a multiple of 2^-18. So an exact check in integers is
/// short.
struct Hall {
  /// After this number of steps, all platforms are where they were.
  static constexpr std::uint32_t period = 192;

  Boxf room;
  std::vector<Platform> platforms;
  std::vector<Fan> fans;
};

[[nodiscard]] Hall build_hall();

}  // namespace surehit::example
