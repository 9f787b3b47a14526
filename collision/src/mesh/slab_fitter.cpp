#include "mesh/slab_fitter.hpp"

// Compiled once for each instruction set; the best one is chosen when the first slab is fitted.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "mesh/slab_fitter.cpp"
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

// With u = 2^-24 and R the resolution on an axis, R taken times |n| and summed over the axes, a corner's height along
// the normal n, counted from the cell's centre, is off by 10 u R: for the difference, the weight, their product, the
// three sums, and four for that of the low end of the mesh. The slack and the sum with that make 2 u R more. Counted in
// steps, what is not beyond the last one is off by 2 u of 128 steps, which is 48 u edges of the cell: less than 4 u R,
// since the longest component is 15 and a cell no wider than the grid. In all that is 16 u R, and a slab is wider by a
// padding, 32 u R, on either side.
CellSlab fit_floats(const SlabFitter& fitter, const ListCell& cell, const float* corners, std::size_t count) {
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
    V side = hn::Zero(d);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3;
      const std::size_t m = (k + 2) % 3;
      normal[k] = hn::MulSub(e[l], f[m], hn::Mul(e[m], f[l]));
      if (from == 0) first[k] = hn::Set(d, hn::GetLane(normal[k]));
      side = hn::MulAdd(normal[k], first[k], side);
    }
    const auto is_turned = hn::Lt(side, hn::Zero(d));
    const auto taken = hn::FirstN(d, count - from);
    for (std::size_t k = 0; k < 3; ++k) {
      const V turned = hn::IfThenElse(is_turned, hn::Neg(normal[k]), normal[k]);
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
  V weight[3];
  V low_end[3];
  float of_low_end = 0;
  float slack = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const SlabFitter::Axis& axis = fitter.axes[k];
    components[k] = static_cast<std::int32_t>(std::floor(along[k] * share + 0.5F));
    const auto component = static_cast<float>(components[k]);
    const float centre = static_cast<float>(cell.low[k]) + static_cast<float>(cell.size) / 2;
    weight[k] = hn::Set(d, component * axis.scale);
    low_end[k] = hn::Set(d, axis.low);
    of_low_end += component * (axis.margin - centre);
    slack += std::fabs(component) * axis.slack;
  }
  V lowest = hn::Set(d, infinity);
  V highest = hn::Set(d, -infinity);
  for (std::size_t from = 0; from < count; from += hn::Lanes(d)) {
    V low = hn::Set(d, infinity);
    V high = hn::Set(d, -infinity);
    for (std::size_t corner = 0; corner < 3; ++corner) {
      V height = hn::Set(d, of_low_end);
      for (std::size_t k = 0; k < 3; ++k) {
        height = hn::MulAdd(hn::Sub(load(3 * corner + k, from), low_end[k]), weight[k], height);
      }
      low = hn::Min(low, height);
      high = hn::Max(high, height);
    }
    const auto taken = hn::FirstN(d, count - from);
    lowest = hn::IfThenElse(taken, hn::Min(lowest, low), lowest);
    highest = hn::IfThenElse(taken, hn::Max(highest, high), highest);
  }
  const float steps = 1 / (CellSlab::step * static_cast<float>(cell.size));
  const auto in_range = [](float step) {
    return static_cast<std::int32_t>(
        std::clamp(step, static_cast<float>(CellSlab::lowest), static_cast<float>(CellSlab::highest)));
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
    axes[k] = {frame.float_low[k], frame.float_scale[k], frame.float_margin[k], frame.padding(k)};
  }
}

CellSlab SlabFitter::fit(const ListCell& cell, const float* corners, std::size_t count) const {
  return HWY_DYNAMIC_DISPATCH(fit_floats)(*this, cell, corners, count);
}

}  // namespace surehit::detail
#endif
