// The kernel: one path against a list of triangles, for the instruction set that Highway compiles it for.

#if defined(SUREHIT_BLOCK_KERNEL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_BLOCK_KERNEL_INL
#undef SUREHIT_BLOCK_KERNEL_INL
#else
#define SUREHIT_BLOCK_KERNEL_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "filter/kernel_path.hpp"
#include "query/lane_bits-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// A cell's triangles, as the kernel loads them: coordinate k of triangle i is at corners[k count + i], and a vector
/// may be loaded from beyond the last.
template <typename Scalar>
struct TriangleList {
  const Scalar* corners;
  std::size_t count;
  std::size_t first_entry;  ///< among the grid's
  Scalar edge_size;         ///< the greatest component of any b - a and c - a; infinite where they are too large
};

/// Some triangles of a list, a bit for each.
struct Lanes {
  std::uint64_t possible;  ///< all but the certain misses
  std::uint64_t certain;   ///< of these, the certain hits
};

/// Of certain hits, those that may be the first one.
template <typename Scalar>
struct FirstLanes {
  std::uint64_t lanes;
  Scalar t_lower;  ///< their first t is in [t_lower, t_upper]
  Scalar t_upper;  //
};

/// What each determinant is a sum of: six products, or the sizes of these, which bound what it is off by.
enum class Products : std::uint8_t { as_they_are, by_size };

/// Möller and Trumbore's determinants (1997) in working precision: one path against the triangles of a list from `from`
/// on, as many as a vector has lanes.
template <typename Scalar, Products products = Products::as_they_are>
class BlockDeterminants {
 protected:
  using Tag = hn::ScalableTag<Scalar>;
  using V = hn::Vec<Tag>;

  HWY_INLINE BlockDeterminants(const KernelPath<Scalar>& path, const TriangleList<Scalar>& list, std::size_t from)
      : left_(list.count - from) {
    constexpr bool by_size = products == Products::by_size;
    const auto load = [&](std::size_t coordinate) {
      return hn::LoadU(d_, list.corners + (coordinate * list.count + from));
    };
    const auto factor = [&](V x) {
      if constexpr (by_size) return hn::Abs(x);
      return x;
    };
    const auto difference = [&](V x, V y) { return factor(hn::Sub(x, y)); };
    const auto dot = [&](V x0, V y0, V x1, V y1, V x2, V y2) {
      return hn::MulAdd(x0, y0, hn::MulAdd(x1, y1, hn::Mul(x2, y2)));
    };
    const auto cross = [&](V x1, V y2, V x2, V y1) {
      const V second = hn::Mul(x2, y1);
      if constexpr (by_size) return hn::MulAdd(x1, y2, second);
      return hn::MulSub(x1, y2, second);
    };
    const V d0 = factor(all(path.d[0])), d1 = factor(all(path.d[1])), d2 = factor(all(path.d[2]));
    const V a0 = load(0), a1 = load(1), a2 = load(2);
    const V e0 = difference(load(3), a0), e1 = difference(load(4), a1), e2 = difference(load(5), a2);
    const V f0 = difference(load(6), a0), f1 = difference(load(7), a1), f2 = difference(load(8), a2);
    const V s0 = difference(all(path.start[0]), a0);
    const V s1 = difference(all(path.start[1]), a1);
    const V s2 = difference(all(path.start[2]), a2);
    const V p0 = cross(d1, f2, d2, f1), p1 = cross(d2, f0, d0, f2), p2 = cross(d0, f1, d1, f0);
    const V q0 = cross(s1, e2, s2, e1), q1 = cross(s2, e0, s0, e2), q2 = cross(s0, e1, s1, e0);
    det_ = dot(e0, p0, e1, p1, e2, p2);
    height_ = dot(f0, q0, f1, q1, f2, q2);
    u_ = dot(s0, p0, s1, p1, s2, p2);
    v_ = dot(d0, q0, d1, q1, d2, q2);
  }

  HWY_INLINE static V all(Scalar x) { return hn::Set(Tag(), x); }

  [[no_unique_address]] Tag d_;
  std::size_t left_;  ///< triangles, and more lanes than these count for nothing
  V det_, height_, u_, v_;
};

