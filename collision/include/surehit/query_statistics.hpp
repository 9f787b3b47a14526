#pragma once

#include <cstdint>

namespace surehit {

/// The work of queries. A query adds to the statistics that it is given, and never resets them. Threads that run at the
/// same time need statistics of their own.
///
/// A moving shape counts as a path. Its candidates are the triangles of its lists that may still count. Those that
/// neither the filter nor a simple contact decides are undecided.
///
/// The numbers are not promised. They are no part of an answer, and may differ between machines and versions.
struct QueryStatistics {
  /// The number of paths.
  std::uint64_t paths = 0;
  /// The number of steps in the grid. A step visits one cell, or leaps over a cube of empty cells.
  std::uint64_t cells = 0;
  /// The number of candidates: the lengths of all lists that paths met. A triangle counts once for each list. An
  /// unclipped path has all triangles as candidates.
  std::uint64_t candidates = 0;
  /// The number of candidates that the kernel's bounds for the whole list could not call a miss or a hit.
  std::uint64_t undecided = 0;
  /// The number of times that exact arithmetic had to decide whether a path meets a triangle.
  std::uint64_t exact_decisions = 0;
  /// The number of times that exact arithmetic had to decide which of two hits comes first.
  std::uint64_t exact_orders = 0;
  /// The number of times that exact arithmetic had to round t, u and v of a hit.
  std::uint64_t exact_roundings = 0;
  /// The number of instances of a scene that paths came near. It is 0 for a collider.
  std::uint64_t instances = 0;
  /// The number of paths that started too far from the grid to be clipped. They are tested against all triangles.
  std::uint64_t unclipped = 0;

  /// Adds all numbers of `more`.
  QueryStatistics& operator+=(const QueryStatistics& more) {
    paths += more.paths;
    cells += more.cells;
    candidates += more.candidates;
    undecided += more.undecided;
    exact_decisions += more.exact_decisions;
    exact_orders += more.exact_orders;
    exact_roundings += more.exact_roundings;
    instances += more.instances;
    unclipped += more.unclipped;
    return *this;
  }
};

}  // namespace surehit
