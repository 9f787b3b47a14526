// Tests triangles against a moving shape, in lanes. Highway compiles this file for each instruction set.

#if defined(SUREHIT_FILTER_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_FILTER_LANES_INL
#undef SUREHIT_FILTER_LANES_INL
#else
#define SUREHIT_FILTER_LANES_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "shape/shape_filter.hpp"
#include "support/lane_bits-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// What the numbers of the lanes decide. u is half the gap from 1 to the next greater number.
template <typename Number>
struct LanePrecision {
  static constexpr double u = 0x1p-53;
  static constexpr double largest = largest_double;  ///< Sizes must be below this.
};
template <>
struct LanePrecision<float> {
  static constexpr double u = 0x1p-24;
  static constexpr double largest = largest_float;
};

/// Tests triangles in lanes of floats or doubles.
///
/// An axis m separates the shape from the triangle if all corners have a lower product with m than every centre of the
/// way. The difference must be more than the reach r |m| + c(m). Here c(m) is how far the core comes along m: 0 for a
/// point, the sum of all |m_i| h_i for a box with half extents h, and |m·h| for a segment from -h to h.
///
/// Let w be start - a, p = b - a, q = c - a and D the step. Let f = D × p, g = D × q, n = p × q and A = D·n. First come
/// f, g and f - g, which are across the step and an edge, and n. They leave out nearly all triangles, without quotients
/// and roots. The others are seen from the nearest points (V7). Of those that are left, the axes of coordinates are
/// asked, and the outward directions e × n of the edges. There and on n, the distance of the centre changes at a
/// constant rate. So the shape is near enough during one interval of t. Where these intervals do not meet, the shape
/// does not touch the triangle. It does not touch it before the latest of them begins.
///
/// A = f·q = -g·p. So the corners are at 0, 0 and A along f and along -g, and at 0, A and A along f - g.
///
/// E is the largest component of p and q, W that of w, S that of the step, H that of h, and F is W + E + r + H. Let u
/// be 2^-53 in double and 2^-24 in float.
///
/// V1. f·w is off by less than 54 u S E W, and (f - g)·w by less than 120 u S E W. A is off by less than 54 u S E².
/// n·w is off by less than 54 u E² W.
/// Proof. A difference has one rounding. So a component of f has two products of two differences each, off by 3 u of
///     itself, and the rounded difference of both: less than 8 u S E, and it is at most 2 S E. A product with a
///     component of w adds 3 u of itself. The three products and two sums are off by less than 3 (8 + 2 · 3) u S E W,
///     and 12 u S E W for the sums. The difference of f·w and g·w adds 12 u S E W. A fused multiplication has fewer
///     roundings.
///
/// V2. f, g or f - g separates if the height above the corners, less c(m) and 256 u S E F, is more than r |m|.
/// Proof. By V1, the height is off by 120 u S E W + 54 u S E², and 18 u S E (W + E) for its own rounding. The
///     components of m are off by at most 20 u S E. So r |m| is off by 35 u S E r. c(m) is off by 60 u S E H for them,
///     and by 32 u S E H for its products and sums. The differences add 12 u S E (W + E + H).
///
/// V3. n separates until t if the height above the corners, less c(n), 256 u E² F and t times the approach, is more
/// than r |n|. The approach is the rate |n·D| toward the plane, with its sign, and 256 u S E².
/// Proof. The height is off as V1 says, and A is n·D. The components of n are off by 8 u E². So r |n| is off by 14 u E²
///     r, and c(n) by 54 u E² H as n·w is.
///
/// V4. e × n separates if the height is more than r |e| |n| + c(e × n) + 1024 u E³ (F + S), at the start and at the
/// end.
/// Proof. A component of p × n is off by 2 (8 + 2 · 2) u E³, and 4 u E³ for the difference, which is 28 u E³. It is at
///     most 4 E³. The products with w have 3 u of this more, and take part in two, two and one sums. That is 3 · 28 u
///     E³ W and 11 · 4 u E³ W: less than 132 u E³ W. The third edge has q × n - p × n, whose height above b is the
///     difference of those above a, less n·n. It is off by 288 u E³ W, and n·n by 144 u E⁴. r |e| |n| is off by 16 u of
///     itself, which is below 14 r E³, and by 56 u r E³ for e and n. c(e × n) is off as the height is, with H for W.
///     The end adds D, and an error with S for W.
///
/// V5. The squares of two numbers have the order of the numbers, so V2 and V3 take no root. The product r² |m|² is off
/// by less than 16 u of itself.
/// Proof. Sizes are below `largest`, so r² |m|² is below 2^964 in double and 2^124 in float. No entry of the library
///     leaves flush-to-zero on. In float, underflow changes both squares by less than 2^-147 (1 + |m|² + r²), whose
///     root is below 2^-73 (1 + |m| + r). Let S, E and F be above 2^-18. Then 64 u S E F and 64 u E² F are above it. V2
///     and V3 have at least as much left over. In double they are above 2^-150, which covers 2^-500 (1 + |m| + r)
///     likewise.
///
/// V6. Let the height along n be at least h + c(n) + 256 u E² (F + S) at all times when the shape may touch the
/// triangle. Then V4 holds with the root of r² (n·n + 256 u E⁴) - h² in place of r |n|.
/// Proof. Let z be a point of the core that is at most r from the triangle, and beyond the plane through an edge and
///     along n. The distance beyond it and that along n belong to a triangle with a right angle. Times |n|, the latter
///     is at least h. So the square of the former, times n·n, is at most r² n·n - h². n·n is off by less than 96 u E⁴
///     for its components, and by 36 u E⁴ for products and sums. Roundings of r² and h² are in the 16 u of V5, since h
///     is at most r |n|. Both are finite, so their difference is no NaN: h² is below 2^968 in double and 2^128 in
///     float. Underflow changes the root by less than 2^-73 (1 + |n| + r), and 1024 u E² F is above it.
///
/// V7. Let m be any three numbers of a lane, and M the largest of their sizes. Let the centre come back by x along m
/// until a limit. Then m separates if the height is more than r |m| + c(m) + x + 64 u (F + M) (F + S).
/// Proof. m is what is in the lane, so it has no error. w, p, q and D have one rounding for each component, which
///     changes their products with m by 3 u M of their sizes. Products and sums of three add 9 u M of them. So m·w is
///     off by 12 u M W, the corners are by 12 u M E, and c(m) is by 9 u M H. The way until the limit is off by 18 u M S
///     with the rounded limit and its product. Four sums of all of these add 12 u M (F + S). Underflow is below the
///     bound as in V5. If the square of the gap overflows and the other one does not, the gap is larger. A step that
///     nearly vanishes may make m huge. Where a product of m overflows, so does the bound, and nothing separates. If m
///     is not finite, m·w less the bound is no number above 0. A maximum may lose a NaN, but neither of these is one.
///
/// One such m is the way from corner a to the nearest point of the core at the start. Another is what is left of it
/// across the step. They tell small triangles from large shapes, where edges and the normal hardly do.
///
/// On an axis of coordinates, the heights are off by less than 16 u (W + E + S). The reach r + h_i has one rounding,
/// and counts only if it is less than W + E + S.
///
/// Coordinates outside of the sizes of `LanePrecision` may underflow or overflow. Then the axes of coordinates alone
/// are asked.
///
/// On the axes of coordinates, a product with one over the step takes the place of a quotient. Where the step or its
/// inverse might be infinite, the inverse is a NaN. Then only a constant distance counts. A time that is above 0 is at
/// least 2^-50, so none underflows: its height is more than 8 u S above the reach, and falls by at most 2 S.
template <typename Scalar, typename Number, Core core>
class FilterLanes {
  using Tag = hn::ScalableTag<Number>;
  static constexpr Tag d{};
  using V = hn::Vec<Tag>;
  using Mask = hn::Mask<Tag>;
  using Precision = LanePrecision<Number>;
  using Numbers = ShapeNumbers<Number>;
  using Point = V[3];

