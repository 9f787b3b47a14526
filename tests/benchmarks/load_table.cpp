#include <cstddef>
#include <cstdlib>
#include <span>
#include <string>
#include <surehit/collider.hpp>
#include <vector>

#include "tables.hpp"

namespace surehit::benchmark {
namespace {

/// As for builds, see there.
constexpr std::size_t load_rounds = 9;

/// The times of a build, of a load and of a trusted load, round by round, and the size of the file.
struct LoadTimes {
  RoundSeries build;
  RoundSeries load;
  RoundSeries trusted_load;
  std::size_t file_bytes = 0;
};

std::vector<std::byte> saved(const Colliderf& collider) {
  std::vector<std::byte> bytes;
  const auto append = [&](std::span<const std::byte> piece) {
    bytes.insert(bytes.end(), piece.begin(), piece.end());
    return true;
  };
  if (!collider.save(append)) bytes.clear();
  return bytes;
}

/// Each round builds and loads once, from nothing. One before the first is not counted.
LoadTimes race_loads(const TriangleMeshViewf& mesh, std::size_t rounds) {
  const std::vector<std::byte> bytes = saved(Colliderf(mesh));
  LoadTimes result;
  result.file_bytes = bytes.size();
  for (std::size_t round = 0; round <= rounds; ++round) {
    const auto time = [&](RoundSeries& series, const auto& work) {
      Colliderf collider;
      const double nanoseconds = nanoseconds_of([&] {
        if (!work(collider)) std::abort();
      });
      if (round > 0) series.push_back(nanoseconds);
    };
    time(result.build, [&](Colliderf& collider) { return collider.try_build(mesh).has_value(); });
    time(result.load, [&](Colliderf& collider) { return collider.try_load(bytes).has_value(); });
    time(result.trusted_load,
         [&](Colliderf& collider) { return collider.try_load(bytes, {.is_trusted = true}).has_value(); });
  }
  return result;
}

}  // namespace

void measure_loads(const Request& request, Report& report) {
  MarkdownTable table({"mesh", "triangles", "build ms", "load over build", "trusted load over build", "file MB"}, 1);
  for (const NamedMesh& named : request.meshes) {
    const Place place{"load", named.name, named.mesh.triangles.size()};
    const LoadTimes result = race_loads(named.mesh.view(), load_rounds * request.rounds);
    const Summary build = summary_of(result.build);
    const Summary load = summary_of(ratio(result.load, result.build));
    const Summary trusted_load = summary_of(ratio(result.trusted_load, result.build));
    const auto file_bytes = static_cast<double>(result.file_bytes);
    report.keep(place, "surehit", "build ns", build);
    report.keep(place, "surehit", "load over build", load);
    report.keep(place, "surehit", "trusted load over build", trusted_load);
    report.keep(place, "surehit", "file bytes", summary_of(file_bytes));
    table.add_row({place.mesh, std::to_string(place.triangles), short_number(build.median / 1e6),
                   short_number(load.median), short_number(trusted_load.median), short_number(file_bytes / 1e6)});
  }
  report.show("load: a saved collider beside a build of its mesh", table);
}

}  // namespace surehit::benchmark
