// The last step to a hit is to round it. Highway compiles this for each instruction set.

#if defined(SUREHIT_HIT_ROUNDING_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_HIT_ROUNDING_INL
#undef SUREHIT_HIT_ROUNDING_INL
#else
#define SUREHIT_HIT_ROUNDING_INL
#endif

#include <cstdint>

#include "filter/double_kernel-inl.hpp"
#include "support/lane_bits-inl.hpp"
#include "surehit/hit.hpp"
#include "surehit/path.hpp"
#include "surehit/triangle.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// Intervals of t, u and v for a certain hit in each lane. All coordinates are floats, and the arithmetic is in double.
/// All three quotients share one division.
///
/// The names are those of kernel_bound.hpp, with eps = 2^-53. Here e is the largest component of E1 and E2, rounded to
/// float, and m is the computed det.
///
/// R1. At a hit, s <= |t| d + e.
/// Proof. S = u E1 + v E2 - t D, as in K1. The weights u and v are not negative, and their sum is at most 1.
///
/// R2. The computed quotients of the computed determinants are off by at most:
///
///     u and v    48 eps d e (|t| d + 2 e) / |m|;
///     t          48 eps e e (2 |t| d + e) / |m|.
///
///     This leaves out the roundings of the quotients.
/// Proof. By K2, det is off by 48 eps d e e, U and V by 48 eps s d e, and T by 48 eps s e e.
///     Products of three floats neither overflow nor underflow in double.
///     The second form of K10 gives the error of each quotient, with the exact u, v or t as N / M.
///     For u and v it is 48 eps d e (s + e) / |m|, because |u| <= 1 and |v| <= 1.
///     For t it is 48 eps e e (s + |t| d) / |m|. R1 replaces s.
///
/// R3. If 60 eps replace 48 eps, the roundings of the quotients are included.
/// Proof. The inverse, its product, and the sum with the bound are rounded once each. This is 3 eps times the quotient.
///     By K3, |m| <= 6 d e e. So 12 eps d e (2 e) / |m| >= 4 eps >= 4 eps |u|, and the same holds for v.
///     Also, 12 eps e e (2 |t| d) / |m| >= 4 eps |t|.
///
/// R4. If 66 eps replace 60 eps, the roundings of d, e and the bound are included.
/// Proof. They are a few eps, and e is off by 2^-24. The step from 60 to 66 is a tenth.
template <class D>
struct HitIntervals {
  using V = hn::Vec<D>;
  struct Interval {
    V lower, upper;
  };

  /// `t_size` must be at least |t| in each lane. If it is infinite, the intervals are too. `edge_size` is the e above.
  HWY_INLINE HitIntervals(D d, const Vectors<D>& start, const Vectors<D>& direction, const Vectors<D>& a,
                          const Vectors<D>& b, const Vectors<D>& c, V t_size, V edge_size) {
    const DoubleDeterminants<D> of(d, start, direction, a, b, c);
    det = of.det;
    const V way = hn::Mul(t_size, of.d_size);
    const V share = hn::Mul(edge_size, hn::Set(d, KernelBound<double>::relative));
    const V of_side = hn::Mul(hn::Mul(share, of.d_size), hn::Add(way, hn::Add(edge_size, edge_size)));  // R4
    const V of_height = hn::Mul(hn::Mul(share, edge_size), hn::Add(hn::Add(way, way), edge_size));      // R4
    const V inverse = hn::Div(hn::Set(d, 1), det);
    const V inverse_size = hn::Abs(inverse);
    const V side_bound = hn::Mul(of_side, inverse_size);
    const V t_bound = hn::Mul(of_height, inverse_size);
    const auto around = [](V middle, V bound) -> Interval { return {hn::Sub(middle, bound), hn::Add(middle, bound)}; };
    t = around(hn::Mul(of.height, inverse), t_bound);
    u = around(hn::Mul(of.u, inverse), side_bound);
    v = around(hn::Mul(of.v, inverse), side_bound);
  }

  Interval t, u, v;
  V det;
};

