#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "filter/kernel_path.hpp"
#include "walk/grid_traversal.hpp"

namespace surehit::test {

/// A lane after `detail::FarLanes::clip`.
struct FarLane {
  bool is_near;  ///< The other members are not set.
  bool is_inside, is_apart, is_free, is_end;
  double moved_t;
  float enters_rest;
  std::array<float, 3> start, rate, inverse_rate, finest;
  float enters, end;
  std::uint32_t octant;
  detail::KernelPath<float> kernel;
  float reach_from_start;
};

/// A path and the part of it that counts.
struct RangedFloats {
  Path<float> path;
  float first_t, last_t;
};

/// Clips paths of one kind there, as many at a time as there are lanes. Returns nothing where there are no lanes.
[[nodiscard]] std::vector<FarLane> clip_from_afar(const GridFrame& frame, std::span<const RangedFloats> paths);

}  // namespace surehit::test
