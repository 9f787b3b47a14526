#pragma once

#include <chrono>
#include <cstddef>
#include <vector>

namespace surehit::benchmark {

/// A figure of each round.
using RoundSeries = std::vector<double>;

struct Summary {
  double median;
  double least;
  double greatest;
};

/// Summarizes a series that is not empty.
[[nodiscard]] Summary summary_of(RoundSeries series);
/// Summarizes what is the same in every round.
[[nodiscard]] inline Summary summary_of(double figure) { return {figure, figure, figure}; }
/// Round by round.
[[nodiscard]] RoundSeries ratio(const RoundSeries& over, const RoundSeries& under);

/// The time that this thread has run for: what else the machine does is not in it.
struct ThreadClock {
  using duration = std::chrono::nanoseconds;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<ThreadClock>;
  static constexpr bool is_steady = true;

  [[nodiscard]] static time_point now();
};

template <typename Clock = std::chrono::steady_clock, typename Work>
double nanoseconds_of(const Work& work) {
  const typename Clock::time_point start = Clock::now();
  work();
  return std::chrono::duration<double, std::nano>(Clock::now() - start).count();
}

}  // namespace surehit::benchmark
