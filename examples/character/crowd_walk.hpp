#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <surehit/collider.hpp>
#include <vector>

#include "character/clearance_check.hpp"
#include "character/walker.hpp"

namespace surehit::example {

struct WalkOptions {
  std::size_t characters = 200;
  std::uint32_t steps = 160;
  std::uint32_t seed = 1;
  unsigned threads = 1;
};

/// What a walk came to.
struct WalkCounts {
  std::size_t steps = 0;
  std::size_t ways = 0;           ///< The straight ways between two positions.
  std::size_t queries = 0;        ///< All that were asked of the sweep.
  std::size_t touching_ways = 0;  ///< Ways on which a body touched the level, by the independent check.
  std::size_t unsure_ways = 0;    ///< Ways of which this check is not sure.
  std::size_t touching = 0;       ///< Characters with such a way.
  std::size_t deep = 0;           ///< Characters that came deeper than 5 centimetres into the level.
  std::size_t lost = 0;           ///< Characters that fell out of the level.
  std::size_t stuck = 0;          ///< Characters that did not move for four seconds, with eight goals.
  std::size_t climbed = 0;        ///< Characters that came to the gallery from below.
  double metres = 0;              ///< The length of all ways in the plan.
  double walk_seconds = 0;        ///< The time of all threads together, without the check.
  double check_seconds = 0;

  WalkCounts& operator+=(const WalkCounts& other);
};

/// A walk that was recorded: what went into it, and what the characters were after each step.
struct WalkRecording {
  std::vector<Vector3f> starts;
  std::vector<std::vector<Vector3f>> velocities;  ///< What each character wanted, in each step.
  std::vector<std::uint64_t> hashes;              ///< Each is of all bits of all characters after a step.
  WalkCounts counts;
};

/// Is shown all characters after a step.
using WalkWatch = std::function<void(std::uint32_t step, std::span<const Character> characters)>;

/// A rectangle of the plan.
struct Area {
  float low_x, low_y, high_x, high_y;
};
constexpr Area whole_level = {2, 2, 70, 50};
constexpr Area great_hall = {28, 19, 45, 33};

/// Draws places of an area where a body touches nothing. The collider is that of the level.
[[nodiscard]] std::vector<Vector3f> draw_starts(const Colliderf& level, const Area& area, std::size_t count,
                                                std::uint32_t seed);

/// Lets characters walk from their starts to goals drawn from the seed, and checks all of their ways. The recording is
/// the same for any number of threads, seconds aside.
[[nodiscard]] WalkRecording record_walk(const std::vector<Vector3f>& starts, const CapsuleSweep& sweep,
                                        const ClearanceCheck& check, const WalkOptions& options,
                                        const WalkWatch& watch = {});

/// Walks again with the velocities of a recording, without minds and without the check. Returns the hashes.
[[nodiscard]] std::vector<std::uint64_t> replay_walk(const CapsuleSweep& sweep, const WalkRecording& recording,
                                                     unsigned threads);

}  // namespace surehit::example
