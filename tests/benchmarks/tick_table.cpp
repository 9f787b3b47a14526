#include <algorithm>

#include "one_a_name.hpp"
#include "question.hpp"
#include "tables.hpp"

namespace surehit::benchmark {
namespace {

using Mesh = example::Mesh<float>;

/// The same mesh, every vertex up to 0.05% of the diagonal away.
Mesh deformed(const NamedMesh& named, std::uint64_t seed) {
  Mesh mesh = named.mesh;
  test::Random random(seed);
  const double reach = 0.0005 * named.diagonal();
  for (auto& vertex : mesh.vertices) {
    const Vector3d place = Vector3f::Map(vertex.data()).cast<double>() + reach * draw_in_unit_ball(random);
    Vector3f::Map(vertex.data()) = place.cast<float>();
  }
  return mesh;
}

/// Those whose builds are meant for meshes that move.
std::vector<Entrant> dynamic_entrants(const std::vector<Entrant>& entrants) {
  std::vector<Entrant> chosen;
  std::copy_if(entrants.begin(), entrants.end(), std::back_inserter(chosen), [](const Entrant& entrant) {
    return entrant.name() == "surehit batch" || entrant.library == "Embree fast low";
  });
  return chosen;
}

struct TickResult {
  const Entrant* entrant;
  RoundSeries rebuild;
  RoundSeries whole;  ///< with the paths
};

std::vector<TickResult> race_ticks(const std::vector<Entrant>& entrants, const std::array<Mesh, 2>& meshes,
                                   const PathBatch& paths, std::size_t rounds) {
  std::vector<TickResult> results;
  std::vector<std::unique_ptr<Contender>> contenders;
  for (const Entrant& entrant : entrants) {
    results.push_back({&entrant, {}, {}});
    contenders.push_back(entrant.make());
    contenders.back()->build(meshes[1].view());
  }
  Answers answers(paths.size());
  for (std::size_t round = 0; round <= rounds; ++round) {
    const TriangleMeshViewf mesh = meshes[round % 2].view();
    for (std::size_t i = 0; i < results.size(); ++i) {
      const double rebuild = nanoseconds_of([&] { contenders[i]->rebuild(mesh); });
      const double queries = nanoseconds_of([&] { ask(*contenders[i], Question::closest_hit, paths, answers); });
      if (round == 0) continue;
      results[i].rebuild.push_back(rebuild);
      results[i].whole.push_back(rebuild + queries);
    }
  }
  return one_a_name(results, [](const TickResult& x, const TickResult& y) {
    return summary_of(x.whole).median < summary_of(y.whole).median;
  });
}

}  // namespace

void measure_ticks(const Request& request, Report& report) {
  const std::vector<Entrant> entrants = dynamic_entrants(request.entrants);
  std::vector<std::string> header = {"mesh", "paths", "surehit batch ms", "of it rebuild"};
  for (const Entrant& entrant : entrants) {
    if (!entrant.is_ours() && entrant.name() != header.back()) header.push_back(entrant.name());
  }
  MarkdownTable table(header, 1);
  for (const NamedMesh& named : request.meshes) {
    const std::array<Mesh, 2> meshes = {deformed(named, 1), deformed(named, 2)};
    for (const std::size_t count : request.tick_paths) {
      const PathBatch paths = draw_paths(PathSet::short_paths, named, count);
      const Place place{"tick", named.name, named.mesh.triangles.size(), std::to_string(count) + " short",
                        name_of(Question::closest_hit)};
      const std::vector<TickResult> results = race_ticks(entrants, meshes, paths, request.rounds);
      const TickResult& ours = results.front();
      std::vector<std::string> cells = {named.name, std::to_string(count),
                                        short_number(summary_of(ours.whole).median / 1e6),
                                        short_number(summary_of(ours.rebuild).median / 1e6)};
      for (const TickResult& result : results) {
        const std::string name = result.entrant->name();
        report.keep(place, name, "rebuild ns", summary_of(result.rebuild));
        report.keep(place, name, "tick ns", summary_of(result.whole));
        if (result.entrant->is_ours()) continue;
        const Summary whole_ratio = summary_of(ratio(result.whole, ours.whole));
        report.keep(place, name, "over surehit batch", whole_ratio);
        cells.push_back(short_number(whole_ratio.median));
      }
      table.add_row(std::move(cells));
    }
  }
  report.show("tick: rebuild and short paths, closest hit, and how many times as long the others take", table);
}

}  // namespace surehit::benchmark
