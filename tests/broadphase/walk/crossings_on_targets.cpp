#include "crossings_on_targets.hpp"

// Compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "broadphase/walk/crossings_on_targets.cpp"
#include <hwy/foreach_target.h>
// Behind foreach_target.h.
#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#if HWY_TARGET != HWY_SCALAR
#include "walk/lane_walk-inl.hpp"
#endif

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR
bool can_enter_crossings() { return false; }
std::vector<std::array<float, 3>> cells_of(const Grid&, const ClippedPath&, float) { return {}; }
#else
bool can_enter_crossings() { return LaneWalk::can_enter_crossings; }

std::vector<std::array<float, 3>> cells_of(const Grid& grid, const ClippedPath& path, float enters) {
  const LaneWalk walk(grid, nullptr);
  const LaneWalk::Crossings crossings(path, enters);
  WalkingPaths paths;
  walk.begin_crossings(path, paths);
  const std::size_t lanes = hn::Lanes(FloatTag());
  std::vector<std::array<float, 3>> cells;
  for (float from = 0; from <= crossings.last; from += static_cast<float>(lanes)) {
    const std::uint32_t standing = walk.enter_crossings(crossings, from, paths);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      if ((standing >> lane & 1) == 0) continue;
      cells.push_back({paths.finest[0][lane], paths.finest[1][lane], paths.finest[2][lane]});
    }
  }
  return cells;
}
#endif

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace surehit::detail {

HWY_EXPORT(can_enter_crossings);
HWY_EXPORT(cells_of);

}  // namespace surehit::detail

namespace surehit::test {

using namespace detail;

bool can_enter_crossings() { return HWY_DYNAMIC_DISPATCH(can_enter_crossings)(); }

std::vector<std::array<float, 3>> cells_of(const Grid& grid, const ClippedPath& path, float enters) {
  return HWY_DYNAMIC_DISPATCH(cells_of)(grid, path, enters);
}

}  // namespace surehit::test
#endif
