#include <algorithm>

#include "pinned_threads.hpp"
#include "question.hpp"
#include "tables.hpp"

namespace surehit::benchmark {
namespace {

constexpr std::array thread_counts = {std::size_t{1}, std::size_t{2}};

/// Those whose ratio the table shows, each with a way to ask that needs no choice.
std::vector<Entrant> threaded_entrants(const std::vector<Entrant>& entrants) {
  std::vector<Entrant> chosen;
  std::copy_if(entrants.begin(), entrants.end(), std::back_inserter(chosen), [](const Entrant& entrant) {
    return entrant.name() == "surehit batch" || entrant.name() == "Embree fast medium x1";
  });
  return chosen;
}

std::vector<PathBatch> parts_of(const PathBatch& paths, std::size_t parts) {
  std::vector<PathBatch> all;
  for (std::size_t i = 0; i < parts; ++i) all.push_back(paths.part(i, parts));
  return all;
}

struct ThreadResult {
  const Entrant* entrant;
  std::array<RoundSeries, thread_counts.size()> nanoseconds;  ///< per path

  [[nodiscard]] RoundSeries speedup() const { return ratio(nanoseconds.front(), nanoseconds.back()); }
};

std::vector<ThreadResult> race_threads(const std::vector<Entrant>& entrants, const NamedMesh& named,
                                       const PathBatch& paths, std::size_t rounds) {
  std::vector<ThreadResult> results;
  std::vector<std::unique_ptr<Contender>> contenders;
  for (const Entrant& entrant : entrants) {
    results.push_back({&entrant, {}});
    contenders.push_back(entrant.make());
    contenders.back()->build(named.mesh.view());
  }
  std::array<std::vector<PathBatch>, thread_counts.size()> parts;
  for (std::size_t i = 0; i < parts.size(); ++i) parts[i] = parts_of(paths, thread_counts[i]);
  std::vector<Hitf> hits(paths.size());
  for (std::size_t round = 0; round <= rounds; ++round) {
    for (std::size_t i = 0; i < results.size(); ++i) {
      for (std::size_t j = 0; j < parts.size(); ++j) {
        const PinnedThreads threads(thread_counts[j]);
        const double time = nanoseconds_of([&] { contenders[i]->first_on_threads(paths, parts[j], threads, hits); });
        if (round > 0) results[i].nanoseconds[j].push_back(time / static_cast<double>(paths.size()));
      }
    }
  }
  return results;
}

void add_row(const Place& place, const std::vector<ThreadResult>& results, MarkdownTable& table, Report& report) {
  const ThreadResult& ours = results.front();
  std::vector<std::string> cells = {place.mesh, place.paths};
  for (const ThreadResult& result : results) {
    const std::string name = result.entrant->name();
    for (std::size_t i = 0; i < thread_counts.size(); ++i) {
      const std::string on_threads = " on " + std::to_string(thread_counts[i]) + " threads";
      const Summary time = summary_of(result.nanoseconds[i]);
      report.keep(place, name, "ns per path" + on_threads, time);
      cells.push_back(short_number(time.median));
      if (result.entrant->is_ours()) continue;
      report.keep(place, name, "over surehit batch" + on_threads,
                  summary_of(ratio(result.nanoseconds[i], ours.nanoseconds[i])));
    }
    const Summary speedup = summary_of(result.speedup());
    report.keep(place, name, "speedup", speedup);
    cells.push_back(short_number(speedup.median));
  }
  table.add_row(std::move(cells));
}

}  // namespace

void measure_threads(const Request& request, Report& report) {
  constexpr std::size_t larger = 10;  // so that the start of a thread does not count for much
  const std::vector<Entrant> entrants = threaded_entrants(request.entrants);
  std::vector<std::string> header = {"mesh", "paths"};
  for (const Entrant& entrant : entrants) {
    for (const std::size_t count : thread_counts) header.push_back(entrant.name() + ", " + std::to_string(count));
    header.push_back("speedup");
  }
  MarkdownTable table(header, 2);
  for (const NamedMesh& named : request.meshes) {
    for (const PathSet set : request.sets) {
      const PathBatch paths = draw_paths(set, named, larger * request.paths);
      const Place place{"threads", named.name, named.mesh.triangles.size(), name_of(set),
                        name_of(Question::closest_hit)};
      add_row(place, race_threads(entrants, named, paths, request.rounds), table, report);
    }
  }
  report.show("threads: ns per path on 1 thread and on 2, closest hit", table);
}

}  // namespace surehit::benchmark
