#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "command_line/progress_bar.hpp"
#include "exact_world_answers.hpp"
#include "question.hpp"
#include "tables.hpp"
#include "world_paths.hpp"

namespace surehit::benchmark {
namespace {

/// A commit takes a millisecond, and is measured more often than queries are.
constexpr std::size_t commit_rounds = 9;
constexpr const char* moving_peer = "Embree fast low x1";
constexpr const char* collider_library = "its collider";

/// The collider of a world's only mesh, asked in the frame of this mesh: what an instance is compared with.
class WithoutScene : public WorldContender {
 public:
  explicit WithoutScene(std::unique_ptr<Contender> contender) : contender_(std::move(contender)) {}

  void build(const World& world) override { contender_->build(world.meshes.front().view()); }
  void move(std::span<const Posef>) override {}
  void exchange_one() override {}
  void first(const PathBatch& paths, std::span<Hitf> hits) override { contender_->first(paths, hits); }
  void any(const PathBatch& paths, std::span<std::uint8_t> blocked) override { contender_->any(paths, blocked); }

 private:
  std::unique_ptr<Contender> contender_;
};

/// Those that are asked in this world. Embree's low quality is for commits alone.
std::vector<WorldEntrant> query_entrants(const World& world, const std::vector<WorldEntrant>& all) {
  std::vector<WorldEntrant> chosen;
  for (const WorldEntrant& entrant : all) {
    if (entrant.name() != moving_peer) chosen.push_back(entrant);
  }
  if (world.instances.size() == 1) {
    for (const Entrant& ours : surehit_entrants()) {
      chosen.push_back({collider_library, ours.way, [ours] { return std::make_unique<WithoutScene>(ours.make()); }});
    }
  }
  return chosen;
}

/// What was measured of an entrant on one set.
struct WorldResult {
  std::string name;
  bool is_ours;
  bool is_peer;
  std::array<RoundSeries, all_questions.size()> nanoseconds;  ///< per path
  std::size_t wrong = 0;                                      ///< any-hit decisions that are not the exact ones

  [[nodiscard]] const RoundSeries& of(Question question) const {
    return nanoseconds[static_cast<std::size_t>(question)];
  }
};

struct WorldRow {
  Place place;
  std::vector<WorldResult> results;
  std::size_t judged = 0;
  double hit_share = 0;

  [[nodiscard]] const WorldResult& result_of(const std::string& name) const {
    return *std::find_if(results.begin(), results.end(),
                         [&](const WorldResult& result) { return result.name == name; });
  }
};

/// Paths in the world, and the same ones as the only mesh sees them.
struct FramedSample {
  WorldSample in_world;
  std::optional<PathBatch> paths_in_mesh = {};
  std::optional<PathBatch> warm_up_in_mesh = {};
};

class WorldContest {
 public:
  WorldContest(const World& world, const Request& request)
      : world_(world), entrants_(query_entrants(world, request.world_entrants)) {
    for (const PathSet set : path_sets_of(world)) {
      if (std::find(request.sets.begin(), request.sets.end(), set) == request.sets.end()) continue;
      FramedSample sample{WorldSample(set, world, request.paths)};
      if (world.instances.size() == 1) {
        const Posef& pose = world.instances.front().pose;
        sample.paths_in_mesh = in_frame_of(pose, sample.in_world.paths);
        sample.warm_up_in_mesh = in_frame_of(pose, sample.in_world.warm_up);
      }
      WorldRow row{{"scene", world.name, world.triangle_count(), name_of(set)}, {}};
      for (const WorldEntrant& entrant : entrants_) {
        row.results.push_back({entrant.name(), entrant.is_ours(), is_peer(entrant), {}});
      }
      samples_.push_back(std::move(sample));
      rows_.push_back(std::move(row));
    }
  }

  /// Everybody builds, and answers all sets. Another one begins each time.
  void run_round(std::size_t round) {
    std::vector<std::pair<std::size_t, std::unique_ptr<WorldContender>>> starters;
    for (std::size_t i = 0; i < entrants_.size(); ++i) {
      const std::size_t entrant = (round + i) % entrants_.size();
      starters.emplace_back(entrant, entrants_[entrant].make());
      starters.back().second->build(world_);
    }
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      for (const Question question : all_questions) {
        for (const auto& [entrant, contender] : starters) {
          const double time = time_of(*contender, entrants_[entrant], samples_[i], question);
          rows_[i].results[entrant].nanoseconds[static_cast<std::size_t>(question)].push_back(time);
        }
      }
    }
  }

  void judge() {
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const PathBatch& paths = samples_[i].in_world.paths;
      const std::vector<std::uint8_t> exact = exact_world_answers(world_, paths.segments());
      rows_[i].judged = exact.size();
      if (exact.empty()) continue;
      const auto hits = static_cast<double>(std::count(exact.begin(), exact.end(), 1));
      rows_[i].hit_share = hits / static_cast<double>(exact.size());
      for (std::size_t entrant = 0; entrant < entrants_.size(); ++entrant) {
        const auto contender = entrants_[entrant].make();
        contender->build(world_);
        std::vector<std::uint8_t> blocked(paths.size());
        contender->any(paths_for(entrants_[entrant], samples_[i]), blocked);
        for (std::size_t j = 0; j < exact.size(); ++j)
          rows_[i].results[entrant].wrong += exact[j] == blocked[j] ? 0 : 1;
      }
    }
  }

