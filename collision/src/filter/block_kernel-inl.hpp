// The kernel tests one path against a list of triangles. Highway compiles it for each instruction set.

#if defined(SUREHIT_BLOCK_KERNEL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_BLOCK_KERNEL_INL
#undef SUREHIT_BLOCK_KERNEL_INL
#else
#define SUREHIT_BLOCK_KERNEL_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "filter/kernel_path.hpp"
#include "support/lane_bits-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// A cell's triangles in the layout that the kernel loads. Coordinate k of triangle i is corners[k count + i]. A vector
/// load may read beyond the last coordinate.
template <typename Scalar>
struct TriangleList {
  const Scalar* corners;    ///< The coordinates of all corners.
  std::size_t count;        ///< The number of triangles.
  std::size_t first_entry;  ///< The index of the first triangle among the grid's entries.
  Scalar edge_size;         ///< The largest component of any b - a and c - a, or infinity if coordinates are too large.
  const Scalar* boxes = nullptr;  ///< The boxes of its octets, or null.
};

/// The verdicts on the triangles of one vector. Bit k of each mask is for lane k.
struct Verdicts {
  std::uint64_t possible;  ///< All lanes except the certain misses.
  std::uint64_t certain;   ///< All certain hits. They are possible too.
};

/// The certain hits that may be the first one.
template <typename Scalar>
struct FirstLanes {
  std::uint64_t lanes;  ///< The mask of their lanes.
  Scalar t_lower;       ///< The first exact t is at least this.
  Scalar t_upper;       ///< The first exact t is at most this.
};

/// Returns the lowest lane, which may be infinite. Highway's emulated vectors begin with the largest finite number.
template <class D>
HWY_INLINE hn::TFromD<D> min_of_lanes(D d, hn::Vec<D> v) {
#if HWY_TARGET == HWY_EMU128
  std::array<hn::TFromD<D>, hn::MaxLanes(D())> lanes;
  hn::StoreU(v, d, lanes.data());
  return *std::min_element(lanes.begin(), lanes.end());
#else
  return hn::GetLane(hn::MinOfLanes(d, v));
#endif
}

/// The determinants of Möller and Trumbore (1997) in working precision. Each lane of a vector has its own triangle of
/// the list. The first lane has triangle `from`. The list's coordinates may be floats where the arithmetic is in
/// double.
template <typename Scalar, typename Coordinate = Scalar>
class BlockDeterminants {
 public:
  HWY_INLINE BlockDeterminants(const KernelPath<Scalar>& path, const TriangleList<Coordinate>& list, std::size_t from)
      : left_(list.count - from) {
    const auto load = [&](std::size_t coordinate) {
      const Coordinate* const first = list.corners + (coordinate * list.count + from);
      if constexpr (std::is_same_v<Scalar, Coordinate>) {
        return hn::LoadU(d_, first);
      } else {
        return hn::PromoteTo(d_, hn::LoadU(hn::Rebind<Coordinate, Tag>(), first));
      }
    };
    const auto dot = [](V x0, V y0, V x1, V y1, V x2, V y2) {
      return hn::MulAdd(x0, y0, hn::MulAdd(x1, y1, hn::Mul(x2, y2)));
    };
    const auto cross = [](V x1, V y2, V x2, V y1) { return hn::MulSub(x1, y2, hn::Mul(x2, y1)); };
    const V d0 = all(path.d[0]), d1 = all(path.d[1]), d2 = all(path.d[2]);
    const V a0 = load(0), a1 = load(1), a2 = load(2);
    const V e0 = hn::Sub(load(3), a0), e1 = hn::Sub(load(4), a1), e2 = hn::Sub(load(5), a2);
    const V f0 = hn::Sub(load(6), a0), f1 = hn::Sub(load(7), a1), f2 = hn::Sub(load(8), a2);
    const V s0 = hn::Sub(all(path.start[0]), a0);
    const V s1 = hn::Sub(all(path.start[1]), a1);
    const V s2 = hn::Sub(all(path.start[2]), a2);
    const V p0 = cross(d1, f2, d2, f1), p1 = cross(d2, f0, d0, f2), p2 = cross(d0, f1, d1, f0);
    const V q0 = cross(s1, e2, s2, e1), q1 = cross(s2, e0, s0, e2), q2 = cross(s0, e1, s1, e0);
    det_ = dot(e0, p0, e1, p1, e2, p2);
    height_ = dot(f0, q0, f1, q1, f2, q2);
    u_ = dot(s0, p0, s1, p1, s2, p2);
    v_ = dot(d0, q0, d1, q1, d2, q2);
  }

