#pragma once

#include <cstdint>

namespace surehit {

/// What queries did. A query adds to the statistics that it is given and to no others; they are no part of the answer.
struct QueryStatistics {
  std::uint64_t paths = 0;       ///< paths asked
  std::uint64_t cells = 0;       ///< grid cells, and leaps through empty ones, walked through
  std::uint64_t candidates = 0;  ///< entries of the lists met, a triangle for each cell; of unclipped paths: all
  /// Of the candidates, those that the kernel's bounds could not call a miss or a hit: bounds for a whole list, and
  /// where a batch looks for first hits also those of each triangle.
  std::uint64_t undecided = 0;
  std::uint64_t exact_decisions = 0;  ///< pairs that only exact arithmetic decided
  std::uint64_t exact_orders = 0;     ///< pairs of hits whose order only exact arithmetic told
  std::uint64_t exact_roundings = 0;  ///< hits of which t, u or v took exact arithmetic to round
  std::uint64_t unclipped = 0;        ///< paths too far from the grid to be clipped, which met every triangle

  QueryStatistics& operator+=(const QueryStatistics& more) {
    paths += more.paths;
    cells += more.cells;
    candidates += more.candidates;
    undecided += more.undecided;
    exact_decisions += more.exact_decisions;
    exact_orders += more.exact_orders;
    exact_roundings += more.exact_roundings;
    unclipped += more.unclipped;
    return *this;
  }
};

}  // namespace surehit
