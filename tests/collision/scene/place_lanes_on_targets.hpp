#pragma once

#include <span>

#include "scene/instance_frame.hpp"
#include "scene/placed_lanes.hpp"
#include "scene/placed_path.hpp"

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

}  // namespace surehit::test
