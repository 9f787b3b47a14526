#include "build_race.hpp"

#include <algorithm>

namespace surehit::benchmark {

std::vector<Entrant> one_a_library(const std::vector<Entrant>& entrants) {
  std::vector<Entrant> chosen;
  for (const Entrant& entrant : entrants) {
    const auto is_same = [&](const Entrant& other) { return other.library == entrant.library; };
    if (std::none_of(chosen.begin(), chosen.end(), is_same)) chosen.push_back(entrant);
  }
  return chosen;
}

std::vector<BuildResult> race_builds(const std::vector<Entrant>& entrants, const TriangleMeshViewf& mesh,
                                     std::size_t rounds) {
  std::vector<BuildResult> results;
  for (const Entrant& entrant : entrants) results.push_back({&entrant, {}, 0});
  for (std::size_t round = 0; round <= rounds; ++round) {
    for (BuildResult& result : results) {
      const auto contender = result.entrant->make();
      const double time = nanoseconds_of([&] { contender->build(mesh); });
      if (round > 0) result.nanoseconds.push_back(time);
      result.memory_bytes = contender->memory_bytes();
    }
  }
  return results;
}

}  // namespace surehit::benchmark
