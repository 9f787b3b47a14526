#include <algorithm>
#include <cstddef>
#include <utility>

#include "contest_row.hpp"
#include "exact_answers.hpp"
#include "tables.hpp"

namespace surehit::benchmark {
namespace {

/// Rounds for each of another table: what is looked for is a few percent, no more than what one round is off by. With
/// 3, the median of a row wandered by 3 points from run to run; with 9, by 1.
constexpr std::size_t times_as_many_rounds = 9;

/// By how many percent the shipped batch takes longer than another, round by round.
RoundSeries cost_in_percent(const RoundSeries& shipped, const RoundSeries& inexact) {
  RoundSeries cost = ratio(shipped, inexact);
  std::transform(cost.begin(), cost.end(), cost.begin(), [](double times) { return 100 * (times - 1); });
  return cost;
}

void add_row(const ContestRow& row, MarkdownTable& table, Report& report) {
  Place place = row.place;
  std::vector<std::string> cells = {place.mesh, place.paths};
  for (const Question question : all_questions) {
    place.question = name_of(question);
    const std::vector<Result>& results = row.results_of(question);
    const Result& shipped = results.front();
    for (const Result& result : results) {
      const Summary time = summary_of(result.nanoseconds);
      report.keep(place, result.entrant->name(), "ns per path", time);
      cells.push_back(short_number(time.median));
      if (&result == &shipped) continue;
      const Summary cost = summary_of(cost_in_percent(shipped.nanoseconds, result.nanoseconds));
      report.keep(place, result.entrant->name(), "cost of exactness in %", cost);
      cells.push_back(short_number(cost.median) + "%");
    }
  }
  for (const WrongCount& wrong : row.judgement.wrong) {
    report.keep(place, wrong.entrant->name(), "wrong decisions", summary_of(static_cast<double>(wrong.count)));
    if (!wrong.entrant->is_ours()) cells.push_back(std::to_string(wrong.count));
  }
  cells.push_back(std::to_string(row.judgement.judged));
  table.add_row(std::move(cells));
}

}  // namespace

void measure_exactness(const Request& request, Report& report) {
  std::vector<Entrant> entrants = inexact_entrants();
  entrants.insert(entrants.begin(), surehit_entrants().front());
  std::vector<std::string> header = {"mesh", "paths"};
  for (const Question question : all_questions) {
    header.push_back(name_of(question) + " ns");
    for (const char* lacking : {"without exact stage", "without filter"}) {
      header.insert(header.end(), {lacking, "cost"});
    }
  }
  header.insert(header.end(), {"wrong without exact stage", "without filter", "judged"});
  MarkdownTable table(header, 2);
  Request of_more_rounds = request;
  of_more_rounds.rounds *= times_as_many_rounds;
  of_more_rounds.sets = sets_of_segments(request.sets);
  for (const ContestRow& row : measure_rows("exactness", entrants, of_more_rounds)) add_row(row, table, report);
  report.show("exactness: " + entrants.front().name() +
                  " and the same without its exact stage or its filter, whose any-hit decisions " + exact_judge() +
                  " judges",
              table);
}

}  // namespace surehit::benchmark
