#include "contest_row.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "command_line/progress_bar.hpp"

namespace surehit::benchmark {
namespace {

std::vector<ContestRow> measure_mesh(const std::string& table, const std::vector<Entrant>& entrants,
                                     const NamedMesh& named, const Request& request,
                                     const std::function<void()>& after_round) {
  const TriangleMeshViewf mesh = named.mesh.view();
  std::vector<PathSample> samples;
  for (const PathSet set : request.sets) samples.emplace_back(set, named, request.paths);
  std::vector<Heat> heats;
  for (const PathSample& sample : samples) {
    for (const Question question : all_questions) heats.push_back({question, &sample});
  }
  const auto results = run_contest(entrants, mesh, heats, request.rounds, after_round);
  const std::vector<Judgement> judgements = judge(entrants, mesh, samples);
  std::vector<ContestRow> rows;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    ContestRow row{{table, named.name, mesh.triangle_count(), name_of(request.sets[i])}, {}, judgements[i]};
    std::copy_n(results.begin() + static_cast<std::ptrdiff_t>(i * row.results.size()), row.results.size(),
                row.results.begin());
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

std::vector<ContestRow> measure_rows(const std::string& table, const std::vector<Entrant>& entrants,
                                     const Request& request) {
  std::vector<ContestRow> rows;
  example::ProgressBar bar(table, request.meshes.size() * request.rounds);
  std::size_t rounds = 0;
  for (const NamedMesh& named : request.meshes) {
    for (ContestRow& row : measure_mesh(table, entrants, named, request, [&] { bar.show(++rounds); })) {
      rows.push_back(std::move(row));
    }
  }
  bar.hide();
  return rows;
}

}  // namespace surehit::benchmark