 public:
  static std::uint64_t find(const Numbers& shape, const Scalar* corners, std::size_t count, std::size_t from,
                            double limit, double* enters) {
    const std::size_t last = std::min(count, from + ShapeFilter<Scalar>::max_count);
    const V until = until_limit(limit);
    std::uint64_t found = 0;
    for (std::size_t at = from; at < last; at += hn::Lanes(d)) {
      found |= test(shape, corners + at, count, until, enters + (at - from)) << (at - from);
    }
    return found & first_bits(last - from);
  }
  /// Tests a list as `ShapeFilter::find_near` does, while `near` has room.
  static HWY_INLINE void find_near(const Numbers& shape, ShapeList<Scalar>& list, std::size_t index,
                                   std::span<NearTriangles> near, std::size_t& count) {
    const V until = until_limit(list.limit);
    for (; list.from < list.last && count < near.size(); list.from += hn::Lanes(d)) {
      const Terms terms(shape, list.corners + list.from, list.count);
      const std::uint64_t found =
          ~bits_of(d, are_apart(shape, terms, until)) & first_bits(hn::Lanes(d)) & first_bits(list.last - list.from);
      near[count] = {index, list.from, found};
      count += found != 0 ? 1 : 0;
    }
  }
  /// Does what `ShapeFilter::find_times` does.
  static std::uint64_t find_times(const Numbers& shape, const ShapeList<Scalar>& list, const NearTriangles& near,
                                  double limit, double* enters) {
    return test_intervals(shape, list.corners + near.from, list.count, mask_of(d, ~near.found), until_limit(limit),
                          enters);
  }