/// `ListBounds` for each triangle alone.
template <typename Scalar>
class BlockBounds : BlockDeterminants<Scalar, Products::by_size> {
  using Base = BlockDeterminants<Scalar, Products::by_size>;
  using Base::all;
  using typename Base::V;

 public:
  HWY_INLINE BlockBounds(const KernelPath<Scalar>& path, const TriangleList<Scalar>& list, std::size_t from,
                         const RangeWeights<Scalar>& weights)
      : Base(path, list, from) {
    using Bound = KernelBound<Scalar>;
    const V share = all(Bound::relative / 6);  // each product of sizes stands for six products
    const V underflow = all(Bound::underflow);
    side = hn::MulAdd(hn::Add(hn::Add(this->u_, this->v_), this->det_), share, underflow);
    det = hn::MulAdd(this->det_, share, underflow);
    height = hn::MulAdd(this->height_, share, det);
    range = hn::MulAdd(this->height_, all(weights.t_bound / 6), hn::Mul(det, all(weights.det_size)));
    min_side = hn::Neg(hn::Add(side, det));
    min_end = hn::Neg(hn::Add(range, det));
  }

  V side, range, det, height, min_side, min_end;
};

/// The determinants as their own filter: the bound stands in kernel_bound.hpp. Verdicts are certain, fused or not; what
/// they cannot tell stays possible.
template <typename Scalar>
class BlockKernel : BlockDeterminants<Scalar> {
  using Base = BlockDeterminants<Scalar>;
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
  /// What any of the list's triangles are weighed with, in scalars that the kernel loads into all lanes.
  using Bounds = ListBounds<Scalar>;
  HWY_INLINE static Bounds bounds(const KernelPath<Scalar>& path, const RangeWeights<Scalar>& range,
                                  const TriangleList<Scalar>& list) {
    return {path.d_size, path.reach + list.edge_size, list.edge_size, range};
  }

  HWY_INLINE BlockKernel(const KernelPath<Scalar>& path, const TriangleList<Scalar>& list, std::size_t from)
      : Base(path, list, from) {}

  /// For a hit, U, V, W and the two ends that the range asks for must each be at least zero with det's sign taken out.
  /// Here the computed det's is, which is the wrong one perhaps where det is within its bound, r, of zero.
  ///
  /// All certainly above zero are a hit: det = U + V + W is too, so that its sign was right.
  ///
  /// A side that is below zero by its bound and r more is exactly below -r. The three sum to det, which is not: the two
  /// others sum to more than zero, and one of them is above it. Of two of opposite signs one speaks against a hit,
  /// whatever det's sign is; and were det zero, a path that meets the triangle would lie in its plane and all of them
  /// would vanish. So that is a miss. (A bound for each sign, with none of them taken out, takes twice the comparisons:
  /// on AVX2 and AVX-512 1.03 and 1.01 of the time.)
  ///
  /// So it is with the ends of [0, 1], T and det - T, which sum to det. Of other ranges an end that is certainly below
  /// zero is a miss where det's sign is certain.
  ///
  /// Comparisons accept what is certain, and where sizes might overflow, the bound is infinite or NaN, so that nothing
  /// is.
  [[nodiscard]] HWY_INLINE Lanes classify(const RangeWeights<Scalar>& range, const Bounds& bounds) const {
    const struct {
      V side, range, det, min_side, min_end;
    } in_all_lanes = {all(bounds.side), all(bounds.range), all(bounds.det), all(bounds.min_side), all(bounds.min_end)};
    return classify_by(range, in_all_lanes);
  }

  /// Where the path crosses the triangles' planes: t = height / det.
  struct Crossing {
    V height, det;
  };
  [[nodiscard]] HWY_INLINE Crossing crossing() const { return {height_, det_}; }

  /// Of `certain` hits those that may be the first, if none that begins after t = `limit` can be. The interval of t is
  /// derived below.
  [[nodiscard]] HWY_INLINE static FirstLanes<Scalar> first_of(const Bounds& bounds, const Crossing& crossing,
                                                              std::uint64_t certain, Scalar limit) {
    return first_of(all(bounds.det), all(bounds.height), crossing, certain, limit);
  }

