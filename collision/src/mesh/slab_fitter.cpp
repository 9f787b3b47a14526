#include "mesh/slab_fitter.hpp"

#include "support/rounding_flags.hpp"

// This file is compiled once for each instruction set. The best one is chosen when the first slab is fitted.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "mesh/slab_fitter.cpp"
#include <hwy/foreach_target.h>
// This one must come after foreach_target.h.
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Fits a slab to a list.
///
/// Let eps = 2^-24, and let n be the slab's normal. Let R be the sum of |n| times the grid's resolution over the axes.
/// A height is a corner's position along n, counted from the cell's centre.
///
/// F1. A computed height is off by at most 10 eps R.
/// Proof. Each rounding below is at most eps R, because no corner and no cell is outside the grid:
///
///     difference of the corner and `low`          1;
///     weight                                      1;
///     their product                               1;
///     sums over three axes                        3;
///     height of the low end of the mesh's box     4.
///
/// F2. The slab contains its triangles, with half a padding to spare on each side.
/// Proof. F1 gives 10 eps R. The slack, and its sum with the height, add 2 eps R.
///     A position is at most 128 steps from the centre, and two roundings turn a height into steps.
///     So they are off by 256 eps steps, which are 48 eps edges of the cell. One component of n is 15, and no cell is
///     wider than the grid. So 48 eps edges are below 4 eps R. All errors together are at most 16 eps R.
///     A padding is 32 eps R, and the slab is wider than its triangles by a padding on each side. Positions beyond
///     128 steps may be wrong, but the last steps of a slab hold all beyond them (`CellSlab`).
CellSlab fit_floats(const SlabFitter& fitter, const ListCell& cell, const float* corners, std::size_t count) {
  const hn::CappedTag<float, 8> d;
  using V = hn::Vec<decltype(d)>;
  const auto load = [&](std::size_t coordinate, std::size_t from) {
    return hn::LoadU(d, corners + (coordinate * count + from));
  };

  // This is the sum of the triangles' normals. All are turned to the side of the first one.
  V sum[3] = {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  V first[3];
  for (std::size_t from = 0; from < count; from += hn::Lanes(d)) {
    V e[3];  // Edges are in units of finest cells, so that their products do not overflow.
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
    slack += std::fabs(component) * axis.slack;  // F2
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
