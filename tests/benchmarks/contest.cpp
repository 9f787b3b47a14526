#include "contest.hpp"

#include "one_a_name.hpp"

namespace surehit::benchmark {
namespace {

struct Starter {
  std::size_t entrant;  ///< which one
  std::unique_ptr<Contender> contender;
};

/// In a round's order: another one begins each time, since what is built and asked later finds other memory and finds
/// other things in the cache.
std::vector<Starter> build_all(const std::vector<Entrant>& entrants, const TriangleMeshViewf& mesh, std::size_t round) {
  std::vector<Starter> starters;
  for (std::size_t i = 0; i < entrants.size(); ++i) {
    const std::size_t entrant = (round + i) % entrants.size();
    starters.push_back({entrant, entrants[entrant].make()});
    starters.back().contender->build(mesh);
  }
  return starters;
}

/// Just before its turn each contender answers other paths of the same kind, uncounted: what the others left in the
/// cache has no say then, and nobody knows a path already.
void run_heat(const Heat& heat, const std::vector<Starter>& starters, std::vector<Result>& results) {
  const auto& [paths, warm_up] = *heat.sample;
  Answers answers(paths.size());
  Answers uncounted(warm_up.size());
  for (const auto& [entrant, contender] : starters) {
    ask(*contender, heat.question, warm_up, uncounted);
    const double time = nanoseconds_of([&] { ask(*contender, heat.question, paths, answers); });
    results[entrant].nanoseconds.push_back(time / static_cast<double>(paths.size()));
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
    const std::vector<Starter> starters = build_all(entrants, mesh, round);
    for (std::size_t i = 0; i < heats.size(); ++i) run_heat(heats[i], starters, results[i]);
    after_round();
  }
  for (std::vector<Result>& of_heat : results) of_heat = one_a_name(of_heat, is_faster);
  return results;
}

}  // namespace surehit::benchmark