  /// The same of a hit that alone is certain, whose crossing this is: it waits for no other lane. It is named whatever
  /// the limit is, for `t_lower` tells as well whether it lies beyond.
  [[nodiscard]] HWY_INLINE static FirstLanes<Scalar> lone_first(const Bounds& bounds, Scalar height, Scalar det,
                                                                std::uint64_t certain) {
    using One = hn::CappedTag<Scalar, 1>;
    const auto one = [](Scalar x) { return hn::Set(One(), x); };
    const Interval<One> t = interval_of_t(One(), one(bounds.det), one(bounds.height), one(det), one(height));
    return {certain, hn::GetLane(t.lower), hn::GetLane(t.upper)};
  }

  /// Of these triangles' certain hits: of several as above, of one alone as `lone_first` says, which is the usual case
  /// and spares single first hits 2 to 5% of their time.
  [[nodiscard]] HWY_INLINE FirstLanes<Scalar> first_of(const Bounds& bounds, std::uint64_t certain,
                                                       Scalar limit) const {
    if (!std::has_single_bit(certain)) return first_of(bounds, crossing(), certain, limit);
    constexpr std::size_t max_lanes_of_any = hn::MaxLanes(Tag());
    alignas(sizeof(Scalar) * max_lanes_of_any) Scalar height[max_lanes_of_any];
    alignas(sizeof(Scalar) * max_lanes_of_any) Scalar det[max_lanes_of_any];
    hn::Store(height_, d_, height);
    hn::Store(det_, d_, det);
    const auto lane = static_cast<std::size_t>(std::countr_zero(certain));
    return lone_first(bounds, height[lane], det[lane], certain);
  }

  /// Weighs the triangles of a list that the path may meet once more, each by its own products: the list's longest edge
  /// may be that of one large triangle among small ones, and of six products most are small where an edge or the path
  /// runs along an axis. (A half of what the list's bounds leave open goes without the narrowphase then.) Apart, for
  /// few lists ask for it.
  HWY_NOINLINE static void weigh_each(const KernelPath<Scalar>& path, const TriangleList<Scalar>& list,
                                      std::size_t from, const RangeWeights<Scalar>& range, Scalar limit, Lanes& lanes,
                                      FirstLanes<Scalar>& first) {
    constexpr Scalar too_large = std::numeric_limits<Scalar>::infinity();
    if (!(list.edge_size < too_large && path.d_size < too_large)) return;
    const BlockKernel kernel(path, list, from);
    const BlockBounds<Scalar> bounds(path, list, from, range);
    const Lanes each = kernel.classify_by(range, bounds);
    lanes.possible &= each.possible;
    lanes.certain = lanes.possible & (lanes.certain | each.certain);
    first = first_of(bounds.det, bounds.height, kernel.crossing(), lanes.certain, limit);
  }

 private:
  /// By `BlockBounds` or what has the same names.
  template <typename Limits>
  [[nodiscard]] HWY_INLINE Lanes classify_by(const RangeWeights<Scalar>& range, const Limits& limits) const {
    const V sign = hn::And(det_, all(Scalar{-0.0}));
    const V det = hn::Abs(det_), height = hn::Xor(height_, sign);
    const V u = hn::Xor(u_, sign), v = hn::Xor(v_, sign), w = hn::Sub(hn::Sub(det, u), v);
    const V side = hn::Min(hn::Min(u, v), w);
    auto misses = hn::Lt(side, limits.min_side);
    V end;
    if (range.is_whole) [[likely]] {
      end = hn::Min(height, hn::Sub(det, height));
      misses = hn::Or(misses, hn::Lt(end, limits.min_end));
    } else {
      const V first = hn::MulAdd(height, all(range.t_first), hn::Mul(det, all(range.det_first)));
      const V last = hn::MulAdd(height, all(range.t_last), hn::Mul(det, all(range.det_last)));
      end = hn::Min(first, last);
      misses = hn::Or(misses, hn::And(hn::Lt(end, hn::Neg(limits.range)), hn::Gt(det, limits.det)));
    }
    const auto hits = hn::And(hn::Gt(side, limits.side), hn::Gt(end, limits.range));
    const std::uint64_t possible = bits_of(d_, hn::AndNot(misses, hn::FirstN(d_, left_)));
    return {possible, range.decides ? possible & bits_of(d_, hits) : 0};
  }

