#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>

#include "support/case_count.hpp"

namespace surehit::test {

/// Climbs from drawn inputs to worse ones, and returns the greatest share of a bound that it finds. `draw()` is an
/// input, `changed(input)` is one like it, and `share_of(input)` is 0 where an input has no share.
template <typename Draw, typename Changed, typename ShareOf>
double climbed_share(std::size_t starts, std::size_t steps, const Draw& draw, const Changed& changed,
                     const ShareOf& share_of) {
  double greatest = 0;
  for (; starts > 0; --starts) {
    auto best = draw();
    double best_share = share_of(best);
    for (std::size_t step = case_count(steps); step > 0; --step) {
      // Where the input has no share, there is nothing to climb from.
      auto next = best_share > 0 ? changed(best) : draw();
      const double share = share_of(next);
      if (share < best_share) continue;
      best = std::move(next);
      best_share = share;
    }
    greatest = std::max(greatest, best_share);
  }
  return greatest;
}

}  // namespace surehit::test
