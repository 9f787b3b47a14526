#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <surehit/triangle_mesh_view.hpp>
#include <vector>

#include "entrants.hpp"
#include "path_set.hpp"
#include "question.hpp"
#include "round_series.hpp"

namespace surehit::benchmark {

/// What an entrant took for one path, round by round.
struct Result {
  const Entrant* entrant;
  RoundSeries nanoseconds;
};

/// Paths and what is asked about them.
struct Heat {
  Question question;
  const PathSample* sample;
};

/// For each heat a result for each way to ask a library: where entrants differ in their variant alone, that of the
/// fastest.
///
/// Every round builds all contenders anew, so that where their structures lie in memory differs between rounds and not
/// only between runs, and then asks everybody in each heat; whoever comes first in one round comes last in the next.
[[nodiscard]] std::vector<std::vector<Result>> run_contest(const std::vector<Entrant>& entrants,
                                                           const TriangleMeshViewf& mesh, std::span<const Heat> heats,
                                                           std::size_t rounds,
                                                           const std::function<void()>& after_round);

}  // namespace surehit::benchmark
