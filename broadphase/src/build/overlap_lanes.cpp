#include "build/overlap_lanes.hpp"

#include "support/rounding_flags.hpp"

// This file is compiled once for each instruction set. The best one is chosen when the first grid is built.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "build/overlap_lanes.cpp"
#include <hwy/foreach_target.h>
// This header must come after foreach_target.h.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// The axes are those of `TriangleOverlap`. But everything is counted from the centre of the block's first cell. So the
// centres of the other cells are sums of steps. Steps are exact, because a size is a power of two.
//
// The roundings: eps is 2^-24, R is the resolution, and L is |l| + |m| for a shadow's axis (l, m). A corner is off by
// eps R once it is moved. The rest tests the triangle of the moved corners. Its ends on the axis are off by 2 eps R L.
// The half length of a box is off by 1.5, the difference of both by 1.5, and the sum of two steps by 1. In sum that is
// less than 8 eps R L, as in `TriangleOverlap`.
//
// The normal's components are off by less than 10 eps E^2, where E is the triangle's maximum extent. So the heights of
// the moved corners differ by less than 30 eps E^3. A height is three products of up to |normal| far, and three
// differences with steps. The reach is three products of up to |normal| (step / 2 + padding). Together they are off by
// less than 16 eps |normal| (far + step).
//
// No operation is fused where rounding matters, because not every instruction set can fuse. So a grid has the same
// bytes on all of them, and what one has saved another can check.
void find_in_lanes(const OverlapLanes& lanes, const CellPoint& padding, float size,
                   OverlapLanes::Row<std::int32_t>& overlaps) {
  const hn::CappedTag<float, OverlapLanes::count> d;
  const hn::RebindToSigned<decltype(d)> di;
  using V = hn::Vec<decltype(d)>;
  using M = hn::Mask<decltype(d)>;
  constexpr float eps = 0x1p-24F;
  const V step = hn::Set(d, size);

  for (std::size_t lane = 0; lane < OverlapLanes::count; lane += hn::Lanes(d)) {
    const auto load = [&](const OverlapLanes::Points& points, V(&axes)[3]) {
      V padding_lane;
      hn::LoadInterleaved4(d, reinterpret_cast<const float*>(&points[lane]), axes[0], axes[1], axes[2], padding_lane);
    };
    V corners[3][3];
    for (std::size_t i = 0; i < 3; ++i) load(lanes.corners[i], corners[i]);
    V first[3];
    load(lanes.low, first);
    V more[3];
    load(lanes.more, more);
    V half[3];
    M has_another[3];
    V extent = hn::Zero(d);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const V centre = hn::MulAdd(first[axis], step, hn::Set(d, size / 2));  // Exact.
      for (V(&corner)[3] : corners) corner[axis] = hn::Sub(corner[axis], centre);
      const V low = hn::Min(hn::Min(corners[0][axis], corners[1][axis]), corners[2][axis]);
      const V high = hn::Max(hn::Max(corners[0][axis], corners[1][axis]), corners[2][axis]);
      extent = hn::Max(extent, hn::Sub(high, low));
      half[axis] = hn::Set(d, size / 2 + padding[axis]);
      has_another[axis] = hn::Gt(more[axis], hn::Zero(d));
    }
    V edges[3][3];
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        edges[i][axis] = hn::Sub(corners[(i + 1) % 3][axis], corners[i][axis]);
      }
    }

    M shadowed[3][4];  // By axis k, and by the steps on k + 1 and k + 2.
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t on_l = (k + 1) % 3;
      const std::size_t on_m = (k + 2) % 3;
      for (std::size_t i = 0; i < 3; ++i) {
        const V l = edges[i][on_m];
        const V m = hn::Neg(edges[i][on_l]);
        const auto along = [&](const V(&corner)[3]) {
          return hn::Add(hn::Mul(corner[on_l], l), hn::Mul(corner[on_m], m));
        };
        const V a = along(corners[0]);
        const V b = along(corners[1]);
        const V c = along(corners[2]);
        const V half_shadow = hn::Add(hn::Mul(half[on_l], hn::Abs(l)), hn::Mul(half[on_m], hn::Abs(m)));
        const V low = hn::Sub(hn::Min(hn::Min(a, b), c), half_shadow);
        const V high = hn::Add(hn::Max(hn::Max(a, b), c), half_shadow);
        const V step_l = hn::Mul(step, l);
        const V step_m = hn::Mul(step, m);
        const V centres[4] = {hn::Zero(d), step_l, step_m, hn::Add(step_l, step_m)};
        for (std::size_t at = 0; at < 4; ++at) {
          const M meets = hn::And(hn::Le(low, centres[at]), hn::Ge(high, centres[at]));
          shadowed[k][at] = i == 0 ? meets : hn::And(shadowed[k][at], meets);
        }
      }
    }

    V height = hn::Zero(d);
    V reach = hn::Zero(d);
    V length = hn::Zero(d);
    V far = step;
    V rise[3];  // The height changes by this to the next cell on an axis.
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3;
      const std::size_t m = (k + 2) % 3;
      const V normal = hn::Sub(hn::Mul(edges[0][l], edges[1][m]), hn::Mul(edges[0][m], edges[1][l]));
      height = hn::Add(hn::Mul(normal, corners[0][k]), height);
      reach = hn::Add(hn::Mul(hn::Abs(normal), half[k]), reach);
      length = hn::Add(length, hn::Abs(normal));
      far = hn::Max(far, hn::Abs(corners[0][k]));
      rise[k] = hn::Mul(normal, step);
    }
    reach = hn::Add(hn::Mul(hn::Mul(hn::Set(d, 64 * eps), extent), hn::Mul(extent, extent)), reach);
    reach = hn::Add(hn::Mul(hn::Mul(hn::Set(d, 32 * eps), length), far), reach);

    auto bits = hn::Zero(di);
    for (std::size_t cell = 0; cell < OverlapLanes::cells_of_a_block; ++cell) {
      const bool beyond[3] = {(cell & 1) != 0, (cell & 2) != 0, (cell & 4) != 0};
      V above = height;
      M meets = shadowed[0][beyond[1] + 2 * beyond[2]];
      meets = hn::And(meets, shadowed[1][beyond[2] + 2 * beyond[0]]);
      meets = hn::And(meets, shadowed[2][beyond[0] + 2 * beyond[1]]);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!beyond[axis]) continue;
        above = hn::Sub(above, rise[axis]);
        meets = hn::And(meets, has_another[axis]);
      }
      meets = hn::And(meets, hn::Le(hn::Abs(above), reach));
      bits = hn::Or(bits, hn::IfThenElseZero(hn::RebindMask(di, meets), hn::Set(di, 1 << cell)));
    }
    hn::Store(bits, di, &overlaps[lane]);
  }
}