  [[nodiscard]] const std::vector<WorldRow>& rows() const { return rows_; }

 private:
  static bool is_in_mesh(const WorldEntrant& entrant) { return entrant.library == collider_library; }
  static bool is_peer(const WorldEntrant& entrant) { return !entrant.is_ours() && !is_in_mesh(entrant); }

  static const PathBatch& paths_for(const WorldEntrant& entrant, const FramedSample& sample) {
    return is_in_mesh(entrant) ? *sample.paths_in_mesh : sample.in_world.paths;
  }

  /// As in the other tables, it answers other paths first.
  static double time_of(WorldContender& contender, const WorldEntrant& entrant, const FramedSample& sample,
                        Question question) {
    const PathBatch& paths = paths_for(entrant, sample);
    const PathBatch& warm_up = is_in_mesh(entrant) ? *sample.warm_up_in_mesh : sample.in_world.warm_up;
    const auto answer = [&](const PathBatch& asked, Answers& answers) {
      if (question == Question::closest_hit) {
        contender.first(asked, answers.hits);
      } else {
        contender.any(asked, answers.blocked);
      }
    };
    Answers uncounted(warm_up.size());
    Answers answers(paths.size());
    answer(warm_up, uncounted);
    return nanoseconds_of([&] { answer(paths, answers); }) / static_cast<double>(paths.size());
  }

  const World& world_;
  std::vector<WorldEntrant> entrants_;
  std::vector<FramedSample> samples_;
  std::vector<WorldRow> rows_;
};

/// What changes before a commit.
struct Change {
  std::string name;
  std::function<void(WorldContender&, std::span<const Posef>)> make;  ///< makes the change, and commits
};

/// The first one is the published one.
const std::vector<Change>& all_changes() {
  static const std::vector<Change> changes = {
      {"commit", [](WorldContender& contender, std::span<const Posef> poses) { contender.move(poses); }},
      {"commit of a tenth",
       [](WorldContender& contender, std::span<const Posef> poses) { contender.move(poses.first(poses.size() / 10)); }},
      {"exchange", [](WorldContender& contender, std::span<const Posef>) { contender.exchange_one(); }},
  };
  return changes;
}

/// What a contender takes for each change.
struct CommitResult {
  std::string name;
  std::vector<RoundSeries> nanoseconds;  ///< in the order of the changes
};

struct CommitRow {
  Place place;
  std::size_t instances;
  std::vector<CommitResult> results;  ///< ours first
};

CommitRow race_commits(const World& world, const Request& request) {
  const std::array poses = {moved_poses(world, 1), moved_poses(world, 2)};
  CommitRow row{{"scene", world.name, world.triangle_count()}, world.instances.size(), {}};
  std::vector<std::unique_ptr<WorldContender>> contenders;
  for (const WorldEntrant& entrant : request.world_entrants) {
    if (entrant.name() != "surehit batch" && entrant.name() != moving_peer) continue;
    row.results.push_back(
        {entrant.is_ours() ? "surehit" : entrant.library, std::vector<RoundSeries>(all_changes().size())});
    contenders.push_back(entrant.make());
    contenders.back()->build(world);
  }
  for (std::size_t change = 0; change < all_changes().size(); ++change) {
    for (std::size_t round = 0; round <= commit_rounds * request.rounds; ++round) {
      for (std::size_t i = 0; i < contenders.size(); ++i) {
        const double time = nanoseconds_of([&] { all_changes()[change].make(*contenders[i], poses[round % 2]); });
        if (round > 0) row.results[i].nanoseconds[change].push_back(time);
      }
    }
  }
  return row;
}

void keep_world(const WorldRow& row, Report& report) {
  Place place = row.place;
  for (const Question question : all_questions) {
    place.question = name_of(question);
    for (const WorldResult& result : row.results) {
      report.keep(place, result.name, "ns per path", summary_of(result.of(question)));
      for (const WorldResult& ours : row.results) {
        if (result.is_ours || !ours.is_ours) continue;
        report.keep(place, result.name, "over " + ours.name, summary_of(ratio(result.of(question), ours.of(question))));
      }
    }
  }
  for (const WorldResult& result : row.results) {
    report.keep(place, result.name, "wrong decisions", summary_of(static_cast<double>(result.wrong)));
  }
}

