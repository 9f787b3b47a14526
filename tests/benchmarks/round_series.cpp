#include "round_series.hpp"

#include <algorithm>
#include <ctime>
#include <functional>

namespace surehit::benchmark {

Summary summary_of(RoundSeries series) {
  std::sort(series.begin(), series.end());
  const std::size_t half = series.size() / 2;
  const double median = series.size() % 2 == 1 ? series[half] : (series[half - 1] + series[half]) / 2;
  return {median, series.front(), series.back()};
}

RoundSeries ratio(const RoundSeries& over, const RoundSeries& under) {
  RoundSeries ratios(over.size());
  std::transform(over.begin(), over.end(), under.begin(), ratios.begin(), std::divides<>());
  return ratios;
}

ThreadClock::time_point ThreadClock::now() {
  timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return time_point(std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec));
}

}  // namespace surehit::benchmark
