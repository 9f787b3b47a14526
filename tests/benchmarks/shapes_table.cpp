#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "command_line/progress_bar.hpp"
#include "sweep_entrants.hpp"
#include "tables.hpp"

namespace surehit::benchmark {
namespace {

/// A shape's size, as a percentage of the mesh's diagonal.
constexpr std::array sizes_in_percent = {0.1, 1.0, 5.0};
/// How far the ends of close sweeps are moved, as a share of the diagonal, to make them general ones.
constexpr double moved_share = 1e-4;
constexpr const char* segments = "surehit segment batch";
constexpr const char* batch = "surehit batch";
constexpr const char* single = "surehit single";

/// The size in float with few binary digits. So heights above planes are exact where coordinates have few of them too.
float short_size(double size) {
  int exponent = 0;
  const double significand = std::frexp(size, &exponent);
  return static_cast<float>(std::ldexp(std::round(std::ldexp(significand, 8)), exponent - 8));
}

/// Sweeps to measure with, and others of the same set to warm up with.
struct SweepSample {
  SweepSample(ShapeKind kind, float size, const PathBatch& measured, const PathBatch& others)
      : sweeps(kind, size, measured), warm_up(kind, size, others) {}

  SweepBatch sweeps;
  SweepBatch warm_up;
};

/// What was measured of an entrant on one sample.
struct SweepResult {
  std::string name;
  bool is_ours;
  RoundSeries nanoseconds = {};        ///< per sweep
  RoundSeries nanoseconds_moved = {};  ///< of ours, for the same sweeps moved a bit, if they are close ones
  std::size_t judged = 0;
  std::size_t missed = 0;
  std::size_t invented = 0;
};

struct SweepRow {
  Place place;
  std::vector<SweepResult> results;
  double hit_share = 0;
  double start_share = 0;  ///< of the sweeps that begin with a contact

  [[nodiscard]] const SweepResult& result_of(const std::string& name) const {
    return *std::find_if(results.begin(), results.end(),
                         [&](const SweepResult& result) { return result.name == name; });
  }
  [[nodiscard]] bool has_moved() const { return !result_of(batch).nanoseconds_moved.empty(); }
};

bool is_among(SweepSet set, const std::vector<PathSet>& chosen) {
  return std::find(chosen.begin(), chosen.end(), path_set_of(set)) != chosen.end();
}

std::string text_of(double percent) { return short_number(percent) + "%"; }

class SweepContest {
 public:
  SweepContest(const NamedMesh& named, const std::vector<SweepEntrant>& entrants, const Request& request)
      : named_(named), entrants_(entrants), request_(request) {
    for (const ShapeKind kind : request.shapes) {
      for (const SweepSet set : general_sweep_sets) add_samples(kind, set, false);
      for (const SweepSet set : close_sweep_sets) add_samples(kind, set, true);
    }
  }

  /// Everybody builds, and answers all sets. Another one begins each time.
  void run_round(std::size_t round) {
    std::vector<std::pair<std::size_t, std::unique_ptr<SweepContender>>> starters;
    for (std::size_t i = 0; i < entrants_.size(); ++i) {
      const std::size_t entrant = (round + i) % entrants_.size();
      starters.emplace_back(entrant, entrants_[entrant].make());
      starters.back().second->build(named_.mesh.view());
    }
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      for (const auto& [entrant, contender] : starters) {
        SweepResult& result = rows_[i].results[entrant];
        result.nanoseconds.push_back(time_of(*contender, entrants_[entrant], samples_[i]));
        if (moved_[i] && entrants_[entrant].is_ours()) {
          result.nanoseconds_moved.push_back(time_of(*contender, entrants_[entrant], *moved_[i]));
        }
      }
    }
  }

