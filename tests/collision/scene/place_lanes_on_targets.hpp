#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "filter/kernel_path.hpp"
#include "grid/grid_frame.hpp"
#include "scene/instance_frame.hpp"
#include "scene/placed_lanes.hpp"
#include "scene/placed_path.hpp"
#include "surehit/triangle.hpp"

namespace surehit::test {

/// A pair for one lane of `detail::PlaceLanes`.
template <typename Scalar>
struct PairToPlace {
  const detail::ScenePath<Scalar>* path;
  const detail::InstanceFrame* frame;
};

/// `detail::PlaceLanes` on the instruction set that is chosen at the moment, with up to eight pairs.
template <typename Scalar>
void place_side_by_side(std::span<const PairToPlace<Scalar>> pairs, bool has_end, detail::PlacedLanes& placed);

/// The segments that `place_segments` has placed.
struct PlacedSegmentLanes {
  detail::PlacedLanes placed;
  std::array<detail::KernelPath<float>, 4> kernel_paths;
  std::uint32_t usable;   ///< Those for which the kernel can be asked.
  std::uint32_t precise;  ///< Those that may walk through the frame of the grid.
};

/// `detail::SegmentPlacer` and what follows it, on the same instruction set, for four segments of six floats. Returns
/// false if the instruction set has no lanes.
bool place_segments(const detail::InstanceFrame& frame, const GridFrame& grid, const std::array<float, 24>& segments,
                    PlacedSegmentLanes& lanes);

/// What `detail::PlacedHits` says of a hit.
struct PlacedHit {
  float t, u, v;
  bool is_rounded, is_positive;
};

/// `detail::PlacedHits` there, with as many hits at a time as a vector of doubles has lanes.
void round_placed_hits(std::span<const detail::CertainPath> paths, std::span<const Triangle<double>> triangles,
                       std::span<PlacedHit> hits);

}  // namespace surehit::test
