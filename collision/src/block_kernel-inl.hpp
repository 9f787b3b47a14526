// The kernel over a list of triangles, for the instruction set that Highway compiles it for.

#if defined(SUREHIT_BLOCK_KERNEL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_BLOCK_KERNEL_INL
#undef SUREHIT_BLOCK_KERNEL_INL
#else
#define SUREHIT_BLOCK_KERNEL_INL
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#include "kernel_path.hpp"
#include "lane_bits-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Some triangles of a list, a bit for each.
struct Lanes {
  std::uint64_t possible;  ///< all but the certain misses
  std::uint64_t certain;   ///< of these, the certain hits
};

/// Möller and Trumbore (1997) in working precision, as its own filter: the bound stands in kernel_bound.hpp. `list`
/// points to the first coordinate of the first triangle, `pitch` lies between a coordinate and the next, and `count`
/// triangles are left in the list. Verdicts are certain, fused or not; what they cannot tell stays possible.
///
/// U, V, W and the two that the range asks for must each be at least zero for a hit, with det's sign taken out. So two
/// of certain and opposite signs are a miss, even where det's own sign is not certain: were det zero, a path that meets
/// the triangle would lie in its plane and all of them would vanish. All certain and of one sign are a hit: det = U + V
/// + W then has that sign too. Comparisons accept what is certain, and where sizes might overflow, the bound is
/// infinite or NaN, so that nothing is.
///
/// Not inlined: its frame is gone when the exact stage needs the stack, and the call costs nothing that can be
/// measured.
template <typename Scalar>
HWY_NOINLINE Lanes classify(const KernelPath<Scalar>& path, const Scalar* list, std::size_t pitch, std::size_t count,
                            Scalar edge_size) {
  const hn::ScalableTag<Scalar> d;
  using V = hn::Vec<decltype(d)>;
  const auto all = [&](Scalar x) { return hn::Set(d, x); };
  const auto load = [&](std::size_t coordinate) { return hn::LoadU(d, list + coordinate * pitch); };
  const auto dot = [&](V x0, V y0, V x1, V y1, V x2, V y2) {
    return hn::MulAdd(x0, y0, hn::MulAdd(x1, y1, hn::Mul(x2, y2)));
  };
  const auto cross = [&](V x1, V y2, V x2, V y1) { return hn::MulSub(x1, y2, hn::Mul(x2, y1)); };

  const V d0 = all(path.d[0]), d1 = all(path.d[1]), d2 = all(path.d[2]);
  const V a0 = load(0), a1 = load(1), a2 = load(2);
  const V e0 = hn::Sub(load(3), a0), e1 = hn::Sub(load(4), a1), e2 = hn::Sub(load(5), a2);
  const V f0 = hn::Sub(load(6), a0), f1 = hn::Sub(load(7), a1), f2 = hn::Sub(load(8), a2);
  const V s0 = hn::Sub(all(path.start[0]), a0);
  const V s1 = hn::Sub(all(path.start[1]), a1);
  const V s2 = hn::Sub(all(path.start[2]), a2);
  const V p0 = cross(d1, f2, d2, f1), p1 = cross(d2, f0, d0, f2), p2 = cross(d0, f1, d1, f0);
  const V q0 = cross(s1, e2, s2, e1), q1 = cross(s2, e0, s0, e2), q2 = cross(s0, e1, s1, e0);
  const V det = dot(e0, p0, e1, p1, e2, p2);
  const V height = dot(f0, q0, f1, q1, f2, q2);
  const V u = dot(s0, p0, s1, p1, s2, p2);
  const V v = dot(d0, q0, d1, q1, d2, q2);
  const V w = hn::Sub(hn::Sub(det, u), v);
  const V first = hn::MulAdd(height, all(path.range.t_first), hn::Mul(det, all(path.range.det_first)));
  const V last = hn::MulAdd(height, all(path.range.t_last), hn::Mul(det, all(path.range.det_last)));

  // U, V and W by the bound of W, both of the range's by the greater of theirs; E1 and E2 by the list's longest edge.
  using Bound = KernelBound<Scalar>;
  const Scalar d_edge = Bound::relative * path.d_size * edge_size;
  const Scalar d_edges = d_edge * edge_size + Bound::underflow * (1 + path.d_size + edge_size);
  const Scalar edges = Bound::relative * edge_size * edge_size * path.range.t_size + Bound::underflow;
  const V s_size = hn::Max(hn::Max(hn::Abs(s0), hn::Abs(s1)), hn::Abs(s2));
  const V side_bound = hn::MulAdd(s_size, all(2 * d_edge + Bound::underflow), all(d_edges));
  const V range_bound = hn::MulAdd(s_size, all(edges), all(d_edges * path.range.det_size + d_edges));

  const V least_side = hn::Min(hn::Min(u, v), w), greatest_side = hn::Max(hn::Max(u, v), w);
  const V least_end = hn::Min(first, last), greatest_end = hn::Max(first, last);
  const auto negative = hn::Or(hn::Lt(least_side, hn::Neg(side_bound)), hn::Lt(least_end, hn::Neg(range_bound)));
  const auto positive = hn::Or(hn::Gt(greatest_side, side_bound), hn::Gt(greatest_end, range_bound));
  const auto possible = hn::AndNot(hn::And(negative, positive), hn::FirstN(d, count));
  if (HWY_LIKELY(hn::AllFalse(d, possible))) return {0, 0};
  const auto all_positive = hn::And(hn::Gt(least_side, side_bound), hn::Gt(least_end, range_bound));
  const auto all_negative =
      hn::And(hn::Lt(greatest_side, hn::Neg(side_bound)), hn::Lt(greatest_end, hn::Neg(range_bound)));
  const std::uint64_t possible_bits = bits_of(d, possible);
  if (!path.range.decides) return {possible_bits, 0};
  return {possible_bits, possible_bits & bits_of(d, hn::Or(all_positive, all_negative))};
}

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
