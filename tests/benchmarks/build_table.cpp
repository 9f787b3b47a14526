#include <cstddef>

#include "build_race.hpp"
#include "tables.hpp"

namespace surehit::benchmark {
namespace {

/// For each of another table's: a small mesh is built in a tenth of a millisecond, and the first rounds, in which
/// memory is new, take no longer. With 3 in all, a peer took 2.4 to 2.8 times as long on the smallest mesh, from run to
/// run; with 27, 3.1 to 3.35.
constexpr std::size_t build_rounds = 9;

}  // namespace

void measure_builds(const Request& request, Report& report) {
  const std::vector<Entrant> entrants = one_a_library(request.entrants);
  std::vector<std::string> time_header = {"mesh", "triangles", "surehit ms"};
  std::vector<std::string> memory_header = {"mesh", "triangles", "surehit MB"};
  for (const Entrant& entrant : entrants) {
    if (entrant.is_ours()) continue;
    time_header.push_back(entrant.library);
    memory_header.push_back(entrant.library);
  }
  MarkdownTable times(time_header, 1);
  MarkdownTable memory(memory_header, 1);
  for (const NamedMesh& named : request.meshes) {
    const Place place{"build", named.name, named.mesh.triangles.size()};
    const std::vector<BuildResult> results = race_builds(entrants, named.mesh.view(), build_rounds * request.rounds);
    const BuildResult& ours = results.front();
    std::vector<std::string> time_cells = {place.mesh, std::to_string(place.triangles)};
    std::vector<std::string> memory_cells = time_cells;
    for (const BuildResult& result : results) {
      const std::string& library = result.entrant->library;
      const Summary time = summary_of(result.nanoseconds);
      const auto bytes = static_cast<double>(result.memory_bytes);
      report.keep(place, library, "build ns", time);
      report.keep(place, library, "bytes", summary_of(bytes));
      if (result.entrant->is_ours()) {
        time_cells.push_back(short_number(time.median / 1e6));
        memory_cells.push_back(short_number(bytes / 1e6));
        continue;
      }
      const Summary time_ratio = summary_of(ratio(result.nanoseconds, ours.nanoseconds));
      const double memory_ratio = bytes / static_cast<double>(ours.memory_bytes);
      report.keep(place, library, "build over surehit", time_ratio);
      report.keep(place, library, "bytes over surehit", summary_of(memory_ratio));
      time_cells.push_back(short_number(time_ratio.median));
      memory_cells.push_back(short_number(memory_ratio));
    }
    times.add_row(std::move(time_cells));
    memory.add_row(std::move(memory_cells));
  }
  report.show("build: time of surehit, and how many times as long the others take", times);
  report.show("build: memory of surehit, and how many times as much the others take", memory);
}

}  // namespace surehit::benchmark