/// The rounded hits. A hit is rounded if both ends of each interval round to the same float (Ziv 1991).
///
/// R5. Then the exact value rounds to this float too.
/// Proof. Rounding is monotonic, and the exact value is between the ends.
template <class D>
struct RoundedHits {
  using FloatTag = hn::Rebind<float, D>;
  using Floats = hn::Vec<FloatTag>;

  HWY_INLINE RoundedHits(D d, const HitIntervals<D>& hits) {
    const FloatTag df;
    const auto round = [&](const typename HitIntervals<D>::Interval& interval, Floats& rounded_value) {
      rounded_value = hn::Add(hn::DemoteTo(df, interval.upper), hn::Zero(df));  // This turns -0 into +0.
      return hn::Eq(hn::DemoteTo(df, interval.lower), rounded_value);           // R5
    };
    const auto is_t = round(hits.t, t);
    const auto is_u = round(hits.u, u);
    const auto is_v = round(hits.v, v);
    rounded = bits_of(df, hn::And(is_t, hn::And(is_u, is_v)));
    front = bits_of(d, hn::Gt(hits.det, hn::Zero(d)));
  }

  Floats t, u, v;
  std::uint64_t rounded;  ///< The mask of the lanes in which t, u and v are right.
  std::uint64_t front;    ///< The mask of the lanes whose path arrives at the front.
};

/// Returns true in the lanes in which x - y is exactly `difference` (Knuth).
template <class D>
HWY_INLINE hn::Mask<D> is_exact(D d, hn::Vec<D> x, hn::Vec<D> y, hn::Vec<D> difference) {
  const auto of_y = hn::Sub(difference, x);
  const auto rest = hn::Sub(hn::Sub(x, hn::Sub(difference, of_y)), hn::Add(y, of_y));
  return hn::Eq(rest, hn::Zero(d));
}
template <class D>
HWY_INLINE hn::Mask<D> is_exact(D d, const Vectors<D>& x, const Vectors<D>& y, const Vectors<D>& difference) {
  return hn::And(is_exact(d, x.x, y.x, difference.x),
                 hn::And(is_exact(d, x.y, y.y, difference.y), is_exact(d, x.z, y.z, difference.z)));
}

/// Intervals of the same hits from starts that are moved along the paths to the hits. From a start far away, u and v
/// are known to a small share of the way, which may be a large share of the triangle. From the moved start they are
/// known to a small share of the triangle. There must be fused operations.
///
/// Let t0 be the middle of the interval of t in `from_start`, and S' = S + t0 D.
///
/// R6. U, V and det are those of S' and D too, and the T of S' is (t - t0) det.
/// Proof. S' is the S of the start p + t0 D. It is on the same line, with the parameter t - t0.
///
/// R7. If the computed S and D are exact, R1 to R4 hold with S' for S and t - t0 for t.
/// Proof. A fused operation rounds S' once, as K2 allows for a difference of coordinates. Both t and t0 lie in the
///     interval of t. So its length bounds |t - t0|, up to a rounding that R4 has room for.
///
/// R8. Products of S' do not underflow if |t0| is at least 2^-200. In other lanes nothing is certain.
/// Proof. The last places of t0, S and D are at least 2^-252, 2^-149 and 2^-149. So a component of S' is zero or at
///     least 2^-401. The other factors of its products are zero or at least 2^-149, and there are two of them.
///
/// R9. The sum of t0 and an end of the interval of t - t0, and the one with `rounding`, are each rounded by 2^-53 of
/// themselves. `rounding` is four times that of the largest sum, so its own two roundings are covered too.
template <class D>
HWY_INLINE HitIntervals<D> intervals_from_hits(D d, PathKind kind, const Vectors<D>& start, const Vectors<D>& toward,
                                               const Vectors<D>& a, const Vectors<D>& b, const Vectors<D>& c,
                                               hn::Vec<D> edge_size, const HitIntervals<D>& from_start) {
  using V = hn::Vec<D>;
  const V zero = hn::Zero(d);
  const Vectors<D> direction = directions_of<D>(kind, start, toward);
  const Vectors<D> s = difference<D>(start, a);
  auto are_known = is_exact(d, start, a, s);
  if (kind == PathKind::segment) are_known = hn::And(are_known, is_exact(d, toward, start, direction));
  const V t0 = hn::Mul(hn::Set(d, 0.5), hn::Add(from_start.t.lower, from_start.t.upper));
  are_known = hn::And(are_known, hn::Ge(hn::Abs(t0), hn::Set(d, 0x1p-200)));  // R8
  const Vectors<D> moved = {hn::MulAdd(t0, direction.x, s.x), hn::MulAdd(t0, direction.y, s.y),
                            hn::MulAdd(t0, direction.z, s.z)};
  const V length = hn::Sub(from_start.t.upper, from_start.t.lower);
  const Vectors<D> origin = {zero, zero, zero};
  HitIntervals<D> hits(d, moved, direction, origin, difference<D>(b, a), difference<D>(c, a), length, edge_size);
  const V max_size = hn::Max(hn::Abs(hits.t.lower), hn::Abs(hits.t.upper));
  const V rounding = hn::Mul(hn::Add(hn::Abs(t0), max_size), hn::Set(d, 0x1p-51));  // R9
  const V infinity = hn::Inf(d);
  hits.t.lower = hn::IfThenElse(are_known, hn::Sub(hn::Add(t0, hits.t.lower), rounding), hn::Neg(infinity));
  hits.t.upper = hn::IfThenElse(are_known, hn::Add(hn::Add(t0, hits.t.upper), rounding), infinity);
  return hits;
}