 protected:
  using Tag = hn::ScalableTag<Scalar>;
  using V = hn::Vec<Tag>;

  HWY_INLINE static V all(Scalar x) { return hn::Set(Tag(), x); }

  [[no_unique_address]] Tag d_;
  std::size_t left_;  ///< The number of triangles from `from` on. Lanes after them are ignored.
  V det_, height_, u_, v_;
};

/// A filter made of the determinants and their error bounds. Its verdicts are certain, with fused operations or
/// without. What the bounds do not decide stays possible.
///
/// Lemmas K1 to K10 are in kernel_bound.hpp. A side is U, V or W, and an end is one of the two conditions of the range.
/// Let sigma be the sign of the computed det, and let r be the bound of det.
///
/// K11. The exact sigma det is at least -r.
/// Proof. The computed sigma det is |det| >= 0, and the error is at most r.
///
/// K12. The pair is a hit if each computed side and end, times sigma, is above its bound.
/// Proof. Then the exact ones, times sigma, are above zero. The sides sum to det, so the exact sigma det is above zero.
///     So det is not zero, and the line crosses the plane at T / det, with weights U / det, V / det and W / det.
///     These weights are positive, and the ends show that T / det is in the range.
///
/// K13. The pair is a miss if a computed side, times sigma, is below -(its bound + r).
/// Proof. Then the exact side, times sigma, is below -r. The three sides sum to det, so by K11 they sum to at least -r.
///     So the other two sum to more than zero, and one of them is positive. Two sides thus have opposite signs.
///     This is impossible at a hit. By K1, the sides are weights times det there, and no weight is negative.
///
/// K14. For the range [0, 1], K13 also holds with an end in place of the side.
/// Proof. The ends T and det - T sum to det. As in K13, the other end is positive, and the two have opposite signs.
///     At a hit they are t det and (1 - t) det by K1. Both t and 1 - t are at least zero there.
///
/// K15. For any range, the pair is a miss if an end, times sigma, is below -(its bound) and |det| is above r.
/// Proof. Then sigma is the sign of the exact det, and the exact end, times sigma, is negative.
///     At a hit the ends are (t - first) det and (last - t) det by K1. Times sigma, they are at least zero.
template <typename Scalar, typename Coordinate = Scalar>
class BlockKernel : BlockDeterminants<Scalar, Coordinate> {
  using Base = BlockDeterminants<Scalar, Coordinate>;
  using Base::all;
  using Base::d_;
  using Base::det_;
  using Base::height_;
  using Base::left_;
  using Base::u_;
  using Base::v_;
  using typename Base::Tag;
  using typename Base::V;

 public:
  /// The bounds for all triangles of a list. They are scalars, which the kernel loads into all lanes.
  using Bounds = ListBounds<Scalar>;
  HWY_INLINE static Bounds bounds(const KernelPath<Scalar>& path, const RangeWeights<Scalar>& range,
                                  const TriangleList<Coordinate>& list) {
    return {path.d_size, path.reach + list.edge_size, list.edge_size, range};
  }

  HWY_INLINE BlockKernel(const KernelPath<Scalar>& path, const TriangleList<Coordinate>& list, std::size_t from)
      : Base(path, list, from) {}