 private:
  /// Returns so many bits, or all.
  static std::uint64_t first_bits(std::size_t count) {
    return count < 64 ? (std::uint64_t{1} << count) - 1 : ~std::uint64_t{0};
  }
  /// A limit that is rounded is within the errors of V3 and of the times. The smallest times always count.
  static HWY_INLINE V until_limit(double limit) { return set(static_cast<Number>(std::max(limit, 0x1p-100))); }
  static HWY_INLINE V load(const Scalar* from) {
    if constexpr (std::is_same_v<Scalar, Number>) {
      return hn::LoadU(d, from);
    } else {
      return hn::PromoteTo(d, hn::LoadU(hn::Rebind<Scalar, Tag>(), from));
    }
  }
  static HWY_INLINE V set(Number x) { return hn::Set(d, x); }
  static HWY_INLINE V errors(double count) { return set(static_cast<Number>(count * Precision::u)); }
  static HWY_INLINE V dot(const Point& x, const Point& y) {
    return hn::MulAdd(x[0], y[0], hn::MulAdd(x[1], y[1], hn::Mul(x[2], y[2])));
  }
  static HWY_INLINE void cross(const Point& x, const Point& y, Point& out) {
    out[0] = hn::MulSub(x[1], y[2], hn::Mul(x[2], y[1]));
    out[1] = hn::MulSub(x[2], y[0], hn::Mul(x[0], y[2]));
    out[2] = hn::MulSub(x[0], y[1], hn::Mul(x[1], y[0]));
  }
  static HWY_INLINE void subtract(const Point& x, const Point& y, Point& out) {
    for (std::size_t i = 0; i < 3; ++i) out[i] = hn::Sub(x[i], y[i]);
  }
  /// Returns how far the core comes along m.
  static HWY_INLINE V reach_of_core(const Point& m, const Numbers& shape) {
    if constexpr (core == Core::point) return hn::Zero(d);
    const Point half = {set(shape.half[0]), set(shape.half[1]), set(shape.half[2])};
    if constexpr (core == Core::segment) return hn::Abs(dot(m, half));
    const Point sizes = {hn::Abs(m[0]), hn::Abs(m[1]), hn::Abs(m[2])};
    return dot(sizes, half);
  }
  static HWY_INLINE V size_of(const Point& x) { return hn::Max(hn::Max(hn::Abs(x[0]), hn::Abs(x[1])), hn::Abs(x[2])); }

  /// The interval of t in which the shape may touch a triangle.
  struct Interval {
    V enters, leaves;
    Mask beside;  ///< The lanes that a constant distance keeps apart.

    /// Returns the lanes that have nothing of the interval before a limit.
    HWY_INLINE Mask outside_before(V limit) const {
      return hn::Or(beside, hn::Or(hn::Gt(enters, leaves), hn::Gt(enters, limit)));
    }
    /// Cuts the interval to where a height that begins at `first` and grows by `rate` is at most `reach`.
    HWY_INLINE void keep_below(V first, V rate, V reach) {
      const V above = hn::Sub(first, reach);
      keep_until(hn::Div(above, hn::Neg(rate)), above, hn::Add(above, rate));
    }
    /// Does the same for a rate that all triangles share, where `inverse` is one over it, negated.
    HWY_INLINE void keep_below(V first, V rate, V reach, V inverse) {
      const V above = hn::Sub(first, reach);
      keep_until(hn::Mul(above, inverse), above, hn::Add(above, rate));
    }

