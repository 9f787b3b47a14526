#pragma once

#include <cstddef>
#include <vector>

#include "entrants.hpp"
#include "path_set.hpp"

namespace surehit::benchmark {

struct WrongCount {
  const Entrant* entrant;
  std::size_t count;
};

/// What exact answers say about paths and about contenders.
struct Judgement {
  std::size_t judged;             ///< paths, the first ones
  double hit_share;               ///< of these that meet anything
  std::vector<WrongCount> wrong;  ///< any-hit decisions that are not the exact ones; of variants those of the worst
};

/// One for each sample.
[[nodiscard]] std::vector<Judgement> judge(const std::vector<Entrant>& entrants, const TriangleMeshViewf& mesh,
                                           const std::vector<PathSample>& samples);

}  // namespace surehit::benchmark
