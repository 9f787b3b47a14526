#include "sweep_contest.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace surehit::benchmark {
namespace {

/// As in the other tables, it answers other sweeps first. A slow one answers as many as it is measured on.
double time_of(SweepAnswerer& answerer, const SweepContestant& contestant, const SweepSample& sample) {
  std::vector<ShapeHitf> hits(std::min(sample.sweeps.paths().size(), contestant.max_sweeps));
  std::vector<ShapeHitf> uncounted(std::min(sample.warm_up.paths().size(), contestant.max_sweeps));
  answerer.first(sample.warm_up, uncounted);
  return nanoseconds_of([&] { answerer.first(sample.sweeps, hits); }) / static_cast<double>(hits.size());
}

void set_shares(SweepRow& row, const std::vector<ShapeHitf>& hits) {
  const auto share_of = [&](const auto& is_counted) {
    return static_cast<double>(std::count_if(hits.begin(), hits.end(), is_counted)) / static_cast<double>(hits.size());
  };
  row.hit_share = share_of([](const ShapeHitf& hit) { return hit.triangle != no_triangle; });
  row.start_share = share_of([](const ShapeHitf& hit) { return hit.started_touching; });
}

void count_wrong(const std::vector<ShapeHitf>& hits, const std::vector<ShapeHitf>& exact, SweepResult& result) {
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (exact[i].started_touching) continue;
    const bool is_hit = hits[i].triangle != no_triangle;
    const bool touches = exact[i].triangle != no_triangle;
    ++result.judged;
    result.missed += touches && !is_hit ? 1 : 0;
    result.invented += is_hit && !touches ? 1 : 0;
  }
}

}  // namespace

const SweepResult* SweepRow::find(const std::string& name) const {
  const auto found =
      std::find_if(results.begin(), results.end(), [&](const SweepResult& result) { return result.name == name; });
  return found == results.end() ? nullptr : &*found;
}

std::string SweepRow::ratio_of(const std::string& name, const std::string& other) const {
  return short_number(summary_of(ratio(result_of(name).nanoseconds, result_of(other).nanoseconds)).median);
}

void SweepContest::add(const Place& place, SweepSample sample, std::optional<SweepSample> moved) {
  samples_.push_back(std::move(sample));
  moved_.push_back(std::move(moved));
  SweepRow row{place, {}};
  for (const SweepContestant& contestant : contestants_) {
    row.results.push_back({contestant.name, contestant.is_ours, contestant.moves_segments});
  }
  rows_.push_back(std::move(row));
}

void SweepContest::run_round(std::size_t round) {
  std::vector<std::pair<std::size_t, std::unique_ptr<SweepAnswerer>>> starters;
  for (std::size_t i = 0; i < contestants_.size(); ++i) {
    const std::size_t contestant = (round + i) % contestants_.size();
    starters.emplace_back(contestant, contestants_[contestant].build());
  }
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    for (const auto& [contestant, answerer] : starters) {
      SweepResult& result = rows_[i].results[contestant];
      result.nanoseconds.push_back(time_of(*answerer, contestants_[contestant], samples_[i]));
      if (moved_[i] && contestants_[contestant].is_ours) {
        result.nanoseconds_moved.push_back(time_of(*answerer, contestants_[contestant], *moved_[i]));
      }
    }
  }
}

void SweepContest::judge() {
  const auto answers_of = [](SweepAnswerer& answerer, const SweepContestant& contestant, const SweepSample& sample) {
    std::vector<ShapeHitf> hits(std::min(sample.sweeps.paths().size(), contestant.max_sweeps));
    answerer.first(sample.sweeps, hits);
    return hits;
  };
  const auto judge = std::find_if(contestants_.begin(), contestants_.end(),
                                  [](const SweepContestant& contestant) { return contestant.name == batch; });
  std::vector<std::vector<ShapeHitf>> exact;
  const auto judging = judge->build();
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    exact.push_back(answers_of(*judging, *judge, samples_[i]));
    set_shares(rows_[i], exact[i]);
  }
  for (std::size_t contestant = 0; contestant < contestants_.size(); ++contestant) {
    if (contestants_[contestant].moves_segments) continue;
    const auto answerer = contestants_[contestant].build();
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const std::vector<ShapeHitf> hits = answers_of(*answerer, contestants_[contestant], samples_[i]);
      count_wrong(hits, exact[i], rows_[i].results[contestant]);
      if (contestants_[contestant].is_ours && hits != exact[i]) {
        throw std::runtime_error(contestants_[contestant].name + " and batches disagree about " + rows_[i].place.paths);
      }
    }
  }
}

float short_size(double size) {
  int exponent = 0;
  const double significand = std::frexp(size, &exponent);
  return static_cast<float>(std::ldexp(std::round(std::ldexp(significand, 8)), exponent - 8));
}

std::string text_of_percent(double percent) { return short_number(percent) + "%"; }

void keep_sweeps(const SweepRow& row, Report& report) {
  for (const SweepResult& result : row.results) {
    report.keep(row.place, result.name, "ns per path", summary_of(result.nanoseconds));
    for (const SweepResult& other : row.results) {
      if (!other.is_ours || other.name == result.name) continue;
      report.keep(row.place, result.name, "over " + other.name,
                  summary_of(ratio(result.nanoseconds, other.nanoseconds)));
    }
    if (!result.nanoseconds_moved.empty()) {
      report.keep(row.place, result.name, "over moved",
                  summary_of(ratio(result.nanoseconds, result.nanoseconds_moved)));
    }
    if (result.moves_segments) continue;
    report.keep(row.place, result.name, "missed", summary_of(static_cast<double>(result.missed)));
    report.keep(row.place, result.name, "invented", summary_of(static_cast<double>(result.invented)));
    report.keep(row.place, result.name, "judged", summary_of(static_cast<double>(result.judged)));
  }
}

MarkdownTable wrong_sweeps(const std::string& where, const std::vector<SweepRow>& rows) {
  std::vector<std::string> header = {where, "paths", "shape", "hits", "begin with a contact"};
  for (const SweepResult& result : rows.front().results) {
    if (!result.is_ours) header.push_back(result.name + ": missed, invented, of");
  }
  MarkdownTable table(header, 3);
  for (const SweepRow& row : rows) {
    std::vector<std::string> cells = {row.place.mesh, row.place.paths, row.place.question,
                                      text_of_percent(100 * row.hit_share), text_of_percent(100 * row.start_share)};
    for (const SweepResult& result : row.results) {
      if (result.is_ours) continue;
      cells.push_back(std::to_string(result.missed) + ", " + std::to_string(result.invented) + ", " +
                      std::to_string(result.judged));
    }
    table.add_row(std::move(cells));
  }
  return table;
}

}  // namespace surehit::benchmark