/// Rounds hits. Looks again from moved starts if some of `lanes` are not rounded.
template <class D>
HWY_INLINE RoundedHits<D> rounded_hits(D d, PathKind kind, const Vectors<D>& start, const Vectors<D>& toward,
                                       const Vectors<D>& a, const Vectors<D>& b, const Vectors<D>& c, hn::Vec<D> t_size,
                                       hn::Vec<D> edge_size, std::uint64_t lanes) {
  const HitIntervals<D> hits(d, start, directions_of<D>(kind, start, toward), a, b, c, t_size, edge_size);
  RoundedHits<D> rounded(d, hits);
#if HWY_NATIVE_FMA != 0
  if ((lanes & ~rounded.rounded) != 0) {
    const typename RoundedHits<D>::FloatTag df;
    const RoundedHits<D> again(d, intervals_from_hits<D>(d, kind, start, toward, a, b, c, edge_size, hits));
    const auto first = mask_of(df, rounded.rounded);
    rounded.t = hn::IfThenElse(first, rounded.t, again.t);
    rounded.u = hn::IfThenElse(first, rounded.u, again.u);
    rounded.v = hn::IfThenElse(first, rounded.v, again.v);
    rounded.rounded |= again.rounded;
  }
#else
  (void)lanes;
#endif
  return rounded;
}

/// Sets a hit from the only lane of `RoundedHits` or `RoundedDoubleHits`, except for the triangle's id. Returns whether
/// its numbers are right.
template <typename Scalar, class Rounded>
HWY_INLINE bool set_hit(const Rounded& in_lane, Hit<Scalar>& hit) {
  hit.t = hn::GetLane(in_lane.t);
  hit.u = hn::GetLane(in_lane.u);
  hit.v = hn::GetLane(in_lane.v);
  hit.side = (in_lane.front & 1) != 0 ? Side::front : Side::back;
  return (in_lane.rounded & 1) != 0;
}

/// Tries to round one certain hit. Returns whether `hit` is right, without its triangle's id. The sizes are those of
/// `HitIntervals`.
HWY_INLINE bool try_round(const Path<float>& path, const Triangle<float>& triangle, float t_size, float edge_size,
                          Hit<float>& hit) {
  using Tag = hn::CappedTag<double, 1>;
  const Tag d;
  const auto lane_of = [&](const Vector3<float>& x) -> Vectors<Tag> {
    return {hn::Set(d, double{x[0]}), hn::Set(d, double{x[1]}), hn::Set(d, double{x[2]})};
  };
  const RoundedHits<Tag> rounded = rounded_hits<Tag>(d, path.kind, lane_of(path.start), lane_of(path.toward),
                                                     lane_of(triangle.a), lane_of(triangle.b), lane_of(triangle.c),
                                                     hn::Set(d, double{t_size}), hn::Set(d, double{edge_size}), 1);
  return set_hit(rounded, hit);
}

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
