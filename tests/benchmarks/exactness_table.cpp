#include <algorithm>
#include <utility>

#include "contest_row.hpp"
#include "exact_answers.hpp"
#include "tables.hpp"

namespace surehit::benchmark {
namespace {

/// By how many percent surehit takes longer than without its filter, round by round.
RoundSeries cost_in_percent(const RoundSeries& shipped, const RoundSeries& unfiltered) {
  RoundSeries cost = ratio(shipped, unfiltered);
  std::transform(cost.begin(), cost.end(), cost.begin(), [](double times) { return 100 * (times - 1); });
  return cost;
}

void add_row(const ContestRow& row, MarkdownTable& table, Report& report) {
  Place place = row.place;
  std::vector<std::string> cells = {place.mesh, place.paths};
  for (const Question question : all_questions) {
    place.question = name_of(question);
    const std::vector<Result>& results = row.results_of(question);
    for (const Result& result : results) {
      const Summary time = summary_of(result.nanoseconds);
      report.keep(place, result.entrant->name(), "ns per path", time);
      cells.push_back(short_number(time.median));
    }
    const Summary cost = summary_of(cost_in_percent(results.front().nanoseconds, results.back().nanoseconds));
    report.keep(place, results.front().entrant->name(), "cost of exactness in %", cost);
    cells.push_back(short_number(cost.median) + "%");
  }
  for (const WrongCount& wrong : row.judgement.wrong) {
    report.keep(place, wrong.entrant->name(), "wrong decisions", summary_of(static_cast<double>(wrong.count)));
  }
  cells.push_back(std::to_string(row.judgement.wrong.back().count));
  cells.push_back(std::to_string(row.judgement.judged));
  table.add_row(std::move(cells));
}

}  // namespace

void measure_exactness(const Request& request, Report& report) {
  const std::vector<Entrant> entrants = {surehit_entrants().front(), unfiltered_entrant()};
  MarkdownTable table({"mesh", "paths", "closest ns", "without filter", "cost", "any ns", "without filter", "cost",
                       "wrong without filter", "judged"},
                      2);
  for (const ContestRow& row : measure_rows("exactness", entrants, request)) add_row(row, table, report);
  report.show("exactness: " + entrants.front().name() + " and the same without its filter, whose any-hit decisions " +
                  exact_judge() + " judges",
              table);
}

}  // namespace surehit::benchmark
