// Rounds t, u and v of hits in double. Highway compiles this for each instruction set.

#if defined(SUREHIT_DOUBLE_HIT_ROUNDING_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_DOUBLE_HIT_ROUNDING_INL
#undef SUREHIT_DOUBLE_HIT_ROUNDING_INL
#else
#define SUREHIT_DOUBLE_HIT_ROUNDING_INL
#endif

#include <hwy/highway.h>

#include <array>
#include <cstdint>

#include "filter/double_kernel-inl.hpp"
#include "filter/double_word-inl.hpp"
#include "filter/hit_rounding-inl.hpp"
#include "support/lane_bits-inl.hpp"
#include "surehit/hit.hpp"
#include "surehit/path.hpp"
#include "surehit/triangle.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// Quotients t, u and v of a certain hit in each lane, with their bounds. All coordinates are doubles, and the
/// arithmetic is in double words.
///
/// The names are those of kernel_bound.hpp, with eps = 2^-53. The sizes d, e, f and s must be at most 2^200, and all
/// computed determinants at least 2^-700.
///
/// D1. A computed determinant is off by at most 2^-98 times its product of sizes.
/// Proof. The differences of coordinates are exact (DW1). Let x and y be the sizes of two factors of a cross product.
///     By DW3 and DW2, a component is off by 7 eps^2 of each product and 3.1 eps^2 of their sum.
///     This is 20.2 eps^2 x y. It is at most 2 x y in size. Let z be the size of the third factor.
///     Each of the three products with it is off by (7 · 2 + 20.2) eps^2 x y z, and these are 102.6 eps^2 x y z.
///     The two sums are at most 4 x y z and 6 x y z, and they add 31 eps^2 x y z.
///     Together, this is below 134 eps^2, and 2^-98 = 256 eps^2. The sizes are those of the high parts, off by eps.
///     By K3, x y z is at least 2^-703, and 2^-98 of it is at least 2^-801. Underflow adds less than 2^-1060 times a
///     size, and this is at most 2^-860.
///
/// D2. Let n and m be computed determinants, with the bounds r_n and r_m, and let m be the det. Let q0 be the quotient
///     of their high parts, and q1 the computed quotient of n - q0 m. Let B = 2^-98 |q0| + 2 (r_n + |q0| r_m) / |m|.
///     If B is below 2^-40 |q0|, then N / M is within B of q0 + q1.
/// Proof. By K10, N / M is within (r_n + |n / m| r_m) / (|m| - r_m) of n / m. Here r_m is below 2^-41 |m|.
///     So the factor 2 covers |m| - r_m, and that q0 and the inverse are rounded.
///     The product q0 m is within 4 eps |n| of n. So the high parts differ by at most 6 eps |n|, exactly (Sterbenz).
///     The other three terms of n - q0 m are at most eps |n| each. All sums and the product with the low part of m are
///     rounded, by 15 eps^2 |n| together. Then |q1| is at most 9 eps |q0|, and the inverse and its product add
///     27 eps^2 |q0|. The ends q0 + (q1 - B) and q0 + (q1 + B) have one rounding more, of at most 10 eps^2 |q0|.
///     Together, this is below 64 eps^2 |q0|, and 2^-98 = 256 eps^2.
///     The product does not underflow, because it is close to n. Nor does the quotient, if |q0| is at least 2^-900.
template <class D>
struct DoubleHitIntervals {
  using V = hn::Vec<D>;
  using Words = DoubleWords<D>;
  /// The exact quotient is within `bound` of high + low, if `known` is true and `bound` is below 2^-40 |high|.
  struct Interval {
    V high, low, bound;
  };

