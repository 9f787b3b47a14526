#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "report.hpp"
#include "round_series.hpp"
#include "sweep_entrants.hpp"

namespace surehit::benchmark {

/// A contender of a contest of moving shapes.
struct SweepContestant {
  std::string name;
  bool is_ours;                                           ///< The others are peers.
  bool moves_segments;                                    ///< The segments of the paths alone, and no shapes.
  std::size_t max_sweeps;                                 ///< As many as it is asked.
  std::function<std::unique_ptr<SweepAnswerer>()> build;  ///< From nothing.
};

/// Returns an entrant as a contestant among these surroundings, which must outlive it.
template <typename Surroundings>
[[nodiscard]] SweepContestant contestant_of(const SweepEntrantIn<Surroundings>& entrant,
                                            const Surroundings& surroundings) {
  const auto build = [make = entrant.make, &surroundings] {
    auto contender = make();
    contender->build(surroundings);
    return contender;
  };
  return {entrant.name(), entrant.is_ours(), entrant.way.starts_with("segment"), entrant.max_sweeps, build};
}

/// Sweeps to measure with, and others of the same set to warm up with.
struct SweepSample {
  SweepSample(ShapeKind kind, float size, const PathBatch& measured, const PathBatch& others)
      : sweeps(kind, size, measured), warm_up(kind, size, others) {}

  SweepBatch sweeps;
  SweepBatch warm_up;
};

/// What was measured of a contestant on one sample.
struct SweepResult {
  std::string name;
  bool is_ours;
  bool moves_segments;
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

  /// Returns null if no contestant has this name.
  [[nodiscard]] const SweepResult* find(const std::string& name) const;
  /// One contestant must have this name.
  [[nodiscard]] const SweepResult& result_of(const std::string& name) const { return *find(name); }
  /// Returns the median of how many times as long one contestant takes as another one, to be shown.
  [[nodiscard]] std::string ratio_of(const std::string& name, const std::string& other) const;
};

/// Contestants that answer the same sweeps, in turns.
class SweepContest {
 public:
  static constexpr const char* segments = "surehit segment batch";
  static constexpr const char* batch = "surehit batch";
  static constexpr const char* single = "surehit single";

  /// Batches of shapes must take part.
  explicit SweepContest(std::vector<SweepContestant> contestants) : contestants_(std::move(contestants)) {}

  /// `moved` are the same sweeps moved a bit, if they are close ones.
  void add(const Place& place, SweepSample sample, std::optional<SweepSample> moved = {});

  /// Everybody builds, and answers all sets. Another one begins each time.
  void run_round(std::size_t round);

  /// Compares decisions with those of surehit's batches. Shapes that begin with a contact are left out: Bullet does not
  /// mean to report these. Throws if others of ours differ in a bit.
  void judge();

  [[nodiscard]] const std::vector<SweepRow>& rows() const { return rows_; }

 private:
  std::vector<SweepContestant> contestants_;
  std::vector<SweepSample> samples_;
  std::vector<std::optional<SweepSample>> moved_;
  std::vector<SweepRow> rows_;
};

/// Returns the size in float with few binary digits. So heights above planes are exact where coordinates have few of
/// them too.
[[nodiscard]] float short_size(double size);

/// Returns a percentage as it is shown.
[[nodiscard]] std::string text_of_percent(double percent);

/// Keeps all figures of a row, and ratios over all of ours.
void keep_sweeps(const SweepRow& row, Report& report);

/// Returns a table of the decisions of peers that are wrong. The first column has the name that is given.
[[nodiscard]] MarkdownTable wrong_sweeps(const std::string& where, const std::vector<SweepRow>& rows);

}  // namespace surehit::benchmark