  /// Compares decisions with those of surehit's batches. Shapes that begin with a contact are left out: Bullet does not
  /// mean to report these.
  void judge() {
    for (std::size_t entrant = 0; entrant < entrants_.size(); ++entrant) {
      if (entrants_[entrant].name() == segments) continue;
      const auto contender = entrants_[entrant].make();
      contender->build(named_.mesh.view());
      for (std::size_t i = 0; i < rows_.size(); ++i) {
        const SweepBatch& sweeps = samples_[i].sweeps;
        std::vector<ShapeHitf> hits(std::min(sweeps.paths().size(), entrants_[entrant].max_sweeps));
        contender->first(sweeps, hits);
        if (entrants_[entrant].name() == batch) {
          exact_.push_back(hits);
          set_shares(rows_[i], hits);
        }
        count_wrong(hits, exact_[i], rows_[i].results[entrant]);
        if (entrants_[entrant].name() == single && hits != exact_[i]) {
          throw std::runtime_error("single calls and batches disagree about " + rows_[i].place.paths);
        }
      }
    }
  }

  [[nodiscard]] const std::vector<SweepRow>& rows() const { return rows_; }

 private:
  void add_samples(ShapeKind kind, SweepSet set, bool is_close) {
    if (!is_among(set, request_.sets)) return;
    for (const double percent : sizes_in_percent) {
      const float size = short_size(percent / 100 * named_.diagonal());
      const PathBatch paths = draw_sweeps(set, named_, size, request_.paths, 1);
      const PathBatch warm_up = draw_sweeps(set, named_, size, PathSample::warm_up_batches * request_.paths, 2);
      samples_.emplace_back(kind, size, paths, warm_up);
      moved_.emplace_back();
      if (is_close) {
        const double distance = moved_share * named_.diagonal();
        moved_.back().emplace(kind, size, moved_a_bit(paths, distance, 3), moved_a_bit(warm_up, distance, 4));
      }
      SweepRow row{
          {"shapes", named_.name, named_.mesh.triangles.size(), name_of(set), name_of(kind) + ' ' + text_of(percent)},
          {}};
      for (const SweepEntrant& entrant : entrants_) row.results.push_back({entrant.name(), entrant.is_ours()});
      rows_.push_back(std::move(row));
    }
  }

  /// As in the other tables, it answers other sweeps first. A slow one answers as many as it is measured on.
  static double time_of(SweepContender& contender, const SweepEntrant& entrant, const SweepSample& sample) {
    std::vector<ShapeHitf> hits(std::min(sample.sweeps.paths().size(), entrant.max_sweeps));
    std::vector<ShapeHitf> uncounted(std::min(sample.warm_up.paths().size(), entrant.max_sweeps));
    contender.first(sample.warm_up, uncounted);
    return nanoseconds_of([&] { contender.first(sample.sweeps, hits); }) / static_cast<double>(hits.size());
  }

  static void set_shares(SweepRow& row, const std::vector<ShapeHitf>& hits) {
    const auto share_of = [&](const auto& is_counted) {
      return static_cast<double>(std::count_if(hits.begin(), hits.end(), is_counted)) /
             static_cast<double>(hits.size());
    };
    row.hit_share = share_of([](const ShapeHitf& hit) { return hit.triangle != no_triangle; });
    row.start_share = share_of([](const ShapeHitf& hit) { return hit.started_touching; });
  }

  static void count_wrong(const std::vector<ShapeHitf>& hits, const std::vector<ShapeHitf>& exact,
                          SweepResult& result) {
    for (std::size_t i = 0; i < hits.size(); ++i) {
      if (exact[i].started_touching) continue;
      const bool is_hit = hits[i].triangle != no_triangle;
      const bool touches = exact[i].triangle != no_triangle;
      ++result.judged;
      result.missed += touches && !is_hit ? 1 : 0;
      result.invented += is_hit && !touches ? 1 : 0;
    }
  }