   private:
    /// Cuts the interval at t, where a height passes the reach. It is above the reach by `first` at t = 0 and by `last`
    /// at t = 1.
    HWY_INLINE void keep_until(V t, V first, V last) {
      const V zero = hn::Zero(d);
      const Mask starts_above = hn::Gt(first, zero);
      const Mask ends_above = hn::Gt(last, zero);
      beside = hn::Or(beside, hn::And(starts_above, ends_above));
      // t has four roundings at most. A 0 / 0 is a NaN, and comparisons skip it.
      const V in = hn::Mul(t, set(static_cast<Number>(1 - 16 * Precision::u)));
      const V out = hn::Mul(t, set(static_cast<Number>(1 + 16 * Precision::u)));
      enters = hn::IfThenElse(hn::And(hn::AndNot(ends_above, starts_above), hn::Gt(in, enters)), in, enters);
      leaves = hn::IfThenElse(hn::And(hn::AndNot(starts_above, ends_above), hn::Lt(out, leaves)), out, leaves);
    }
  };

  /// A vector of triangles, seen from the shape.
  struct Terms {
    Point p, q, w, n, step;
    V size;    ///< E
    V far;     ///< F
    V height;  ///< n·w
    V rate;    ///< n·D
    V nn;      ///< n·n
    Mask is_usable;

    HWY_INLINE Terms(const Numbers& shape, const Scalar* corners, std::size_t count) {
      for (std::size_t i = 0; i < 3; ++i) {
        const V a = load(corners + i * count);
        w[i] = hn::Sub(set(shape.start[i]), a);
        p[i] = hn::Sub(load(corners + (3 + i) * count), a);
        q[i] = hn::Sub(load(corners + (6 + i) * count), a);
        step[i] = set(shape.step[i]);
      }
      size = hn::Max(size_of(p), size_of(q));
      far = hn::Add(hn::Add(size_of(w), size), set(shape.size));
      cross(p, q, n);
      height = dot(n, w);
      rate = dot(n, step);
      nn = dot(n, n);
      is_usable = hn::And(hn::Gt(hn::Min(size, far), set(shape.smallest)),
                          hn::Lt(far, set(static_cast<Number>(Precision::largest))));
    }
  };

  /// Returns a bit for each triangle that the shape may touch.
  static HWY_INLINE std::uint64_t test(const Numbers& shape, const Scalar* corners, std::size_t count, V limit,
                                       double* enters) {
    const Terms terms(shape, corners, count);
    const Mask apart = are_apart(shape, terms, limit);
    if (hn::AllTrue(d, apart)) return 0;
    return test_intervals(shape, corners, count, apart, limit, enters);
  }

  /// Returns the lanes that the first tests leave out. Quotients are for those that come that far.
  static HWY_INLINE Mask are_apart(const Numbers& shape, const Terms& terms, V limit) {
    Mask apart = hn::Or(are_apart_across(shape, terms), are_apart_until(shape, terms, limit));
    if (!hn::AllTrue(d, apart)) apart = hn::Or(apart, are_apart_between_points(shape, terms, limit));
    return hn::And(terms.is_usable, apart);
  }

  /// Returns the lanes where f, g or f - g separates (V2).
  static HWY_INLINE Mask are_apart_across(const Numbers& shape, const Terms& terms) {
    Point f, g, h;
    cross(terms.step, terms.p, f);
    cross(terms.step, terms.q, g);
    subtract(f, g, h);
    const V along_f = dot(f, terms.w);
    const V along_g = hn::Neg(dot(g, terms.w));
    const V across = dot(f, terms.q);
    const V low = hn::Min(across, hn::Zero(d));
    const V high = hn::Max(across, hn::Zero(d));
    const V error = hn::Mul(hn::Mul(set(shape.size_of_step), terms.size), hn::Mul(terms.far, errors(256)));
    const V square = set(shape.squared_radius);
    const auto separates = [&](const Point& m, V height) HWY_ATTR {
      const V gap = hn::Max(hn::Sub(low, height), hn::Sub(height, high));
      return is_above_root(hn::Sub(gap, hn::Add(error, reach_of_core(m, shape))), hn::Mul(square, dot(m, m)));
    };
    return hn::Or(hn::Or(separates(f, along_f), separates(g, along_g)), separates(h, hn::Add(along_f, along_g)));
  }