  HWY_INLINE DoubleHitIntervals(D d, PathKind kind, const Vectors<D>& start, const Vectors<D>& toward,
                                const Vectors<D>& a, const Vectors<D>& b, const Vectors<D>& c) {
    const WordVector e1 = difference(b, a);
    const WordVector e2 = difference(c, a);
    const WordVector s = difference(start, a);
    const V zero = hn::Zero(d);
    const WordVector direction = kind == PathKind::segment
                                     ? difference(toward, start)
                                     : WordVector{{{{toward.x, zero}, {toward.y, zero}, {toward.z, zero}}}};
    const V d_size = direction.size(), e1_size = e1.size(), e2_size = e2.size(), s_size = s.size();
    const WordVector p = cross(direction, e2);
    const WordVector q = cross(s, e1);
    const Words det = dot(e1, p);
    const V max_size = hn::Max(hn::Max(d_size, s_size), hn::Max(e1_size, e2_size));
    const V relative = hn::Set(d, 0x1p-98);
    const V edge_sizes = hn::Mul(hn::Mul(e1_size, e2_size), relative);
    const V side_sizes = hn::Mul(hn::Mul(s_size, d_size), relative);
    const V det_bound = hn::Mul(edge_sizes, d_size);  // D1, as the bounds below
    const V min_determinant = hn::Set(d, 0x1p-700);
    known = hn::And(hn::Le(max_size, hn::Set(d, 0x1p200)), hn::Ge(hn::Abs(det.high), min_determinant));
    const V inverse = hn::Div(hn::Set(d, 1), det.high);
    const auto quotient = [&](const Words& numerator, V numerator_bound) -> Interval {  // D2
      const V q0 = hn::Mul(numerator.high, inverse);
      const V q0_size = hn::Abs(q0);
      const Words product = Words::exact_product(q0, det.high);
      const V high = hn::Sub(numerator.high, product.high);
      const V low = hn::Sub(hn::Sub(numerator.low, product.low), hn::Mul(q0, det.low));
      const V q1 = hn::Mul(hn::Add(high, low), inverse);
      const V twice = hn::Abs(hn::Add(inverse, inverse));
      known = hn::And(known, hn::Ge(hn::Abs(numerator.high), min_determinant));
      known = hn::And(known, hn::Ge(q0_size, hn::Set(d, 0x1p-900)));
      return {q0, q1, hn::MulAdd(q0_size, relative, hn::Mul(hn::MulAdd(q0_size, det_bound, numerator_bound), twice))};
    };
    t = quotient(dot(e2, q), hn::Mul(edge_sizes, s_size));
    u = quotient(dot(s, p), hn::Mul(side_sizes, e2_size));
    v = quotient(dot(direction, q), hn::Mul(side_sizes, e1_size));
    is_front = hn::Gt(det.high, zero);
  }

  Interval t, u, v;
  hn::Mask<D> known;     ///< The lanes with sizes for which D1 and D2 hold.
  hn::Mask<D> is_front;  ///< The lanes whose path arrives at the front.

 private:
  struct WordVector {
    std::array<Words, 3> of;

    [[nodiscard]] HWY_INLINE V size() const {
      return hn::Max(hn::Max(hn::Abs(of[0].high), hn::Abs(of[1].high)), hn::Abs(of[2].high));
    }
  };

  HWY_INLINE static WordVector difference(const Vectors<D>& x, const Vectors<D>& y) {
    return {{Words::exact_sum(x.x, hn::Neg(y.x)), Words::exact_sum(x.y, hn::Neg(y.y)),
             Words::exact_sum(x.z, hn::Neg(y.z))}};
  }
  HWY_INLINE static WordVector cross(const WordVector& x, const WordVector& y) {
    const auto component = [&](std::size_t j, std::size_t k) { return x.of[j] * y.of[k] - x.of[k] * y.of[j]; };
    return {{component(1, 2), component(2, 0), component(0, 1)}};
  }
  HWY_INLINE static Words dot(const WordVector& x, const WordVector& y) {
    return x.of[0] * y.of[0] + x.of[1] * y.of[1] + x.of[2] * y.of[2];
  }
};

/// The rounded hits. As in R5, a hit is rounded if both ends of each interval round to the same double. Then the bounds
/// are at most a few eps times the quotients, as D2 requires.
template <class D>
struct RoundedDoubleHits {
  using V = hn::Vec<D>;

  HWY_INLINE RoundedDoubleHits(D d, const DoubleHitIntervals<D>& hits) {
    auto are_rounded = hits.known;
    const auto round = [&](const typename DoubleHitIntervals<D>::Interval& interval) {
      const V upper = hn::Add(interval.high, hn::Add(interval.low, interval.bound));
      const V lower = hn::Add(interval.high, hn::Sub(interval.low, interval.bound));
      are_rounded = hn::And(are_rounded, hn::Eq(lower, upper));
      return upper;
    };
    t = round(hits.t);
    u = round(hits.u);
    v = round(hits.v);
    rounded = bits_of(d, are_rounded);
    front = bits_of(d, hits.is_front);
  }

  V t, u, v;
  std::uint64_t rounded;  ///< The mask of the lanes in which t, u and v are right.
  std::uint64_t front;    ///< The mask of the lanes whose path arrives at the front.
};

/// Tries to round one hit that the kernel is certain of. Returns whether `hit` is right, without its triangle's id.
HWY_INLINE bool try_round(const Path<double>& path, const Triangle<double>& triangle, Hit<double>& hit) {
  using Tag = hn::CappedTag<double, 1>;
  const auto lane_of = [](const Vector3<double>& x) -> Vectors<Tag> {
    return {hn::Set(Tag(), x[0]), hn::Set(Tag(), x[1]), hn::Set(Tag(), x[2])};
  };
  const DoubleHitIntervals<Tag> intervals(Tag(), path.kind, lane_of(path.start), lane_of(path.toward),
                                          lane_of(triangle.a), lane_of(triangle.b), lane_of(triangle.c));
  return set_hit(RoundedDoubleHits<Tag>(Tag(), intervals), hit);
}

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
