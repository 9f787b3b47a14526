#pragma once

#include <span>
#include <surehit/collider.hpp>

namespace surehit::benchmark {

/// Nanoseconds of the thread that exact arithmetic takes for one of each; 0 where none was found.
struct ExactStepTimes {
  double decision = 0;
  double order = 0;
  double rounding = 0;
};

/// Means over what it has to settle along the first of the paths that take it. Asks every triangle about these, and
/// times the exact stage alone, once more for what it was asked.
[[nodiscard]] ExactStepTimes exact_step_times(const Colliderf& collider, std::span<const Segmentf> paths);

}  // namespace surehit::benchmark
