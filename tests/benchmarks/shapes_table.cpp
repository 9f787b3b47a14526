#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "command_line/progress_bar.hpp"
#include "sweep_contest.hpp"
#include "tables.hpp"

namespace surehit::benchmark {
namespace {

/// A shape's size, as a percentage of the mesh's diagonal.
constexpr std::array mesh_sizes_in_percent = {0.1, 1.0, 5.0};
/// How far the ends of close sweeps are moved, as a share of the diagonal, to make them general ones.
constexpr double moved_share = 1e-4;

bool is_among(SweepSet set, const std::vector<PathSet>& chosen) {
  return std::find(chosen.begin(), chosen.end(), path_set_of(set)) != chosen.end();
}

void add_samples(const NamedMesh& named, ShapeKind kind, SweepSet set, bool is_close, const Request& request,
                 SweepContest& contest) {
  if (!is_among(set, request.sets)) return;
  for (const double percent : mesh_sizes_in_percent) {
    const float size = short_size(percent / 100 * named.diagonal());
    const PathBatch paths = draw_sweeps(set, named, size, request.paths, 1);
    const PathBatch warm_up = draw_sweeps(set, named, size, PathSample::warm_up_batches * request.paths, 2);
    std::optional<SweepSample> moved;
    if (is_close) {
      const double distance = moved_share * named.diagonal();
      moved.emplace(kind, size, moved_a_bit(paths, distance, 3), moved_a_bit(warm_up, distance, 4));
    }
    const std::string shape = name_of(kind) + ' ' + text_of_percent(percent);
    contest.add({"shapes", named.name, named.mesh.triangles.size(), name_of(set), shape},
                SweepSample(kind, size, paths, warm_up), std::move(moved));
  }
}

std::vector<std::string> first_cells(const SweepRow& row) {
  return {row.place.mesh, row.place.paths, row.place.question};
}

void show_singles(const std::vector<SweepRow>& rows, const Report& report) {
  std::vector<std::string> header = {"mesh", "paths", "shape", std::string(SweepContest::single) + " ns"};
  for (const SweepResult& result : rows.front().results) {
    if (!result.is_ours) header.push_back(result.name);
  }
  MarkdownTable table(header, 3);
  for (const SweepRow& row : rows) {
    std::vector<std::string> cells = first_cells(row);
    cells.push_back(short_number(summary_of(row.result_of(SweepContest::single).nanoseconds).median));
    for (const SweepResult& result : row.results) {
      if (!result.is_ours) cells.push_back(row.ratio_of(result.name, SweepContest::single));
    }
    table.add_row(std::move(cells));
  }
  report.show("shapes: first hit: single calls, and how many times as long the others take", table);
}

void show_batches(const std::vector<SweepRow>& rows, const Report& report) {
  MarkdownTable table(
      {"mesh", "paths", "shape", std::string(SweepContest::batch) + " ns", "over segment batch", "over moved a bit"},
      3);
  for (const SweepRow& row : rows) {
    const SweepResult& ours = row.result_of(SweepContest::batch);
    std::vector<std::string> cells = first_cells(row);
    cells.push_back(short_number(summary_of(ours.nanoseconds).median));
    cells.push_back(row.ratio_of(SweepContest::batch, SweepContest::segments));
    const bool has_moved = !ours.nanoseconds_moved.empty();
    cells.push_back(has_moved ? short_number(summary_of(ratio(ours.nanoseconds, ours.nanoseconds_moved)).median) : "");
    table.add_row(std::move(cells));
  }
  report.show("shapes: batches beside segments of the same paths, and beside the same shapes moved a bit", table);
}

}  // namespace

void measure_shapes(const Request& request, Report& report) {
  std::vector<SweepRow> rows;
  example::ProgressBar bar("shapes", request.meshes.size() * request.rounds);
  std::size_t rounds = 0;
  for (const NamedMesh& named : request.meshes) {
    const TriangleMeshViewf mesh = named.mesh.view();
    std::vector<SweepContestant> contestants;
    for (const SweepEntrant& entrant : request.sweep_entrants) contestants.push_back(contestant_of(entrant, mesh));
    SweepContest contest(std::move(contestants));
    for (const ShapeKind kind : request.shapes) {
      for (const SweepSet set : general_sweep_sets) add_samples(named, kind, set, false, request, contest);
      for (const SweepSet set : close_sweep_sets) add_samples(named, kind, set, true, request, contest);
    }
    for (std::size_t round = 0; round < request.rounds; ++round) {
      contest.run_round(round);
      bar.show(++rounds);
    }
    contest.judge();
    rows.insert(rows.end(), contest.rows().begin(), contest.rows().end());
  }
  bar.hide();
  if (rows.empty()) return;
  for (const SweepRow& row : rows) keep_sweeps(row, report);
  show_singles(rows, report);
  show_batches(rows, report);
  report.show("shapes: wrong decisions, without shapes that begin with a contact", wrong_sweeps("mesh", rows));
}

}  // namespace surehit::benchmark
