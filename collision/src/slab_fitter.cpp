#include "slab_fitter.hpp"

// Compiled once for each instruction set; the best one is chosen when the first slab is fitted.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "slab_fitter.cpp"
#include <hwy/foreach_target.h>
// Behind foreach_target.h.
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// With u = 2^-24 and R the resolution on an axis, a corner's place, counted from the cell's centre, is off by 4 u R:
// for the difference, the product, the offset and the sum. Its height along the normal n, R taken times |n| and summed
// over the axes, is off by another 3 u R for the products and the two sums, and by 2 u R for the slack and the sum with
// that. Counted in steps, what is not beyond the last one is off by 2 u of 128 steps, which is 48 u edges of the cell:
// less than 4 u R, since the longest component is 15 and a cell no wider than the grid. In all that is 13 u R at most,
// and a slab is wider by half a padding, 16 u R, on either side.
CellSlab fit_floats(const SlabFitter& fitter, const ListCell& cell, const float* corners, std::size_t count) {
  // Most lists are short.
  const hn::CappedTag<float, 8> d;
  using V = hn::Vec<decltype(d)>;
  const auto load = [&](std::size_t coordinate, std::size_t from) {
    return hn::LoadU(d, corners + (coordinate * count + from));
  };

  // The sum of the triangles' normals, all turned to the side of the first one's.
  V sum[3] = {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  V first[3];
  for (std::size_t from = 0; from < count; from += hn::Lanes(d)) {
    V e[3];  // in finest cells, lest their products overflow
    V f[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const V scale = hn::Set(d, fitter.axes[k].scale);
      const V a = load(k, from);
      e[k] = hn::Mul(hn::Sub(load(3 + k, from), a), scale);
      f[k] = hn::Mul(hn::Sub(load(6 + k, from), a), scale);
    }
    V normal[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3;
      const std::size_t m = (k + 2) % 3;
      normal[k] = hn::MulSub(e[l], f[m], hn::Mul(e[m], f[l]));
      if (from == 0) first[k] = hn::Set(d, hn::GetLane(normal[k]));
    }
    const V along = hn::MulAdd(normal[0], first[0], hn::MulAdd(normal[1], first[1], hn::Mul(normal[2], first[2])));
    const auto taken = hn::FirstN(d, count - from);
    for (std::size_t k = 0; k < 3; ++k) {
      const V turned = hn::IfThenElse(hn::Lt(along, hn::Zero(d)), hn::Neg(normal[k]), normal[k]);
      sum[k] = hn::Add(sum[k], hn::IfThenElseZero(taken, turned));
    }
  }
  float along[3];
  float longest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    along[k] = hn::GetLane(hn::SumOfLanes(d, sum[k]));
    longest = std::max(longest, std::fabs(along[k]));
  }
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const float share = CellSlab::longest / longest;
  if (!(share < infinity)) return {};

  std::array<std::int32_t, 3> components;
  V normal[3];
  V scale[3];
  V low_end[3];
  V offset[3];
  float slack = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const SlabFitter::Axis& axis = fitter.axes[k];
    components[k] = static_cast<std::int32_t>(std::floor(along[k] * share + 0.5F));
    const auto component = static_cast<float>(components[k]);
    normal[k] = hn::Set(d, component);
    scale[k] = hn::Set(d, axis.scale);
    low_end[k] = hn::Set(d, axis.low);
    offset[k] = hn::Set(d, axis.margin - (static_cast<float>(cell.low[k]) + static_cast<float>(cell.size) / 2));
    slack += std::fabs(component) * axis.slack;
  }
  V lowest = hn::Set(d, infinity);
  V highest = hn::Set(d, -infinity);
  for (std::size_t from = 0; from < count; from += hn::Lanes(d)) {
    V low = hn::Set(d, infinity);
    V high = hn::Set(d, -infinity);
    for (std::size_t corner = 0; corner < 3; ++corner) {
      V height = hn::Zero(d);
      for (std::size_t k = 0; k < 3; ++k) {
        const V place = hn::MulAdd(hn::Sub(load(3 * corner + k, from), low_end[k]), scale[k], offset[k]);
        height = hn::MulAdd(place, normal[k], height);
      }
      low = hn::Min(low, height);
      high = hn::Max(high, height);
    }
    const auto taken = hn::FirstN(d, count - from);
    lowest = hn::IfThenElse(taken, hn::Min(lowest, low), lowest);
    highest = hn::IfThenElse(taken, hn::Max(highest, high), highest);
  }
  const float steps = 1 / (CellSlab::step * static_cast<float>(cell.size));
  const auto in_range = [](float place) {
    return static_cast<std::int32_t>(
        std::clamp(place, static_cast<float>(CellSlab::lowest), static_cast<float>(CellSlab::highest)));
  };
  const std::int32_t low = in_range(std::floor((hn::GetLane(hn::MinOfLanes(d, lowest)) - slack) * steps));
  const std::int32_t high = in_range(std::ceil((hn::GetLane(hn::MaxOfLanes(d, highest)) + slack) * steps) - 1);
  return CellSlab::between(components, low, high);
}

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace surehit::detail {

HWY_EXPORT(fit_floats);

SlabFitter::SlabFitter(const GridFrame& frame) {
  for (std::size_t k = 0; k < 3; ++k) {
    axes[k] = {frame.float_low[k], frame.float_scale[k], frame.float_margin[k], frame.padding(k) / 2};
  }
}

CellSlab SlabFitter::fit(const ListCell& cell, const float* corners, std::size_t count) const {
  return HWY_DYNAMIC_DISPATCH(fit_floats)(*this, cell, corners, count);
}

}  // namespace surehit::detail
#endif
