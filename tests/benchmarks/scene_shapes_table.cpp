#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "command_line/progress_bar.hpp"
#include "sweep_contest.hpp"
#include "tables.hpp"
#include "world_paths.hpp"

namespace surehit::benchmark {
namespace {

/// A shape's size, as a percentage of the world's diagonal.
constexpr std::array scene_sizes_in_percent = {0.1, 1.0};
constexpr const char* single_segments = "surehit segment single";
constexpr const char* collider_batch = "its collider batch";
constexpr const char* collider_single = "its collider single";

/// The collider of a world's only mesh, if the mesh is where it was made. Then the same shapes touch both.
std::vector<SweepContestant> colliders_of(const World& world, const TriangleMeshViewf& mesh) {
  std::vector<SweepContestant> colliders;
  const Posef& pose = world.instances.front().pose;
  if (world.instances.size() > 1 || !pose.linear.isIdentity(0) || !pose.translation.isZero(0)) return colliders;
  for (const SweepEntrant& entrant : surehit_sweep_entrants()) {
    SweepContestant contestant = contestant_of(entrant, mesh);
    contestant.name = "its collider " + entrant.way;
    if (!contestant.moves_segments) colliders.push_back(std::move(contestant));
  }
  return colliders;
}

void add_samples(const World& world, const Request& request, SweepContest& contest) {
  const Boxd box = world.box();
  for (const ShapeKind kind : request.shapes) {
    for (const PathSet set : path_sets_of(world)) {
      if (std::find(request.sets.begin(), request.sets.end(), set) == request.sets.end()) continue;
      const WorldSample paths(set, world, request.paths);
      for (const double percent : scene_sizes_in_percent) {
        const float size = short_size(percent / 100 * (box.high - box.low).norm());
        const std::string shape = name_of(kind) + ' ' + text_of_percent(percent);
        contest.add({"scene_shapes", world.name, world.triangle_count(), name_of(set), shape},
                    SweepSample(kind, size, paths.paths, paths.warm_up));
      }
    }
  }
}

/// How many times as long one way takes as another one.
struct RatioColumn {
  std::string title;
  std::string over;
};

/// Shows the time of one way of ours, and ratios. A cell is empty where one of both does not take part.
void show_ways(const std::vector<SweepRow>& rows, const std::string& title, const std::string& ours,
               const std::vector<RatioColumn>& columns, bool has_peers, const Report& report) {
  std::vector<std::string> header = {"scene", "paths", "shape", ours + " ns"};
  for (const RatioColumn& column : columns) header.push_back(column.title);
  std::vector<std::string> peers;
  for (const SweepResult& result : rows.front().results) {
    if (has_peers && !result.is_ours) peers.push_back(result.name);
  }
  header.insert(header.end(), peers.begin(), peers.end());
  MarkdownTable table(header, 3);
  for (const SweepRow& row : rows) {
    std::vector<std::string> cells = {row.place.mesh, row.place.paths, row.place.question,
                                      short_number(summary_of(row.result_of(ours).nanoseconds).median)};
    for (const RatioColumn& column : columns) {
      cells.push_back(row.find(column.over) != nullptr ? row.ratio_of(ours, column.over) : "");
    }
    for (const std::string& peer : peers) cells.push_back(row.ratio_of(peer, ours));
    table.add_row(std::move(cells));
  }
  report.show("scene_shapes: first hit: " + title, table);
}

}  // namespace

void measure_world_shapes(const Request& request, Report& report) {
  std::vector<SweepRow> rows;
  example::ProgressBar bar("scene_shapes", request.worlds.size() * request.rounds);
  std::size_t rounds = 0;
  for (const std::string& name : request.worlds) {
    const World world = build_world(name, request.detail);
    const TriangleMeshViewf first_mesh = world.meshes.front().view();
    std::vector<SweepContestant> contestants;
    for (const auto& entrant : request.world_sweep_entrants) contestants.push_back(contestant_of(entrant, world));
    for (SweepContestant& collider : colliders_of(world, first_mesh)) contestants.push_back(std::move(collider));
    SweepContest contest(std::move(contestants));
    add_samples(world, request, contest);
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
  show_ways(rows, "single calls beside segments and their collider, and how many times as long the others take",
            SweepContest::single, {{"over segment single", single_segments}, {"over its collider", collider_single}},
            true, report);
  show_ways(rows, "batches beside segments, single calls and their collider", SweepContest::batch,
            {{"over segment batch", SweepContest::segments},
             {"over single", SweepContest::single},
             {"over its collider", collider_batch}},
            false, report);
  report.show("scene_shapes: wrong decisions, without shapes that begin with a contact", wrong_sweeps("scene", rows));
}

}  // namespace surehit::benchmark