std::size_t write_blocks(const ListedBlocks& blocks, std::size_t count, const CellOrder& order, std::uint32_t* cells,
                         std::uint32_t* owners) {
  const hn::CappedTag<std::uint32_t, OverlapLanes::cells_of_a_block> d;
  std::array<std::uint32_t, OverlapLanes::cells_of_a_block> beyond;
  for (std::uint32_t i = 0; i < beyond.size(); ++i) {
    beyond[i] = (i & 1) + (i >> 1 & 1) * order.row + (i >> 2) * order.layer;
  }
  std::size_t written = 0;
  for (std::size_t block = 0; block < count; ++block) {
    const auto first = hn::Set(d, blocks.first[block]);
    const auto triangle = hn::Set(d, blocks.triangles[block]);
    for (std::size_t i = 0; i < beyond.size(); i += hn::Lanes(d)) {
      const std::uint64_t bits = static_cast<std::uint32_t>(blocks.overlaps[block]) >> i;
      const auto meets = hn::LoadMaskBits(d, reinterpret_cast<const std::uint8_t*>(&bits));
      hn::StoreU(hn::Compress(hn::Add(first, hn::LoadU(d, &beyond[i])), meets), d, cells + written);
      hn::StoreU(triangle, d, owners + written);
      written += hn::CountTrue(d, meets);
    }
  }
  return written;
}

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace surehit::detail {

HWY_EXPORT(find_in_lanes);
HWY_EXPORT(write_blocks);

void find_overlaps(const OverlapLanes& lanes, const CellPoint& padding, float size,
                   OverlapLanes::Row<std::int32_t>& overlaps) {
  HWY_DYNAMIC_DISPATCH(find_in_lanes)(lanes, padding, size, overlaps);
}

std::size_t write_overlaps(const ListedBlocks& blocks, std::size_t count, const CellOrder& order, std::uint32_t* cells,
                           std::uint32_t* owners) {
  return HWY_DYNAMIC_DISPATCH(write_blocks)(blocks, count, order, cells, owners);
}

}  // namespace surehit::detail
#endif