  /// Returns the lanes where n separates until a limit (V3).
  static HWY_INLINE Mask are_apart_until(const Numbers& shape, const Terms& terms, V limit) {
    const V size_2 = hn::Mul(terms.size, terms.size);
    const V error = hn::Mul(size_2, hn::Mul(terms.far, errors(256)));
    const V of_rate = hn::Mul(size_2, hn::Mul(set(shape.size_of_step), errors(256)));
    const V approach = hn::Sub(of_rate, hn::CopySignToAbs(hn::Abs(terms.rate), hn::Xor(terms.rate, terms.height)));
    const V comes = hn::Max(hn::Mul(limit, approach), hn::Zero(d));
    const V gap = hn::Sub(hn::Abs(terms.height), hn::Add(error, reach_of_core(terms.n, shape)));
    return is_above_root(hn::Sub(gap, comes), hn::Mul(set(shape.squared_radius), terms.nn));
  }

  /// Returns the lanes where the way from a corner to the core separates until a limit, or what is left of it across
  /// the step (V7).
  static HWY_INLINE Mask are_apart_between_points(const Numbers& shape, const Terms& terms, V limit) {
    Point m;
    set_way_to_core(shape, terms.w, m);
    const V along = hn::Div(dot(m, terms.step), dot(terms.step, terms.step));
    const Point across = {hn::NegMulAdd(along, terms.step[0], m[0]), hn::NegMulAdd(along, terms.step[1], m[1]),
                          hn::NegMulAdd(along, terms.step[2], m[2])};
    return hn::Or(is_apart_along(m, shape, terms, limit), is_apart_along(across, shape, terms, limit));
  }
  /// Sets `way` to that from corner a to the nearest point of the core, rounded.
  static HWY_INLINE void set_way_to_core(const Numbers& shape, const Point& w, Point& way) {
    if constexpr (core == Core::segment) {
      const Point half = {set(shape.half[0]), set(shape.half[1]), set(shape.half[2])};
      const V one = set(1);
      const V place = hn::Max(hn::Min(hn::Div(dot(w, half), dot(half, half)), one), hn::Neg(one));
      for (std::size_t i = 0; i < 3; ++i) way[i] = hn::NegMulAdd(place, half[i], w[i]);
    } else {
      for (std::size_t i = 0; i < 3; ++i) {
        const V beyond = hn::Max(hn::Sub(hn::Abs(w[i]), set(shape.half[i])), hn::Zero(d));
        way[i] = hn::CopySign(beyond, w[i]);
      }
    }
  }
  /// Returns the lanes where m separates until a limit (V7).
  static HWY_INLINE Mask is_apart_along(const Point& m, const Numbers& shape, const Terms& terms, V limit) {
    const V zero = hn::Zero(d);
    const V highest = hn::Max(hn::Max(dot(m, terms.p), dot(m, terms.q)), zero);
    const V comes = hn::Max(hn::Neg(hn::Mul(limit, dot(m, terms.step))), zero);
    const V size = hn::Add(terms.far, size_of(m));
    const V error = hn::Mul(hn::Mul(size, hn::Add(terms.far, set(shape.size_of_step))), errors(64));
    const V gap = hn::Sub(hn::Sub(dot(m, terms.w), highest), hn::Add(error, reach_of_core(m, shape)));
    return is_above_root(hn::Sub(gap, comes), hn::Mul(set(shape.squared_radius), dot(m, m)));
  }

  /// Returns the lanes where x is certainly above the root of `square` (V5).
  static HWY_INLINE Mask is_above_root(V x, V square) {
    return hn::And(hn::Gt(x, hn::Zero(d)), hn::Gt(hn::Mul(x, x), square));
  }

