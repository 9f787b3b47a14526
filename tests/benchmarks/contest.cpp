#include "contest.hpp"

#include "one_a_name.hpp"

namespace surehit::benchmark {
namespace {

using Contenders = std::vector<std::unique_ptr<Contender>>;

Contenders build_all(const std::vector<Entrant>& entrants, const TriangleMeshViewf& mesh) {
  Contenders contenders;
  for (const Entrant& entrant : entrants) {
    contenders.push_back(entrant.make());
    contenders.back()->build(mesh);
  }
  return contenders;
}

/// Just before its turn each contender answers other paths of the same kind, uncounted: whose memory the others left in
/// the cache has no say then, and nobody knows a path already.
void run_heat(const Heat& heat, const Contenders& contenders, std::vector<Result>& results) {
  const PathBatch& paths = heat.sample->paths;
  Answers answers(paths.size());
  for (std::size_t i = 0; i < contenders.size(); ++i) {
    ask(*contenders[i], heat.question, heat.sample->warm_up, answers);
    const double time = nanoseconds_of([&] { ask(*contenders[i], heat.question, paths, answers); });
    results[i].nanoseconds.push_back(time / static_cast<double>(paths.size()));
  }
}

bool is_faster(const Result& x, const Result& y) {
  return summary_of(x.nanoseconds).median < summary_of(y.nanoseconds).median;
}

}  // namespace

std::vector<std::vector<Result>> run_contest(const std::vector<Entrant>& entrants, const TriangleMeshViewf& mesh,
                                             std::span<const Heat> heats, std::size_t rounds,
                                             const std::function<void()>& after_round) {
  std::vector<Result> none;
  for (const Entrant& entrant : entrants) none.push_back({&entrant, {}});
  std::vector<std::vector<Result>> results(heats.size(), none);
  for (std::size_t round = 0; round < rounds; ++round) {
    const Contenders contenders = build_all(entrants, mesh);
    for (std::size_t i = 0; i < heats.size(); ++i) run_heat(heats[i], contenders, results[i]);
    after_round();
  }
  for (std::vector<Result>& of_heat : results) of_heat = one_a_name(of_heat, is_faster);
  return results;
}

}  // namespace surehit::benchmark
