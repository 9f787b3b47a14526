#include <surehit/collider.hpp>

#include "exact_steps.hpp"
#include "question.hpp"
#include "tables.hpp"
#include "unit_times.hpp"

namespace surehit::benchmark {
namespace {

QueryStatistics counts_of(const Colliderf& collider, Question question, const PathBatch& paths) {
  QueryStatistics statistics;
  Answers answers(paths.size());
  if (question == Question::closest_hit) {
    collider.first_hits(paths.segments(), answers.hits, {.statistics = &statistics});
  } else {
    collider.any_hits(paths.segments(), answers.blocked, {.statistics = &statistics});
  }
  return statistics;
}

/// Nanoseconds of the thread per path. Other clocks would find interruptions in these times, and none in the far
/// shorter ones of exact steps, whose share would be too small. Warmed up and built anew each time, as in a contest.
RoundSeries times_of(const Entrant& entrant, const NamedMesh& named, Question question, const PathSample& sample,
                     std::size_t rounds) {
  RoundSeries times;
  Answers answers(sample.paths.size());
  Answers uncounted(sample.warm_up.size());
  for (std::size_t round = 0; round < rounds; ++round) {
    const std::unique_ptr<Contender> contender = entrant.make();
    contender->build(named.mesh.view());
    ask(*contender, question, sample.warm_up, uncounted);
    const double time = nanoseconds_of<ThreadClock>([&] { ask(*contender, question, sample.paths, answers); });
    times.push_back(time / static_cast<double>(sample.paths.size()));
  }
  return times;
}

double per_million(std::uint64_t count, std::uint64_t whole) {
  return whole == 0 ? 0 : 1e6 * static_cast<double>(count) / static_cast<double>(whole);
}

void add_exact_steps(const Place& place, const std::string& contender, const QueryStatistics& counts,
                     const RoundSeries& nanoseconds, const ExactStepTimes& times, MarkdownTable& table,
                     Report& report) {
  std::vector<std::string> cells = {place.mesh, place.paths, place.question};
  const auto add = [&](const std::string& measure, const Summary& figure, const char* unit = "") {
    report.keep(place, contender, measure, figure);
    cells.push_back(short_number(figure.median) + unit);
  };
  add("undecided per million candidates", summary_of(per_million(counts.undecided, counts.candidates)));
  add("exact decisions per million paths", summary_of(per_million(counts.exact_decisions, counts.paths)));
  add("exact orders per million paths", summary_of(per_million(counts.exact_orders, counts.paths)));
  add("exact roundings per million paths", summary_of(per_million(counts.exact_roundings, counts.paths)));
  const double exact = (static_cast<double>(counts.exact_decisions) * times.decision +
                        static_cast<double>(counts.exact_orders) * times.order +
                        static_cast<double>(counts.exact_roundings) * times.rounding) /
                       static_cast<double>(counts.paths);
  add("ns per path", summary_of(nanoseconds));
  add("exact ns per path", summary_of(exact));
  const RoundSeries percent(nanoseconds.size(), 100 * exact);
  add("exact share in %", summary_of(ratio(percent, nanoseconds)), "%");
  table.add_row(std::move(cells));
}

/// What the walk's cells and the lists' triangles would take if nothing but them took time.
void add_bound(const Place& place, const std::string& contender, const QueryStatistics& counts,
               const RoundSeries& nanoseconds, const UnitTimes& unit, MarkdownTable& table, Report& report) {
  std::vector<std::string> cells = {place.mesh, place.paths, place.question};
  const auto add = [&](const std::string& measure, const Summary& figure, const char* unit_sign = "") {
    report.keep(place, contender, measure, figure);
    cells.push_back(short_number(figure.median) + unit_sign);
  };
  const auto per_path = [&](std::uint64_t count) {
    return static_cast<double>(count) / static_cast<double>(counts.paths);
  };
  const double bound = per_path(counts.cells) * unit.cell + per_path(counts.candidates) * unit.candidate;
  add("cells per path", summary_of(per_path(counts.cells)));
  add("candidates per path", summary_of(per_path(counts.candidates)));
  cells.push_back(short_number(summary_of(nanoseconds).median));
  add("ns per path of these alone", summary_of(bound));
  const RoundSeries percent(nanoseconds.size(), 100 * bound);
  add("share of these alone in %", summary_of(ratio(percent, nanoseconds)), "%");
  table.add_row(std::move(cells));
}

}  // namespace

void measure_statistics(const Request& request, Report& report) {
  const Entrant entrant = surehit_entrants().front();
  MarkdownTable exact({"mesh", "paths", "asked", "undecided", "decisions", "orders", "roundings", "ns per path",
                       "of it exact", "share"},
                      3);
  MarkdownTable bounds({"mesh", "paths", "asked", "cells", "candidates", "ns per path", "of these alone", "share"}, 3);
  const UnitTimes unit = unit_times(request.rounds);
  for (const NamedMesh& named : request.meshes) {
    const Colliderf collider(named.mesh.view());
    for (const PathSet set : sets_of_segments(request.sets)) {
      const PathSample sample(set, named, request.paths);
      const ExactStepTimes times = exact_step_times(collider, sample.paths.segments());
      for (const Question question : all_questions) {
        const Place place{"statistics", named.name, named.mesh.triangles.size(), name_of(set), name_of(question)};
        const QueryStatistics counts = counts_of(collider, question, sample.paths);
        const RoundSeries nanoseconds = times_of(entrant, named, question, sample, request.rounds);
        add_exact_steps(place, entrant.name(), counts, nanoseconds, times, exact, report);
        add_bound(place, entrant.name(), counts, nanoseconds, unit, bounds, report);
      }
    }
  }
  report.show("statistics: " + entrant.name() +
                  ", undecided per million candidates, exact steps per million paths, and what these take",
              exact);
  const auto in_cycles = [&](double time) { return short_number(time / unit.cycle) + " cycles"; };
  report.show("statistics: " + entrant.name() +
                  ", cells and candidates per path, and what these alone would take (a cell " + in_cycles(unit.cell) +
                  ", 16 candidates " + in_cycles(16 * unit.candidate) + ")",
              bounds);
}

}  // namespace surehit::benchmark
