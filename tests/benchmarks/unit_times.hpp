#pragma once

#include <cstddef>

namespace surehit::benchmark {

/// Nanoseconds of the thread that batches take for one of each where nothing holds them up.
struct UnitTimes {
  double cycle = 0;      ///< of the core's clock
  double cell = 0;       ///< a step of the walk, and the cell's box, which the path misses
  double candidate = 0;  ///< a triangle of a full block, which the path misses
};

/// Each from the difference between much of it and twice as much, with everything in the nearest cache and one way
/// through all branches: a row of cells that is walked along, one cell with many triangles, a chain of additions.
[[nodiscard]] UnitTimes unit_times(std::size_t rounds);

}  // namespace surehit::benchmark