  const NamedMesh& named_;
  const std::vector<SweepEntrant>& entrants_;
  const Request& request_;
  std::vector<SweepSample> samples_;
  std::vector<std::optional<SweepSample>> moved_;  ///< of close sweeps
  std::vector<SweepRow> rows_;
  std::vector<std::vector<ShapeHitf>> exact_;  ///< of each sample
};

void keep_row(const SweepRow& row, Report& report) {
  for (const SweepResult& result : row.results) {
    report.keep(row.place, result.name, "ns per path", summary_of(result.nanoseconds));
    for (const char* ours : {segments, batch, single}) {
      if (result.name == ours) continue;
      report.keep(row.place, result.name, std::string("over ") + ours,
                  summary_of(ratio(result.nanoseconds, row.result_of(ours).nanoseconds)));
    }
    if (!result.nanoseconds_moved.empty()) {
      report.keep(row.place, result.name, "over moved",
                  summary_of(ratio(result.nanoseconds, result.nanoseconds_moved)));
    }
    if (result.name == segments) continue;
    report.keep(row.place, result.name, "missed", summary_of(static_cast<double>(result.missed)));
    report.keep(row.place, result.name, "invented", summary_of(static_cast<double>(result.invented)));
    report.keep(row.place, result.name, "judged", summary_of(static_cast<double>(result.judged)));
  }
}

std::vector<std::string> first_cells(const SweepRow& row) {
  return {row.place.mesh, row.place.paths, row.place.question};
}

void show_singles(const std::vector<SweepRow>& rows, const Report& report) {
  std::vector<std::string> header = {"mesh", "paths", "shape", std::string(single) + " ns"};
  for (const SweepResult& result : rows.front().results) {
    if (!result.is_ours) header.push_back(result.name);
  }
  MarkdownTable table(header, 3);
  for (const SweepRow& row : rows) {
    const RoundSeries& ours = row.result_of(single).nanoseconds;
    std::vector<std::string> cells = first_cells(row);
    cells.push_back(short_number(summary_of(ours).median));
    for (const SweepResult& result : row.results) {
      if (!result.is_ours) cells.push_back(short_number(summary_of(ratio(result.nanoseconds, ours)).median));
    }
    table.add_row(std::move(cells));
  }
  report.show("shapes: first hit: single calls, and how many times as long the others take", table);
}

void show_batches(const std::vector<SweepRow>& rows, const Report& report) {
  MarkdownTable table({"mesh", "paths", "shape", std::string(batch) + " ns", "over segment batch", "over moved a bit"},
                      3);
  for (const SweepRow& row : rows) {
    const SweepResult& ours = row.result_of(batch);
    std::vector<std::string> cells = first_cells(row);
    cells.push_back(short_number(summary_of(ours.nanoseconds).median));
    cells.push_back(short_number(summary_of(ratio(ours.nanoseconds, row.result_of(segments).nanoseconds)).median));
    cells.push_back(row.has_moved() ? short_number(summary_of(ratio(ours.nanoseconds, ours.nanoseconds_moved)).median)
                                    : "");
    table.add_row(std::move(cells));
  }
  report.show("shapes: batches beside segments of the same paths, and beside the same shapes moved a bit", table);
}

void show_wrong(const std::vector<SweepRow>& rows, const Report& report) {
  std::vector<std::string> header = {"mesh", "paths", "shape", "hits", "begin with a contact"};
  for (const SweepResult& result : rows.front().results) {
    if (!result.is_ours) header.push_back(result.name + ": missed, invented, of");
  }
  MarkdownTable table(header, 3);
  for (const SweepRow& row : rows) {
    std::vector<std::string> cells = first_cells(row);
    cells.push_back(text_of(100 * row.hit_share));
    cells.push_back(text_of(100 * row.start_share));
    for (const SweepResult& result : row.results) {
      if (result.is_ours) continue;
      cells.push_back(std::to_string(result.missed) + ", " + std::to_string(result.invented) + ", " +
                      std::to_string(result.judged));
    }
    table.add_row(std::move(cells));
  }
  report.show("shapes: wrong decisions, without shapes that begin with a contact", table);
}

}  // namespace

void measure_shapes(const Request& request, Report& report) {
  const std::vector<SweepEntrant>& entrants = request.sweep_entrants;
  std::vector<SweepRow> rows;
  example::ProgressBar bar("shapes", request.meshes.size() * request.rounds);
  std::size_t rounds = 0;
  for (const NamedMesh& named : request.meshes) {
    SweepContest contest(named, entrants, request);
    for (std::size_t round = 0; round < request.rounds; ++round) {
      contest.run_round(round);
      bar.show(++rounds);
    }
    contest.judge();
    rows.insert(rows.end(), contest.rows().begin(), contest.rows().end());
  }
  bar.hide();
  if (rows.empty()) return;
  for (const SweepRow& row : rows) keep_row(row, report);
  show_singles(rows, report);
  show_batches(rows, report);
  show_wrong(rows, report);
}

}  // namespace surehit::benchmark
