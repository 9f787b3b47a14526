#include <utility>

#include "contest_row.hpp"
#include "exact_answers.hpp"
#include "tables.hpp"

namespace surehit::benchmark {
namespace {

void keep(const ContestRow& row, Report& report) {
  Place place = row.place;
  for (const Question question : all_questions) {
    place.question = name_of(question);
    for (const Result& result : row.results_of(question)) {
      const std::string name = result.entrant->name();
      report.keep(place, name, "ns per path", summary_of(result.nanoseconds));
      for (const Result& ours : row.results_of(question)) {
        if (result.entrant->is_ours() || !ours.entrant->is_ours()) continue;
        report.keep(place, name, "over " + ours.entrant->name(),
                    summary_of(ratio(result.nanoseconds, ours.nanoseconds)));
      }
    }
  }
  place.question = name_of(Question::any_hit);
  for (const WrongCount& wrong : row.judgement.wrong) {
    report.keep(place, wrong.entrant->name(), "wrong decisions", summary_of(static_cast<double>(wrong.count)));
  }
}

/// The peers' times over those of one of our ways.
void show_ratios(const std::vector<ContestRow>& rows, Question question, std::size_t our_index, const Report& report) {
  const std::string our_name = rows.front().results_of(question)[our_index].entrant->name();
  std::vector<std::string> header = {"mesh", "paths", our_name + " ns"};
  for (const Result& result : rows.front().results_of(question)) {
    if (!result.entrant->is_ours()) header.push_back(result.entrant->name());
  }
  MarkdownTable table(header, 2);
  for (const ContestRow& row : rows) {
    const RoundSeries& ours = row.results_of(question)[our_index].nanoseconds;
    std::vector<std::string> cells = {row.place.mesh, row.place.paths, short_number(summary_of(ours).median)};
    for (const Result& result : row.results_of(question)) {
      if (result.entrant->is_ours()) continue;
      cells.push_back(short_number(summary_of(ratio(result.nanoseconds, ours)).median));
    }
    table.add_row(std::move(cells));
  }
  report.show(name_of(question) + ": " + our_name + ", and how many times as long the others take", table);
}

void show_wrong_decisions(const std::vector<ContestRow>& rows, const Report& report) {
  std::vector<std::string> header = {"mesh", "paths", "judged", "hits"};
  for (const WrongCount& wrong : rows.front().judgement.wrong) header.push_back(wrong.entrant->name());
  MarkdownTable table(header, 2);
  for (const ContestRow& row : rows) {
    std::vector<std::string> cells = {row.place.mesh, row.place.paths, std::to_string(row.judgement.judged),
                                      short_number(100 * row.judgement.hit_share) + "%"};
    for (const WrongCount& wrong : row.judgement.wrong) cells.push_back(std::to_string(wrong.count));
    table.add_row(std::move(cells));
  }
  report.show("any hit: wrong decisions, as judged by " + exact_judge(), table);
}

}  // namespace

void measure_queries(const Request& request, Report& report) {
  const std::vector<ContestRow> rows = measure_rows("queries", request.entrants, request);
  for (const ContestRow& row : rows) keep(row, report);
  for (const Question question : all_questions) {
    const auto& results = rows.front().results_of(question);
    for (std::size_t i = 0; i < results.size(); ++i) {
      if (results[i].entrant->is_ours()) show_ratios(rows, question, i, report);
    }
  }
  show_wrong_decisions(rows, report);
}

}  // namespace surehit::benchmark