  template <class D>
  struct Interval {
    hn::Vec<D> lower, upper;
  };

  /// t is within (r_height + |t| r_det) / (|det| - r_det) of the quotient of what is computed, where r_height and r_det
  /// are the determinants' bounds. The det of a certain hit is the sum of U, V and W, each beyond r_det and of its
  /// sign: |det| - r_det is at least 2 / 3 |det| but for roundings, so that its inverse, a second division, is not
  /// needed. Of their 66 u, 48 u hold what either may be off (of a triangle's own products, 8 u of 11 u). The other
  /// 18 u of d e f or of f s e, 3 u of the most that det or height may be, make 3 u |t| each: room for the two
  /// roundings of the quotient, and four more. 2^-17 is far more than the radius needs for its own. A certain det is no
  /// denormal, so that its inverse is finite. Where t or the radius overflows, nothing is known.
  template <class D>
  [[nodiscard]] HWY_INLINE static Interval<D> interval_of_t(D d, hn::Vec<D> det_bound, hn::Vec<D> height_bound,
                                                            hn::Vec<D> det, hn::Vec<D> height) {
    const auto infinity = hn::Set(d, std::numeric_limits<Scalar>::infinity());
    const auto inverse = hn::Div(hn::Set(d, 1), det);
    const auto t = hn::Mul(height, inverse);
    const auto radius = hn::Mul(hn::MulAdd(hn::Abs(t), det_bound, height_bound), hn::Abs(inverse));
    const auto bound =
        hn::MulAdd(radius, hn::Set(d, Scalar(1.5) + Scalar(0x1p-17)), hn::Set(d, std::numeric_limits<Scalar>::min()));
    const auto known = hn::And(hn::Ge(bound, hn::Zero(d)), hn::Lt(bound, infinity));
    return {hn::IfThenElse(known, hn::Sub(t, bound), hn::Neg(infinity)),
            hn::IfThenElse(known, hn::Add(t, bound), infinity)};
  }

  [[nodiscard]] HWY_INLINE static FirstLanes<Scalar> first_of(V det_bound, V height_bound, const Crossing& crossing,
                                                              std::uint64_t certain, Scalar limit) {
    const Tag d;
    const V infinity = all(std::numeric_limits<Scalar>::infinity());
    const Interval<Tag> t = interval_of_t(d, det_bound, height_bound, crossing.det, crossing.height);
    const auto taken = mask_of(d, certain);
    const V lower = hn::IfThenElse(taken, t.lower, infinity);
    const Scalar t_upper = hn::GetLane(hn::MinOfLanes(d, hn::IfThenElse(taken, t.upper, infinity)));
    const auto lanes = hn::And(taken, hn::Le(lower, all(std::min(t_upper, limit))));
    return {bits_of(d, lanes), hn::GetLane(hn::MinOfLanes(d, lower)), t_upper};
  }
};

// Not inlined: their frames are gone when the exact stage needs the stack, and the call costs nothing that can be
// measured.

template <typename Kernel, typename Scalar>
HWY_NOINLINE Lanes classify(const KernelPath<Scalar>& path, const RangeWeights<Scalar>& range,
                            const TriangleList<Scalar>& list, const ListBounds<Scalar>& bounds, std::size_t from) {
  return Kernel(path, list, from).classify(range, bounds);
}

/// Says of the certain hits too which may be the first, if none beyond t = `limit` can be; of one alone, whatever the
/// limit is.
template <typename Kernel, typename Scalar>
HWY_NOINLINE Lanes classify(const KernelPath<Scalar>& path, const RangeWeights<Scalar>& range,
                            const TriangleList<Scalar>& list, const ListBounds<Scalar>& bounds, std::size_t from,
                            Scalar limit, FirstLanes<Scalar>& first) {
  const Kernel kernel(path, list, from);
  const Lanes lanes = kernel.classify(range, bounds);
  if (lanes.possible != 0) first = kernel.first_of(bounds, lanes.certain, limit);
  return lanes;
}

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
