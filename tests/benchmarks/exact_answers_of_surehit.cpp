#include <algorithm>
#include <surehit/intersect.hpp>

#include "exact_answers.hpp"

namespace surehit::benchmark {

std::string exact_judge() { return "surehit's intersect with each triangle"; }

std::vector<std::uint8_t> exact_answers(const TriangleMeshViewf& mesh, const PathBatch& paths) {
  constexpr std::size_t pairs = 20'000'000;  // some tenths of a second
  const std::size_t judged = std::min(paths.size(), pairs / std::max<std::size_t>(mesh.triangle_count(), 1) + 1);
  std::vector<std::uint8_t> answers(judged, 0);
  paths.visit([&](const auto& all) {
    for (std::size_t i = 0; i < judged; ++i) {
      for (std::size_t id = 0; id < mesh.triangle_count() && answers[i] == 0; ++id) {
        answers[i] = intersect(all[i], mesh.triangle(id)).has_value() ? 1 : 0;
      }
    }
  });
  return answers;
}

}  // namespace surehit::benchmark
