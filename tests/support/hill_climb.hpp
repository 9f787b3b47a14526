#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "support/case_count.hpp"

namespace surehit::test {

/// Climbs from drawn inputs to worse ones, and returns the max share of a bound that it finds. `draw()` returns an
/// input, and `changed(input)` one beside it. `share_of(input)` is 0 or less where an input has no share. Then another
/// one is drawn.
template <typename Draw, typename Changed, typename ShareOf>
double climb_to_worst(std::size_t starts, std::size_t steps, const Draw& draw, const Changed& changed,
                      const ShareOf& share_of) {
  double worst = 0;
  for (; starts > 0; --starts) {
    auto best = draw();
    double best_share = share_of(best);
    for (std::size_t step = case_count(steps); step > 0; --step) {
      auto next = best_share > 0 ? changed(best) : draw();
      const double next_share = share_of(next);
      if (next_share < best_share) continue;
      best = std::move(next);
      best_share = next_share;
    }
    worst = std::max(worst, best_share);
  }
  return worst;
}

/// Records the worst share of a bound that a search has found. It must be below 1, and a long search finds one.
inline void expect_within_bound(const std::string& name, double worst) {
  testing::Test::RecordProperty("worst_share_of_" + name, std::to_string(worst));
  EXPECT_LT(worst, 1) << name;
  if (runs_all_cases()) {
    EXPECT_GT(worst, 0) << name;
  }
}

}  // namespace surehit::test
