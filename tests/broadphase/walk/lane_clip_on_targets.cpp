#include "lane_clip_on_targets.hpp"

// Compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "broadphase/walk/lane_clip_on_targets.cpp"
#include <hwy/foreach_target.h>
// Behind foreach_target.h.
#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#if HWY_TARGET != HWY_SCALAR
#include "walk/lane_clip-inl.hpp"
#endif

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR
std::vector<test::ClippedLane> clip_in_double(const Grid&, std::span<const test::RangedPath>) { return {}; }
#else
std::vector<test::ClippedLane> clip_in_double(const Grid& grid, std::span<const test::RangedPath> paths) {
  const LaneClip lane_clip(grid.frame());
  std::vector<test::ClippedLane> clips;
  for (std::size_t first = 0; first < paths.size(); first += hn::Lanes(FloatTag())) {
    const std::size_t count = std::min(hn::Lanes(FloatTag()), paths.size() - first);
    // Every other path alone, and then the others. What is in the other lanes must stay.
    constexpr std::uint32_t every_other = 0x55555555U;
    const auto all = static_cast<std::uint32_t>((std::uint64_t{1} << count) - 1);
    WalkingPaths walking = {};
    std::array<double, max_lanes> enters = {};
    std::array<double, max_lanes> kept = {};
    LaneClip::Clipped clipped = {0, 0};
    for (const std::uint32_t lanes : {all & every_other, all & ~every_other}) {
      LaneClip::DoublePaths in_lanes = {};
      for (std::size_t lane = 0; lane < count; ++lane) {
        if ((lanes >> lane & 1) == 0) continue;
        const auto& [path, first_t, last_t] = paths[first + lane];
        for (std::size_t axis = 0; axis < 3; ++axis) {
          in_lanes.start[axis][lane] = path.start[static_cast<Eigen::Index>(axis)];
          in_lanes.toward[axis][lane] = path.toward[static_cast<Eigen::Index>(axis)];
        }
        in_lanes.first_t[lane] = first_t;
        in_lanes.last_t[lane] = last_t;
      }
      const auto some = lane_clip.clip_in_double(in_lanes, paths[first].path.kind, lanes, walking, enters);
      clipped.inside |= some.inside;
      clipped.apart |= some.apart;
      for (std::size_t lane = 0; lane < count; ++lane) {
        if ((lanes >> lane & 1) != 0) kept[lane] = enters[lane];
      }
    }
    for (std::size_t lane = 0; lane < count; ++lane) {
      test::ClippedLane clip;
      clip.is_inside = (clipped.inside >> lane & 1) != 0;
      clip.is_apart = (clipped.apart >> lane & 1) != 0;
      clip.enters = kept[lane];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        clip.start[axis] = walking.start[axis][lane];
        clip.rate[axis] = walking.rate[axis][lane];
        clip.inverse_rate[axis] = walking.inverse_rate[axis][lane];
        clip.finest[axis] = walking.finest[axis][lane];
        clip.pitch[axis] = walking.pitch[axis][lane];
      }
      clip.first_cell = walking.first_cell[lane];
      clip.float_enters = walking.enters[lane];
      clip.end = walking.end[lane];
      clip.octant = walking.octant[lane];
      clips.push_back(clip);
    }
  }
  return clips;
}
#endif

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace surehit::detail {

HWY_EXPORT(clip_in_double);

}  // namespace surehit::detail

namespace surehit::test {

using namespace detail;

std::vector<ClippedLane> clip_in_double(const Grid& grid, std::span<const RangedPath> paths) {
  return HWY_DYNAMIC_DISPATCH(clip_in_double)(grid, paths);
}

}  // namespace surehit::test
#endif
