#include "far_lanes_on_targets.hpp"

// Compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "broadphase/walk/far_lanes_on_targets.cpp"
#include <hwy/foreach_target.h>
// Behind foreach_target.h.
#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <limits>

#if HWY_TARGET != HWY_SCALAR
#include "filter/kernel_lanes-inl.hpp"
#include "walk/far_lanes-inl.hpp"
#include "walk/lane_clip-inl.hpp"
#endif

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR
std::vector<test::FarLane> clip_from_afar(const GridFrame&, std::span<const test::RangedFloats>) { return {}; }
#else
std::vector<test::FarLane> clip_from_afar(const GridFrame& frame, std::span<const test::RangedFloats> paths) {
  const LaneClip near(frame);
  std::vector<test::FarLane> all;
  for (std::size_t begin = 0; begin < paths.size(); begin += hn::Lanes(FloatTag())) {
    const std::size_t count = std::min(hn::Lanes(FloatTag()), paths.size() - begin);
    std::array<float, 6 * max_lanes> numbers = {};
    constexpr float infinity = std::numeric_limits<float>::infinity();
    alignas(max_lanes * sizeof(float)) LaneFloats firsts;
    alignas(max_lanes * sizeof(float)) LaneFloats lasts;
    firsts.fill(infinity);
    lasts.fill(-infinity);
    for (std::size_t lane = 0; lane < count; ++lane) {
      const auto& [path, first_t, last_t] = paths[begin + lane];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        numbers[6 * lane + axis] = path.start[static_cast<Eigen::Index>(axis)];
        numbers[6 * lane + 3 + axis] = path.toward[static_cast<Eigen::Index>(axis)];
      }
      firsts[lane] = first_t;
      lasts[lane] = last_t;
    }
    const bool is_segment = paths[begin].path.kind == PathKind::segment;
    const Floats first_t = hn::Load(FloatTag(), firsts.data());
    const Floats last_t = hn::Load(FloatTag(), lasts.data());
    WalkingPaths walking = {};
    KernelLanes kernel = {};
    const auto in_float = near.clip(numbers.data(), is_segment, first_t, last_t, count, walking, kernel);
    FarLanes far;
    const auto clipped = far.clip<LaneClip::Clipped>(frame, PathLanes(numbers.data(), is_segment, first_t, last_t),
                                                     in_float.apart, walking, kernel);
    for (std::size_t lane = 0; lane < count; ++lane) {
      const auto has = [&](std::uint32_t lanes) { return (lanes >> lane & 1) != 0; };
      test::FarLane one = {};
      one.is_near = !has(in_float.apart);
      one.is_inside = has(clipped.inside);
      one.is_apart = has(clipped.apart);
      one.is_free = has(far.free);
      one.is_end = has(far.ends);
      one.moved_t = far.moved_t[lane];
      one.enters_rest = far.enters_rest[lane];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        one.start[axis] = walking.start[axis][lane];
        one.rate[axis] = walking.rate[axis][lane];
        one.inverse_rate[axis] = walking.inverse_rate[axis][lane];
        one.finest[axis] = walking.finest[axis][lane];
      }
      one.enters = walking.enters[lane];
      one.end = walking.end[lane];
      one.octant = walking.octant[lane];
      kernel.copy(lane, one.kernel);
      one.reach_from_start = kernel.reach_from_start(lane);
      all.push_back(one);
    }
  }
  return all;
}
#endif

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace surehit::detail {

HWY_EXPORT(clip_from_afar);

}  // namespace surehit::detail

namespace surehit::test {

using namespace detail;

std::vector<FarLane> clip_from_afar(const GridFrame& frame, std::span<const RangedFloats> paths) {
  return HWY_DYNAMIC_DISPATCH(clip_from_afar)(frame, paths);
}

}  // namespace surehit::test
#endif