  /// Does what `test` does, for lanes that are not apart yet. It also sets when the shape may enter them. It computes
  /// the terms anew, because `test` would have to keep them in memory.
  static HWY_NOINLINE std::uint64_t test_intervals(const Numbers& shape, const Scalar* corners, std::size_t count,
                                                   Mask apart, V limit, double* enters) {
    const Terms terms(shape, corners, count);
    Interval interval{hn::Zero(d), set(1), apart};
    const Point& p = terms.p;
    const Point& q = terms.q;
    const V zero = hn::Zero(d);
    const V slack = hn::Mul(hn::Add(terms.far, set(shape.size_of_step)), errors(16));
    for (std::size_t i = 0; i < 3; ++i) {
      const V lowest = hn::Sub(terms.w[i], hn::Max(hn::Max(p[i], q[i]), zero));
      const V highest = hn::Sub(terms.w[i], hn::Min(hn::Min(p[i], q[i]), zero));
      const V reach = hn::Add(set(shape.reach[i]), slack);
      const V inverse = set(shape.inverse_step[i]);
      interval.keep_below(lowest, terms.step[i], reach, hn::Neg(inverse));
      interval.keep_below(hn::Neg(highest), hn::Neg(terms.step[i]), reach, inverse);
    }
    Interval tilted = interval;
    const V size_2 = hn::Mul(terms.size, terms.size);
    const V far = hn::Add(terms.far, set(shape.size_of_step));
    V reach_beside;  // V6
    {
      const V of_core = hn::MulAdd(hn::Mul(size_2, far), errors(256), reach_of_core(terms.n, shape));
      const V reach = hn::MulAdd(set(shape.grown_radius), hn::Sqrt(terms.nn), of_core);
      tilted.keep_below(terms.height, terms.rate, reach);
      tilted.keep_below(hn::Neg(terms.height), hn::Neg(terms.rate), reach);
      const V first = hn::MulAdd(terms.rate, tilted.enters, terms.height);
      const V last = hn::MulAdd(terms.rate, tilted.leaves, terms.height);
      const V lowest = hn::Max(hn::Min(first, last), hn::Neg(hn::Max(first, last)));
      const V gap = hn::Max(hn::Sub(lowest, of_core), zero);
      const V square = hn::Mul(set(shape.squared_radius), hn::MulAdd(hn::Mul(size_2, size_2), errors(256), terms.nn));
      reach_beside = hn::Sqrt(hn::Max(hn::NegMulAdd(gap, gap, square), zero));
    }
    const V error = hn::Mul(hn::Mul(size_2, terms.size), hn::Mul(far, errors(1024)));
    const auto keep_inside = [&](const Point& e, const Point& outward, V height, V rate) HWY_ATTR {
      const V of_ball = hn::MulAdd(reach_beside, hn::Sqrt(dot(e, e)), error);
      tilted.keep_below(height, rate, hn::Add(of_ball, reach_of_core(outward, shape)));
    };
    Point of_p, of_q, of_third, third;
    cross(p, terms.n, of_p);
    cross(q, terms.n, of_q);
    const V height_p = dot(of_p, terms.w);
    const V height_q = dot(of_q, terms.w);
    const V rate_p = dot(of_p, terms.step);
    const V rate_q = dot(of_q, terms.step);
    keep_inside(p, of_p, height_p, rate_p);
    keep_inside(q, of_q, hn::Neg(height_q), hn::Neg(rate_q));
    subtract(q, p, third);
    subtract(of_q, of_p, of_third);
    keep_inside(third, of_third, hn::Sub(hn::Sub(height_q, height_p), terms.nn), hn::Sub(rate_q, rate_p));
    interval.enters = hn::IfThenElse(terms.is_usable, tilted.enters, interval.enters);
    interval.leaves = hn::IfThenElse(terms.is_usable, tilted.leaves, interval.leaves);
    interval.beside = hn::Or(interval.beside, hn::And(terms.is_usable, tilted.beside));
    Number times[HWY_MAX_BYTES / sizeof(Number)];
    hn::StoreU(interval.enters, d, times);
    std::copy_n(times, hn::Lanes(d), enters);
    return ~bits_of(d, interval.outside_before(limit)) & ((std::uint64_t{1} << hn::Lanes(d)) - 1);
  }
};

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
