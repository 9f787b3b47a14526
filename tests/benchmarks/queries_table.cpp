#include <algorithm>
#include <functional>
#include <utility>

#include "command_line/progress_bar.hpp"
#include "contest.hpp"
#include "exact_answers.hpp"
#include "judgement.hpp"
#include "tables.hpp"

namespace surehit::benchmark {
namespace {

/// What was measured on one mesh and path set.
struct Row {
  Place place;
  std::array<std::vector<Result>, all_questions.size()> results;
  Judgement judgement;

  [[nodiscard]] const std::vector<Result>& results_of(Question question) const {
    return results[static_cast<std::size_t>(question)];
  }
};

std::vector<Row> measure_rows(const Scene& scene, const Request& request, const std::function<void()>& after_round) {
  const TriangleMeshViewf mesh = scene.mesh.view();
  std::vector<PathSample> samples;
  for (const PathSet set : request.sets) samples.emplace_back(set, scene, request.paths);
  std::vector<Heat> heats;
  for (const PathSample& sample : samples) {
    for (const Question question : all_questions) heats.push_back({question, &sample});
  }
  const auto results = run_contest(request.entrants, mesh, heats, request.rounds, after_round);
  const std::vector<Judgement> judgements = judge(request.entrants, mesh, samples);
  std::vector<Row> rows;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    Row row{{"queries", scene.name, mesh.triangle_count(), name_of(request.sets[i])}, {}, judgements[i]};
    std::copy_n(results.begin() + static_cast<std::ptrdiff_t>(i * row.results.size()), row.results.size(),
                row.results.begin());
    rows.push_back(std::move(row));
  }
  return rows;
}

void keep(const Row& row, Report& report) {
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
void show_ratios(const std::vector<Row>& rows, Question question, std::size_t our_index, const Report& report) {
  const std::string our_name = rows.front().results_of(question)[our_index].entrant->name();
  std::vector<std::string> header = {"mesh", "paths", our_name + " ns"};
  for (const Result& result : rows.front().results_of(question)) {
    if (!result.entrant->is_ours()) header.push_back(result.entrant->name());
  }
  MarkdownTable table(header, 2);
  for (const Row& row : rows) {
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

void show_wrong_decisions(const std::vector<Row>& rows, const Report& report) {
  std::vector<std::string> header = {"mesh", "paths", "judged", "hits"};
  for (const WrongCount& wrong : rows.front().judgement.wrong) header.push_back(wrong.entrant->name());
  MarkdownTable table(header, 2);
  for (const Row& row : rows) {
    std::vector<std::string> cells = {row.place.mesh, row.place.paths, std::to_string(row.judgement.judged),
                                      short_number(100 * row.judgement.hit_share) + "%"};
    for (const WrongCount& wrong : row.judgement.wrong) cells.push_back(std::to_string(wrong.count));
    table.add_row(std::move(cells));
  }
  report.show("any hit: wrong decisions, as judged by " + exact_judge(), table);
}

}  // namespace

void measure_queries(const Request& request, Report& report) {
  std::vector<Row> rows;
  example::ProgressBar bar("queries", request.scenes.size() * request.rounds);
  std::size_t rounds = 0;
  for (const Scene& scene : request.scenes) {
    for (Row& row : measure_rows(scene, request, [&] { bar.show(++rounds); })) rows.push_back(std::move(row));
  }
  bar.hide();
  for (const Row& row : rows) keep(row, report);
  for (const Question question : all_questions) {
    const auto& results = rows.front().results_of(question);
    for (std::size_t i = 0; i < results.size(); ++i) {
      if (results[i].entrant->is_ours()) show_ratios(rows, question, i, report);
    }
  }
  show_wrong_decisions(rows, report);
}

}  // namespace surehit::benchmark
