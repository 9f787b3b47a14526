#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "game_physics/arena.hpp"
#include "game_physics/flight.hpp"
#include "game_physics/sweep.hpp"

namespace surehit::example {

struct TrialOptions {
  std::size_t points = 1'000;
  std::size_t steps = 300;
  float speed = 48;
  std::uint64_t seed = 1;
  unsigned threads = 1;
};

/// Part of a course, to be drawn.
struct Trail {
  std::vector<Vector3f> positions;
  std::size_t breach = 0;  ///< of an escape: the position from which the point went through a wall
};

/// What many flights came to.
struct TrialReport {
  std::size_t points = 0;
  std::size_t steps = 0;
  std::size_t bounces = 0;
  std::size_t escaped = 0;  ///< points that went through a wall, by the exact check
  std::size_t outside = 0;  ///< those of them that ended outside the room
  std::size_t stuck = 0;    ///< points that never moved
  double length_wanted = 0;
  double length_completed = 0;
  double flight_seconds = 0;   ///< spent in steps, by all threads together
  double check_seconds = 0;    ///< spent in the exact check, by all threads together
  std::vector<Trail> trails;   ///< how the first few points began
  std::vector<Trail> escapes;  ///< how the first few that escaped went through a wall, and where to

  [[nodiscard]] double share_completed() const { return length_completed / length_wanted; }
  [[nodiscard]] double steps_per_second() const { return static_cast<double>(steps) / flight_seconds; }
};

/// Lets points drawn from the seed fly with a sweep, and checks every piece of every course. The report, seconds aside,
/// is the same for any number of threads.
[[nodiscard]] TrialReport run_trial(const std::string& title, const Arena& arena, const Sweep& sweep,
                                    const TrialOptions& options);

}  // namespace surehit::example
