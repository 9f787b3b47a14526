// The last step to a hit, for the instruction set that Highway compiles this for.

#if defined(SUREHIT_HIT_ROUNDING_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_HIT_ROUNDING_INL
#undef SUREHIT_HIT_ROUNDING_INL
#else
#define SUREHIT_HIT_ROUNDING_INL
#endif

#include <cstdint>

#include "filter/double_kernel-inl.hpp"
#include "query/lane_bits-inl.hpp"
#include "surehit/hit.hpp"
#include "surehit/path.hpp"
#include "surehit/triangle.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// Of triangles that the paths are known to meet, coordinates all floats, one in each lane: where t, u and v are, with
/// one division for all of them.
///
/// Here u is the unit roundoff, and x and y are the coordinates u and v; d is the largest component of D, e that of E1
/// and E2 but for a rounding to float. By kernel_bound.hpp, the computed det is off by at most 48 u d e e, U and V by
/// 48 u s d e, T by 48 u s e e; of floats, no product here underflows or overflows. How large S may be follows from the
/// hit: S = x E1 + y E2 - t D, where x and y are not negative and together at most 1, so that s <= |t| d + e. With q
/// the exact quotient of N and det, and n and m what is computed of these,
///     |q - n / m| = |(N - n) - q (det - m)| / |m|,
/// and |q| <= 1 for x and y: these are off by no more than 48 u d e (|t| d + 2 e) / |m|, t by no more than
/// 48 u e e (2 |t| d + e) / |m|. The inverse, its product and the sum with the bound are each rounded once, by u |q|.
/// No |m| exceeds 6 d e e but for roundings, so that 12 u in the place of the 48 u are 4 u |q| or more: 60 u hold all,
/// and 66 u what d, e and the bound itself are rounded by.
template <class D>
struct HitIntervals {
  using V = hn::Vec<D>;
  struct Interval {
    V lower, upper;
  };

  /// `t_size` is no less than any |t|, or infinite, and then nothing is known.
  HWY_INLINE HitIntervals(D d, const Vectors<D>& start, const Vectors<D>& direction, const Vectors<D>& a,
                          const Vectors<D>& b, const Vectors<D>& c, V t_size, V edge_size) {
    const DoubleDeterminants<D> of(d, start, direction, a, b, c);
    det = of.det;
    const V way = hn::Mul(t_size, of.d_size);
    const V share = hn::Mul(edge_size, hn::Set(d, KernelBound<double>::relative));
    const V of_side = hn::Mul(hn::Mul(share, of.d_size), hn::Add(way, hn::Add(edge_size, edge_size)));
    const V of_height = hn::Mul(hn::Mul(share, edge_size), hn::Add(hn::Add(way, way), edge_size));
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

/// The same hits, rounded: those of which all three intervals round to one float each (Ziv 1991).
template <class D>
struct RoundedHits {
  using FloatTag = hn::Rebind<float, D>;
  using Floats = hn::Vec<FloatTag>;

  HWY_INLINE RoundedHits(D d, const HitIntervals<D>& hits) {
    const FloatTag df;
    const auto round = [&](const typename HitIntervals<D>::Interval& interval, Floats& rounded_value) {
      rounded_value = hn::Add(hn::DemoteTo(df, interval.upper), hn::Zero(df));  // a zero is +0
      return hn::Eq(hn::DemoteTo(df, interval.lower), rounded_value);
    };
    const auto is_t = round(hits.t, t);
    const auto is_u = round(hits.u, u);
    const auto is_v = round(hits.v, v);
    rounded = bits_of(df, hn::And(is_t, hn::And(is_u, is_v)));
    front = bits_of(d, hn::Gt(hits.det, hn::Zero(d)));
  }

  Floats t, u, v;
  std::uint64_t rounded;  ///< lanes in which these are right
  std::uint64_t front;    ///< lanes whose path arrives in front
};

/// Of a triangle that the path is known to meet, with sizes as above. All but its id.
HWY_INLINE bool try_round(const Path<float>& path, const Triangle<float>& triangle, float t_size, float edge_size,
                          Hit<float>& hit) {
  using Tag = hn::CappedTag<double, 1>;
  const Tag d;
  const auto lane_of = [&](const Vector3<float>& x) -> Vectors<Tag> {
    return {hn::Set(d, double{x[0]}), hn::Set(d, double{x[1]}), hn::Set(d, double{x[2]})};
  };
  const auto start = lane_of(path.start);
  auto direction = lane_of(path.toward);
  if (path.has_end()) {
    direction = {hn::Sub(direction.x, start.x), hn::Sub(direction.y, start.y), hn::Sub(direction.z, start.z)};
  }
  const HitIntervals<Tag> intervals(d, start, direction, lane_of(triangle.a), lane_of(triangle.b), lane_of(triangle.c),
                                    hn::Set(d, double{t_size}), hn::Set(d, double{edge_size}));
  const RoundedHits<Tag> hits(d, intervals);
  hit.t = hn::GetLane(hits.t);
  hit.u = hn::GetLane(hits.u);
  hit.v = hn::GetLane(hits.v);
  hit.side = (hits.front & 1) != 0 ? Side::front : Side::back;
  return (hits.rounded & 1) != 0;
}

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
