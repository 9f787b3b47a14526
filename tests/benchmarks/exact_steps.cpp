#include "exact_steps.hpp"

#include <algorithm>
#include <vector>

#include "exact/exact_contact.hpp"
#include "narrowphase.hpp"
#include "round_series.hpp"

namespace surehit::benchmark {
namespace {

using detail::Candidate;
using detail::Narrowphase;
using detail::PathRange;

/// What one exact step was asked; an order also about the other triangle.
struct Step {
  Pathf path;
  Trianglef triangle;
  Trianglef other;
};

struct Steps {
  static constexpr std::size_t enough = 64;

  std::vector<Step> decisions;
  std::vector<Step> orders;
  std::vector<Step> roundings;

  [[nodiscard]] bool lack_any_of(const QueryStatistics& taken) const {
    const auto lack = [](const std::vector<Step>& steps, std::uint64_t count) {
      return count > 0 && steps.size() < enough;
    };
    return lack(decisions, taken.exact_decisions) || lack(orders, taken.exact_orders) ||
           lack(roundings, taken.exact_roundings);
  }

  void add_those_of(const Colliderf& collider, const Pathf& path);
};

QueryStatistics taken_by(const Colliderf& collider, const Segmentf& segment) {
  QueryStatistics statistics;
  Hitf hit;
  std::uint8_t blocked = 0;
  collider.first_hits(std::span(&segment, 1), std::span(&hit, 1), {.statistics = &statistics});
  collider.any_hits(std::span(&segment, 1), std::span(&blocked, 1), {.statistics = &statistics});
  return statistics;
}

void Steps::add_those_of(const Colliderf& collider, const Pathf& path) {
  const QueryOptions<float> options;
  const PathRange<float> range(path, options);
  QueryStatistics statistics;
  const Narrowphase<float> narrowphase(path, options, range, statistics);
  std::vector<Candidate<float>> met;
  for (std::uint32_t id = 0; id < collider.triangle_count(); ++id) {
    Candidate<float> candidate{id, collider.triangle(id), {}};
    const std::uint64_t before = statistics.exact_decisions;
    if (narrowphase.find_contact(candidate.triangle, candidate.contact)) met.push_back(candidate);
    if (statistics.exact_decisions > before) decisions.push_back({path, candidate.triangle, candidate.triangle});
  }
  if (met.empty()) return;
  std::sort(met.begin(), met.end(), [&](const auto& x, const auto& y) { return narrowphase.comes_before(x, y); });
  for (std::size_t i = 1; i < met.size(); ++i) {
    const std::uint64_t before = statistics.exact_orders;
    static_cast<void>(narrowphase.comes_before(met[i - 1], met[i]));
    if (statistics.exact_orders > before) orders.push_back({path, met[i - 1].triangle, met[i].triangle});
  }
  static_cast<void>(narrowphase.hit(met.front()));
  if (statistics.exact_roundings > 0) roundings.push_back({path, met.front().triangle, met.front().triangle});
}

template <typename Settle>
double nanoseconds_each(const std::vector<Step>& steps, const Settle& settle) {
  if (steps.empty()) return 0;
  RoundSeries times;
  for (int i = 0; i < 5; ++i) {
    const double time = nanoseconds_of<ThreadClock>([&] {
      for (const Step& step : steps) settle(step, PathRange<float>(step.path, {}));
    });
    times.push_back(time / static_cast<double>(steps.size()));
  }
  return summary_of(times).median;
}

}  // namespace

ExactStepTimes exact_step_times(const Colliderf& collider, std::span<const Segmentf> paths) {
  Steps steps;
  for (const Segmentf& segment : paths) {
    if (steps.lack_any_of(taken_by(collider, segment))) steps.add_those_of(collider, segment);
  }
  using Range = PathRange<float>;
  return {nanoseconds_each(steps.decisions,
                           [](const Step& step, const Range& range) {
                             static_cast<void>(detail::exact_contact(step.path, step.triangle, range));
                           }),
          nanoseconds_each(steps.orders,
                           [](const Step& step, const Range& range) {
                             static_cast<void>(detail::exact_order(step.path, step.triangle, step.other, range));
                           }),
          nanoseconds_each(steps.roundings, [](const Step& step, const Range& range) {
            Hitf hit;
            detail::exact_rounding(step.path, step.triangle, range, hit);
          })};
}

}  // namespace surehit::benchmark
