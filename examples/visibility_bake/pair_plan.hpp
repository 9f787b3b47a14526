#pragma once

#include <cstdint>
#include <surehit/collider.hpp>
#include <vector>

namespace surehit::example {

struct PairOptions {
  float range = 20;           ///< Cells that are farther apart are not asked about.
  std::uint32_t samples = 8;  ///< segments for each pair of cells
  float cell_width = 1;       ///< Eyes are up to half of this away from the middle of a cell, along x and y.
  float eye_height = 1.6f;  ///< Eyes are between a quarter of this and this above the floor, or lower below a ceiling.
};

/// Which pairs of cells are asked about, and by which segments. It is a function of the cells and the options.
class PairPlan {
 public:
  static constexpr std::uint32_t eyes_of_a_cell = 16;
  static constexpr std::uint32_t max_samples = 255;  ///< A byte counts those of a pair.

  /// `floors` has the middle of each cell's floor. The middle eye is lowered if something is in the way from the floor
  /// up to it. Another eye that the middle one does not see, as it is behind a wall, is moved to the middle.
  PairPlan(const Colliderf& collider, std::vector<Vector3f> floors, const PairOptions& options);

  [[nodiscard]] std::uint32_t cell_count() const { return static_cast<std::uint32_t>(floors_.size()); }
  [[nodiscard]] const std::vector<Vector3f>& floors() const { return floors_; }
  [[nodiscard]] const PairOptions& options() const { return options_; }
  /// The eye of a cell with a number below `eyes_of_a_cell`. Eye 0 is in the middle.
  [[nodiscard]] const Vector3f& eye(std::uint32_t cell, std::uint32_t number) const {
    return eyes_[std::size_t{cell} * eyes_of_a_cell + number];
  }

  /// The partners that are asked about in the row of a cell, in ascending order. Each pair in range is in one of its
  /// two rows, so that rows are about as long as each other.
  [[nodiscard]] std::vector<std::uint32_t> partners(std::uint32_t cell) const;
  /// Segment `sample` of a pair.
  [[nodiscard]] Segmentf segment(std::uint32_t cell, std::uint32_t partner, std::uint32_t sample) const;
  /// A number that tells plans of other cells, options and meshes apart.
  [[nodiscard]] std::uint64_t fingerprint(const Colliderf& collider) const;

 private:
  std::vector<Vector3f> floors_;
  PairOptions options_;
  std::vector<std::uint32_t> by_y_;  ///< all cells
  std::vector<Vector3f> eyes_;
};

}  // namespace surehit::example