  /// Returns the certain misses and hits, by K12 to K15. A separate bound for each sign of det would need twice as many
  /// comparisons. Each comparison is true only for a certain verdict. If sizes might overflow, the bounds are infinite
  /// or NaN. Then all comparisons are false, and nothing is certain.
  [[nodiscard]] HWY_INLINE Verdicts classify(const RangeWeights<Scalar>& range, const Bounds& bounds) const {
    const V sign = hn::And(det_, all(Scalar{-0.0}));
    const V det = hn::Abs(det_), height = hn::Xor(height_, sign);
    const V u = hn::Xor(u_, sign), v = hn::Xor(v_, sign), w = hn::Sub(hn::Sub(det, u), v);
    const V side = hn::Min(hn::Min(u, v), w);
    auto misses = hn::Lt(side, all(bounds.min_side));  // K13
    V end;
    if (range.is_whole) [[likely]] {
      end = hn::Min(height, hn::Sub(det, height));
      misses = hn::Or(misses, hn::Lt(end, all(bounds.min_end)));  // K14
    } else {
      const V first = hn::MulAdd(height, all(range.t_first), hn::Mul(det, all(range.det_first)));
      const V last = hn::MulAdd(height, all(range.t_last), hn::Mul(det, all(range.det_last)));
      end = hn::Min(first, last);
      misses = hn::Or(misses, hn::And(hn::Lt(end, all(-bounds.range)), hn::Gt(det, all(bounds.det))));  // K15
    }
    const auto hits = hn::And(hn::Gt(side, all(bounds.side)), hn::Gt(end, all(bounds.range)));  // K12
    const std::uint64_t possible = bits_of(d_, hn::AndNot(misses, hn::FirstN(d_, left_)));
    return {possible, range.decides ? possible & bits_of(d_, hits) : 0};
  }

  /// The path crosses the triangles' planes at t = height / det.
  struct Crossing {
    V height, det;
  };
  [[nodiscard]] HWY_INLINE Crossing crossing() const { return {height_, det_}; }

  /// Returns the lanes of `certain` that may be the first hit. Lanes with t certainly above `limit` are left out. The
  /// interval of t is that of K16.
  [[nodiscard]] HWY_INLINE static FirstLanes<Scalar> first_of(const Bounds& bounds, const Crossing& crossing,
                                                              std::uint64_t certain, Scalar limit) {
    const Tag d;
    const V infinity = all(std::numeric_limits<Scalar>::infinity());
    const Interval<Tag> t = interval_of_t(d, all(bounds.det), all(bounds.height), crossing.det, crossing.height);
    const auto taken = mask_of(d, certain);
    const V lower = hn::IfThenElse(taken, t.lower, infinity);
    const Scalar t_upper = min_of_lanes(d, hn::IfThenElse(taken, t.upper, infinity));
    const auto lanes = hn::And(taken, hn::Le(lower, all(std::min(t_upper, limit))));
    return {bits_of(d, lanes), min_of_lanes(d, lower), t_upper};
  }

  /// The same for the only certain hit, with its crossing. It does not wait for other lanes. It has no limit, because
  /// the caller can compare `t_lower` with a limit.
  [[nodiscard]] HWY_INLINE static FirstLanes<Scalar> first_of_one(const Bounds& bounds, Scalar height, Scalar det,
                                                                  std::uint64_t certain) {
    using One = hn::CappedTag<Scalar, 1>;
    const auto one = [](Scalar x) { return hn::Set(One(), x); };
    const Interval<One> t = interval_of_t(One(), one(bounds.det), one(bounds.height), one(det), one(height));
    return {certain, hn::GetLane(t.lower), hn::GetLane(t.upper)};
  }

  /// Returns the lanes of `certain` that may be the first hit of this vector. The usual case is one certain hit, and
  /// `first_of_one` is faster for it.
  [[nodiscard]] HWY_INLINE FirstLanes<Scalar> first_of(const Bounds& bounds, std::uint64_t certain,
                                                       Scalar limit) const {
    if (!std::has_single_bit(certain)) return first_of(bounds, crossing(), certain, limit);
    constexpr std::size_t max_lanes_of_any = hn::MaxLanes(Tag());
    alignas(sizeof(Scalar) * max_lanes_of_any) Scalar height[max_lanes_of_any];
    alignas(sizeof(Scalar) * max_lanes_of_any) Scalar det[max_lanes_of_any];
    hn::Store(height_, d_, height);
    hn::Store(det_, d_, det);
    const auto lane = static_cast<std::size_t>(std::countr_zero(certain));
    return first_of_one(bounds, height[lane], det[lane], certain);
  }

