#pragma once

#include <cstddef>
#include <surehit/triangle_mesh_view.hpp>
#include <vector>

#include "entrants.hpp"
#include "round_series.hpp"

namespace surehit::benchmark {

/// What the builds of a library took, round by round.
struct BuildResult {
  const Entrant* entrant;
  RoundSeries nanoseconds;
  std::size_t memory_bytes;
};

/// The first entrant of each library: in how many ways it is asked does not matter to a build.
[[nodiscard]] std::vector<Entrant> one_a_library(const std::vector<Entrant>& entrants);

/// Every round builds with everybody once, from nothing; one before the first, which is not counted, warms up.
[[nodiscard]] std::vector<BuildResult> race_builds(const std::vector<Entrant>& entrants, const TriangleMeshViewf& mesh,
                                                   std::size_t rounds);

}  // namespace surehit::benchmark