void show_world_ratios(const std::vector<WorldRow>& rows, Question question, const std::string& our_name,
                       const Report& report) {
  std::vector<std::string> header = {"scene", "paths", our_name + " ns"};
  for (const WorldResult& result : rows.front().results) {
    if (result.is_peer) header.push_back(result.name);
  }
  MarkdownTable table(header, 2);
  for (const WorldRow& row : rows) {
    const RoundSeries& ours = row.result_of(our_name).of(question);
    std::vector<std::string> cells = {row.place.mesh, row.place.paths, short_number(summary_of(ours).median)};
    for (const WorldResult& result : row.results) {
      if (result.is_peer) cells.push_back(short_number(summary_of(ratio(result.of(question), ours)).median));
    }
    table.add_row(std::move(cells));
  }
  report.show("scene: " + name_of(question) + ": " + our_name + ", and how many times as long the others take", table);
}

void show_wrong_in_worlds(const std::vector<WorldRow>& rows, const Report& report) {
  std::vector<std::string> header = {"scene", "paths", "judged", "hits"};
  for (const WorldResult& result : rows.front().results) {
    if (result.is_ours || result.is_peer) header.push_back(result.name);
  }
  MarkdownTable table(header, 2);
  for (const WorldRow& row : rows) {
    std::vector<std::string> cells = {row.place.mesh, row.place.paths, std::to_string(row.judged),
                                      short_number(100 * row.hit_share) + "%"};
    for (const WorldResult& result : row.results) {
      if (result.is_ours || result.is_peer) cells.push_back(std::to_string(result.wrong));
    }
    table.add_row(std::move(cells));
  }
  report.show("scene: any hit: wrong decisions, as judged by CGAL's exact kernel", table);
}

/// The times of an instance over those of its collider.
void show_instances_over_colliders(const std::vector<WorldRow>& rows, const Report& report) {
  std::vector<std::string> header = {"scene", "paths"};
  std::vector<std::pair<Question, std::string>> columns;
  for (const Question question : all_questions) {
    for (const char* way : {"batch", "single"}) {
      columns.emplace_back(question, way);
      header.push_back(name_of(question) + ", " + way);
    }
  }
  MarkdownTable table(header, 2);
  bool has_rows = false;
  for (const WorldRow& row : rows) {
    if (row.results.back().is_ours || row.results.back().is_peer) continue;
    std::vector<std::string> cells = {row.place.mesh, row.place.paths};
    for (const auto& [question, way] : columns) {
      const RoundSeries& in_scene = row.result_of("surehit " + way).of(question);
      const RoundSeries& alone = row.result_of(std::string(collider_library) + ' ' + way).of(question);
      cells.push_back(short_number(summary_of(ratio(in_scene, alone)).median));
    }
    table.add_row(std::move(cells));
    has_rows = true;
  }
  if (has_rows) report.show("scene: how many times as long an instance takes as its collider", table);
}

void show_commits(const std::vector<CommitRow>& rows, Report& report) {
  std::vector<std::string> header = {"scene", "instances"};
  for (const char* change : {"all move", "a tenth moves", "one goes and one comes"}) {
    header.push_back(std::string(change) + ": surehit ms");
    for (const CommitResult& result : rows.front().results) {
      if (&result != &rows.front().results.front()) header.push_back(result.name);
    }
  }
  MarkdownTable table(header, 1);
  for (const CommitRow& row : rows) {
    const CommitResult& ours = row.results.front();
    std::vector<std::string> cells = {row.place.mesh, std::to_string(row.instances)};
    for (std::size_t change = 0; change < all_changes().size(); ++change) {
      const std::string& name = all_changes()[change].name;
      cells.push_back(short_number(summary_of(ours.nanoseconds[change]).median / 1e6));
      for (const CommitResult& result : row.results) {
        report.keep(row.place, result.name, name + " ns", summary_of(result.nanoseconds[change]));
        if (&result == &ours) continue;
        const Summary over_ours = summary_of(ratio(result.nanoseconds[change], ours.nanoseconds[change]));
        report.keep(row.place, result.name, name + " over surehit", over_ours);
        cells.push_back(short_number(over_ours.median));
      }
    }
    table.add_row(std::move(cells));
  }
  report.show("scene: commits after changes, and how many times as long the others take", table);
}

}  // namespace

void measure_worlds(const Request& request, Report& report) {
  std::vector<WorldRow> rows;
  std::vector<CommitRow> commits;
  example::ProgressBar bar("scene", request.worlds.size() * request.rounds);
  std::size_t rounds = 0;
  for (const std::string& name : request.worlds) {
    const World world = build_world(name, request.detail);
    WorldContest contest(world, request);
    for (std::size_t round = 0; round < request.rounds; ++round) {
      contest.run_round(round);
      bar.show(++rounds);
    }
    contest.judge();
    rows.insert(rows.end(), contest.rows().begin(), contest.rows().end());
    if (world.instances.size() > 1) commits.push_back(race_commits(world, request));
  }
  bar.hide();
  for (const WorldRow& row : rows) keep_world(row, report);
  if (!rows.empty()) {
    for (const Question question : all_questions) {
      for (const char* our_name : {"surehit batch", "surehit single"}) {
        show_world_ratios(rows, question, our_name, report);
      }
    }
    show_wrong_in_worlds(rows, report);
    show_instances_over_colliders(rows, report);
  }
  if (!commits.empty()) show_commits(commits, report);
}

}  // namespace surehit::benchmark