 private:
  template <class D>
  struct Interval {
    hn::Vec<D> lower, upper;
  };

  /// Returns an interval that contains the exact t of a certain hit.
  ///
  /// Here r_det and r_height are the bounds of det and T, and t is the computed height / det.
  ///
  /// K16. The exact t is within 1.5 (r_height + |t| r_det) / |det| of t. This includes the roundings of t.
  /// Proof. By K10, it is within (r_height + |t| r_det) / (|det| - r_det) of the quotient of the computed numbers.
  ///     By K12, the three sides of a certain hit have the sign of det, and each is above its bound.
  ///     This bound is at least r_det, and the sides sum to det. So |det| > 3 r_det, up to roundings.
  ///     Then |det| - r_det > 2/3 |det|, which saves a second division.
  ///     K2 uses 48 of the 66 eps in a bound. The other 18 eps times the product of sizes are spare.
  ///     By K3, they are at least 3 eps |det| in r_det, and at least 3 eps |height| in r_height.
  ///     Together, they are 6 eps |t|.
  ///     The inverse, t, and the sum of t and the bound are rounded once each. So 3 eps |t| stay spare.
  ///
  /// K17. The factor 1.5 + 2^-17 and the term `min` cover the roundings and the underflow of the bound itself.
  /// Proof. The bound has fewer than 16 roundings, and |det| > 3 r_det adds a few. All are below 2^-17 in both types.
  ///     The product |t| r_det may lose eta / 2. This is tiny compared with r_height, which includes 32 eta L (K8).
  ///     All later products, and t itself, may lose eta / 2 each. The smallest normal number is far larger.
  ///     The size of a certain det is between 96 eta L (K8) and 6 L^3 (K3). So its inverse is a normal number.
  ///
  /// If t or the bound overflows, the interval is infinite.
  template <class D>
  [[nodiscard]] HWY_INLINE static Interval<D> interval_of_t(D d, hn::Vec<D> det_bound, hn::Vec<D> height_bound,
                                                            hn::Vec<D> det, hn::Vec<D> height) {
    const auto infinity = hn::Set(d, std::numeric_limits<Scalar>::infinity());
    const auto inverse = hn::Div(hn::Set(d, 1), det);
    const auto t = hn::Mul(height, inverse);
    const auto radius = hn::Mul(hn::MulAdd(hn::Abs(t), det_bound, height_bound), hn::Abs(inverse));
    // K16 and K17
    const auto bound =
        hn::MulAdd(radius, hn::Set(d, Scalar(1.5) + Scalar(0x1p-17)), hn::Set(d, std::numeric_limits<Scalar>::min()));
    const auto known = hn::And(hn::Ge(bound, hn::Zero(d)), hn::Lt(bound, infinity));
    return {hn::IfThenElse(known, hn::Sub(t, bound), hn::Neg(infinity)),
            hn::IfThenElse(known, hn::Add(t, bound), infinity)};
  }
};

// These functions are not inlined, so that their stack frames are gone when the exact stage needs the stack.

/// Returns the verdicts on the triangles of one vector, which begins with triangle `from`.
template <typename Kernel, typename Scalar>
HWY_NOINLINE Verdicts classify(const KernelPath<Scalar>& path, const RangeWeights<Scalar>& range,
                               const TriangleList<Scalar>& list, const typename Kernel::Bounds& bounds,
                               std::size_t from) {
  return Kernel(path, list, from).classify(range, bounds);
}

/// Does the same, and sets `first` to the certain hits that may be the first one. Several of them are cut at `limit`. A
/// single one is not.
template <typename Kernel, typename Scalar>
HWY_NOINLINE Verdicts classify(const KernelPath<Scalar>& path, const RangeWeights<Scalar>& range,
                               const TriangleList<Scalar>& list, const typename Kernel::Bounds& bounds,
                               std::size_t from, Scalar limit, FirstLanes<Scalar>& first) {
  const Kernel kernel(path, list, from);
  const Verdicts verdicts = kernel.classify(range, bounds);
  if (verdicts.possible != 0) first = kernel.first_of(bounds, verdicts.certain, limit);
  return verdicts;
}

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
