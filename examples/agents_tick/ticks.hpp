#pragma once

#include <cstddef>
#include <cstdint>

namespace surehit::example {

struct TickOptions {
  std::size_t agents = 1'000;
  std::size_t segments = 10'000;
  std::uint32_t ticks = 20;
  std::uint64_t seed = 1;
  unsigned threads = 1;
};

/// What some ticks came to. All but the times is the same for any number of threads.
struct TickReport {
  std::size_t instances = 0;
  std::size_t triangles = 0;
  std::size_t looks = 0;
  std::size_t visible = 0;
  std::size_t through_glass = 0;  ///< visible, but something that lets sight through blocks the way
  std::size_t stopped_by_glass = 0;
  std::uint64_t hash = 0;  ///< of all answers and of where all agents are
  double commit_seconds = 0;
  double choice_seconds = 0;  ///< to find what lies in the vision cones
  double sight_seconds = 0;
  double walk_seconds = 0;
};

/// Lets agents look around and walk in a town. In each tick, all looks are one batch, and all steps are another one.
[[nodiscard]] TickReport run_ticks(const TickOptions& options);

}  // namespace surehit::example
