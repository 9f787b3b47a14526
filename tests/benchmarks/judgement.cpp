#include "judgement.hpp"

#include <algorithm>
#include <cstdint>

#include "exact_answers.hpp"
#include "one_a_name.hpp"

namespace surehit::benchmark {

std::vector<Judgement> judge(const std::vector<Entrant>& entrants, const TriangleMeshViewf& mesh,
                             const std::vector<PathSample>& samples) {
  std::vector<std::vector<std::uint8_t>> exact;
  std::vector<Judgement> judgements;
  for (const PathSample& sample : samples) {
    exact.push_back(exact_answers(mesh, sample.paths));
    const std::size_t judged = exact.back().size();
    const auto hits = static_cast<double>(std::count(exact.back().begin(), exact.back().end(), 1));
    judgements.push_back({judged, hits / static_cast<double>(judged), {}});
  }
  for (const Entrant& entrant : entrants) {
    const auto contender = entrant.make();
    contender->build(mesh);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      std::vector<std::uint8_t> blocked(samples[i].paths.size());
      contender->any(samples[i].paths, blocked);
      std::size_t count = 0;
      for (std::size_t j = 0; j < exact[i].size(); ++j) count += exact[i][j] == blocked[j] ? 0 : 1;
      judgements[i].wrong.push_back({&entrant, count});
    }
  }
  for (Judgement& judgement : judgements) {
    judgement.wrong =
        one_a_name(judgement.wrong, [](const WrongCount& x, const WrongCount& y) { return x.count > y.count; });
  }
  return judgements;
}

}  // namespace surehit::benchmark
