#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "walk/grid_traversal.hpp"

namespace surehit::test {

/// A lane after `detail::LaneClip::clip_in_double`.
struct ClippedLane {
  bool is_inside;
  bool is_apart;
  double enters;
  std::array<float, 3> start, rate, inverse_rate, finest, pitch;
  float first_cell, float_enters, end;
  std::uint32_t octant;
};

/// A path and the part of it that counts.
struct RangedPath {
  Path<double> path;
  double first_t, last_t;
};

/// Clips paths of one kind there, as many at a time as there are lanes. Returns nothing where there are no lanes.
[[nodiscard]] std::vector<ClippedLane> clip_in_double(const Grid& grid, std::span<const RangedPath> paths);

}  // namespace surehit::test
