#include "place_lanes_on_targets.hpp"

// This file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "collision/scene/place_lanes_on_targets.cpp"
#include <hwy/foreach_target.h>

#include <algorithm>

// This header must come after foreach_target.h.
#include "scene/place_lanes-inl.hpp"
#include "scene/placed_rounding-inl.hpp"
#if HWY_TARGET != HWY_SCALAR  // This target has no lanes.
#include "scene/path_placer-inl.hpp"
#endif

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

template <typename Scalar>
void place_pairs(std::span<const test::PairToPlace<Scalar>> pairs, bool has_end, PlacedLanes& placed) {
  PlaceLanes place;
  for (std::size_t lane = 0; lane < pairs.size(); ++lane) place.set(lane, *pairs[lane].path, *pairs[lane].frame);
  place.place(pairs.size(), has_end, placed);
}

void place_floats(std::span<const test::PairToPlace<float>> pairs, bool has_end, PlacedLanes& placed) {
  place_pairs(pairs, has_end, placed);
}
void place_doubles(std::span<const test::PairToPlace<double>> pairs, bool has_end, PlacedLanes& placed) {
  place_pairs(pairs, has_end, placed);
}

void round_hits_of_paths(std::span<const CertainPath> paths, std::span<const Triangle<double>> triangles,
                         std::span<test::PlacedHit> hits) {
  const hn::CappedTag<double, 8> d;
  for (std::size_t from = 0; from < paths.size(); from += hn::Lanes(d)) {
    const std::size_t count = std::min(hn::Lanes(d), paths.size() - from);
    PlacedHits<hn::CappedTag<double, 8>> placed;
    for (std::size_t lane = 0; lane < count; ++lane) placed.set(lane, paths[from + lane], triangles[from + lane]);
    const auto of = placed.round();
    for (std::size_t lane = 0; lane < count; ++lane) {
      hits[from + lane] = {of.t[lane], of.u[lane], of.v[lane], (of.rounded >> lane & 1) != 0,
                           (of.positive >> lane & 1) != 0};
    }
  }
}

#if HWY_TARGET != HWY_SCALAR
bool place_four(const InstanceFrame& frame, const GridFrame& grid, const std::array<float, 24>& segments,
                test::PlacedSegmentLanes& lanes) {
  std::array<float, 6 * max_lanes> readable = {};
  std::copy(segments.begin(), segments.end(), readable.begin());
  SegmentPlacer placer(frame);
  placer.place(readable.data(), 4);
  lanes.placed = placer.part(0);
  PlacedKernelPaths paths;
  lanes.usable = paths.set(lanes.placed, 0);
  lanes.precise = lanes_precise_in(grid, lanes.placed);
  KernelLanes in_lanes;
  paths.copy_to(in_lanes);
  for (std::size_t lane = 0; lane < 4; ++lane) in_lanes.copy(lane, lanes.kernel_paths[lane]);
  return true;
}
#else
bool place_four(const InstanceFrame&, const GridFrame&, const std::array<float, 24>&, test::PlacedSegmentLanes&) {
  return false;
}
#endif

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace surehit::detail {

HWY_EXPORT(place_floats);
HWY_EXPORT(place_doubles);
HWY_EXPORT(place_four);
HWY_EXPORT(round_hits_of_paths);

void chosen_place(std::span<const test::PairToPlace<float>> pairs, bool has_end, PlacedLanes& placed) {
  HWY_DYNAMIC_DISPATCH(place_floats)(pairs, has_end, placed);
}
void chosen_place(std::span<const test::PairToPlace<double>> pairs, bool has_end, PlacedLanes& placed) {
  HWY_DYNAMIC_DISPATCH(place_doubles)(pairs, has_end, placed);
}
bool chosen_place_four(const InstanceFrame& frame, const GridFrame& grid, const std::array<float, 24>& segments,
                       test::PlacedSegmentLanes& lanes) {
  return HWY_DYNAMIC_DISPATCH(place_four)(frame, grid, segments, lanes);
}
void chosen_round(std::span<const CertainPath> paths, std::span<const Triangle<double>> triangles,
                  std::span<test::PlacedHit> hits) {
  HWY_DYNAMIC_DISPATCH(round_hits_of_paths)(paths, triangles, hits);
}

}  // namespace surehit::detail

namespace surehit::test {

template <typename Scalar>
void place_side_by_side(std::span<const PairToPlace<Scalar>> pairs, bool has_end, detail::PlacedLanes& placed) {
  detail::chosen_place(pairs, has_end, placed);
}

template void place_side_by_side(std::span<const PairToPlace<float>>, bool, detail::PlacedLanes&);
template void place_side_by_side(std::span<const PairToPlace<double>>, bool, detail::PlacedLanes&);

bool place_segments(const detail::InstanceFrame& frame, const GridFrame& grid, const std::array<float, 24>& segments,
                    PlacedSegmentLanes& lanes) {
  return detail::chosen_place_four(frame, grid, segments, lanes);
}

void round_placed_hits(std::span<const detail::CertainPath> paths, std::span<const Triangle<double>> triangles,
                       std::span<PlacedHit> hits) {
  detail::chosen_round(paths, triangles, hits);
}

}  // namespace surehit::test
#endif
