#include "shape/shape_filter.hpp"

#include "support/rounding_flags.hpp"

// This file is compiled once for each instruction set. The best one is chosen when the first list is asked.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shape/shape_filter.cpp"
#include <hwy/foreach_target.h>
// These must come after foreach_target.h.
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "support/lane_bits-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// What the numbers of the lanes decide. u is half the gap from 1 to the next greater number.
template <typename Number>
struct LanePrecision {
  static constexpr double u = 0x1p-53;
  static constexpr double smallest = 0x1p-150;  ///< Sizes must be above this,
  static constexpr double largest = 0x1p200;    ///< and below this.
};
template <>
struct LanePrecision<float> {
  static constexpr double u = 0x1p-24;
  static constexpr double smallest = ShapeFilter<float>::smallest_float;
  static constexpr double largest = ShapeFilter<float>::largest_float;
};

/// Tests triangles in lanes of floats or doubles.
///
/// An axis m separates the shape from the triangle if all corners have a lower product with m than every centre of the
/// way has, by more than the reach r |m| + c(m). Here c(m) is how far the core comes along m: 0 for a point, the sum of
/// all |m_i| h_i for a box with half extents h, and |m·h| for a segment from -h to h. The axes are the normal n, the
/// outward directions e × n of the edges, the directions D × e across the step and an edge, and the axes of
/// coordinates. On most of them, the distance of the centre changes at a constant rate, so the shape is near enough
/// during one interval of t. Where these intervals do not meet, the shape does not touch the triangle. It does not
/// touch it before the latest of them begins.
///
/// E is the largest component of an edge, W that of a centre less a corner, H that of h, and S that of
/// the step. Let u be 2^-53 in double and 2^-24 in float.
///
/// V1. n·w is off by less than 54 u E² W, D·n by as much with S for W, and (D × e)·w by less than 54 u S E W.
/// Proof. A difference has one rounding. So a component of n has two products of two differences each, off by 3 u of
///     itself, and the rounded difference of both: less than 8 u E², and it is at most 2 E². A product with a
///     component of w adds 3 u of itself. The three products and two sums are off by less than 3 (8 + 2 · 3) u E² W,
///     and 12 u E² W for the sums.
///
/// V2. (e × n)·w is off by less than 132 u E³ W.
/// Proof. A component of e × n is off by 2 (8 + 2 · 2) u E³, and 4 u E³ for the difference, which is 28 u E³. It is at
///     most 4 E³. The products with w have 3 u of this more, and take part in two, two and one sums. That is 3 · 28 u
///     E³ W and (4 + 4 + 3) 4 u E³ W, or 128 u E³ W in all.
///
/// V3. r |m| is off by less than 16 u of itself, and by r times what the components of m are off, for the axes above.
///     |e × n| is |e| |n|, because n is across e.
///
/// V4. c(m) is off by what V1 and V2 say of m·w, with H for W. It is a sum of the same products.
///
/// So a reach of r |m| (1 + 256 u) + c(m) + 256 u B (W + r + H) is enough, where B is E² for n, E³ for e × n and S E
/// for D × e. On an axis of coordinates, the reach r + h_i has one rounding, and counts only if it is less than W.
///
/// Coordinates outside of the sizes of `LanePrecision` may underflow or overflow, and are not tested. Let E, W + r + H
/// and S be inside, or S be 0. In double, the products of all sizes are above 2^-1000. In float, a product that
/// underflows is off by at most 2^-149, and the root of a sum of squares by at most 2^-73. All terms with u are larger:
/// 256 u E² r is the least one that has to cover a root of n·n, and 256 u S E r one of f·f.
///
/// On the axes of coordinates, a product with one over the step takes the place of a quotient. Where the step or its
/// inverse might be infinite, the inverse is a NaN. Then only a constant distance counts. A time that is above 0 is at
/// least 2^-50, so none underflows: its height is more than 8 u W above the reach, and falls by at most 2 W.
template <typename Scalar, typename Number, Core core>
class FilterLanes {
  using Tag = hn::ScalableTag<Number>;
  static constexpr Tag d{};
  using V = hn::Vec<Tag>;
  using Mask = hn::Mask<Tag>;
  using Precision = LanePrecision<Number>;
  using Point = V[3];

 public:
  static std::uint64_t find(const ShapeFilter<Scalar>& shape, const Scalar* corners, std::size_t count,
                            std::size_t from, double limit, double* enters) {
    const std::size_t last = std::min(count, from + ShapeFilter<Scalar>::max_count);
    std::uint64_t found = 0;
    for (std::size_t at = from; at < last; at += hn::Lanes(d)) {
      found |= test(shape, corners + at, count, limit, enters + (at - from)) << (at - from);
    }
    return last - from == 64 ? found : found & ((std::uint64_t{1} << (last - from)) - 1);
  }

 private:
  static HWY_INLINE V load(const Scalar* from) {
    if constexpr (std::is_same_v<Scalar, Number>) {
      return hn::LoadU(d, from);
    } else {
      return hn::PromoteTo(d, hn::LoadU(hn::Rebind<Scalar, Tag>(), from));
    }
  }
  static HWY_INLINE V set(double x) { return hn::Set(d, static_cast<Number>(x)); }
  static HWY_INLINE V dot(const Point& x, const Point& y) {
    return hn::Add(hn::Add(hn::Mul(x[0], y[0]), hn::Mul(x[1], y[1])), hn::Mul(x[2], y[2]));
  }
  static HWY_INLINE void cross(const Point& x, const Point& y, Point& out) {
    out[0] = hn::Sub(hn::Mul(x[1], y[2]), hn::Mul(x[2], y[1]));
    out[1] = hn::Sub(hn::Mul(x[2], y[0]), hn::Mul(x[0], y[2]));
    out[2] = hn::Sub(hn::Mul(x[0], y[1]), hn::Mul(x[1], y[0]));
  }
  /// Returns how far the core comes along m.
  static HWY_INLINE V reach_of_core(const Point& m, const Point& half) {
    if constexpr (core == Core::point) return hn::Zero(d);
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
    /// Returns true if these are all lanes.
    HWY_INLINE bool is_empty_before(V limit) const { return hn::AllTrue(d, outside_before(limit)); }

    /// Cuts the interval to where a height that goes from `first` to `last` is at most `reach`.
    HWY_INLINE void keep_below(V first, V last, V reach) {
      const V above = hn::Sub(first, reach);
      keep_until(hn::Div(above, hn::Sub(first, last)), above, hn::Sub(last, reach));
    }
    /// Does the same for a height that falls by the same amount for all triangles, where `inverse` is one over it.
    HWY_INLINE void keep_below(V first, V last, V reach, V inverse) {
      const V above = hn::Sub(first, reach);
      keep_until(hn::Mul(above, inverse), above, hn::Sub(last, reach));
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
      const V in = hn::Mul(t, set(1 - 16 * Precision::u));
      const V out = hn::Mul(t, set(1 + 16 * Precision::u));
      enters = hn::IfThenElse(hn::And(hn::AndNot(ends_above, starts_above), hn::Gt(in, enters)), in, enters);
      leaves = hn::IfThenElse(hn::And(hn::AndNot(starts_above, ends_above), hn::Lt(out, leaves)), out, leaves);
    }
  };

  /// Returns a bit for each triangle that the shape may touch.
  static HWY_INLINE std::uint64_t test(const ShapeFilter<Scalar>& shape, const Scalar* corners, std::size_t count,
                                       double limit, double* enters) {
    Point corner[3];
    for (std::size_t k = 0; k < 9; ++k) corner[k / 3][k % 3] = load(corners + k * count);
    const V radius = set(shape.radius);
    Interval interval{hn::Zero(d), set(1), hn::Lt(radius, hn::Zero(d))};

    Point w[3];    // The start less each corner.
    Point end[3];  // The end less each corner.
    Point edge[3];
    Point step;
    Point half;
    V size = hn::Zero(d);
    V reach_of_w = hn::Zero(d);
    for (std::size_t i = 0; i < 3; ++i) {
      step[i] = set(shape.step[i]);
      half[i] = set(shape.half[i]);
      for (std::size_t k = 0; k < 3; ++k) {
        w[k][i] = hn::Sub(set(shape.start[i]), corner[k][i]);
        end[k][i] = hn::Sub(set(shape.end[i]), corner[k][i]);
        edge[k][i] = hn::Sub(corner[k == 2 ? 0 : k + 1][i], corner[k][i]);
        size = hn::Max(size, hn::Abs(edge[k][i]));
        reach_of_w = hn::Max(reach_of_w, hn::Max(hn::Abs(w[k][i]), hn::Abs(end[k][i])));
      }
      // On an axis of coordinates, the highest corner is below the centre by the lowest w.
      const V slack = hn::Mul(reach_of_w, set(8 * Precision::u));
      const V reach = hn::Add(set(shape.radius + std::fabs(shape.half[i])), slack);
      const auto lowest = [&](const Point* x) { return hn::Min(hn::Min(x[0][i], x[1][i]), x[2][i]); };
      const auto highest = [&](const Point* x) { return hn::Max(hn::Max(x[0][i], x[1][i]), x[2][i]); };
      const V inverse = set(shape.inverse_step[i]);
      interval.keep_below(lowest(w), lowest(end), reach, hn::Neg(inverse));
      interval.keep_below(hn::Neg(highest(w)), hn::Neg(highest(end)), reach, inverse);
    }
    // A rounded limit is above the times that count, since these have a share of 16 u taken off. The smallest ones may
    // be rounded up, so they always count.
    const V last = set(std::max(limit, 0x1p-100));
    if (interval.is_empty_before(last)) return 0;
    const V far = hn::Add(reach_of_w, set(shape.radius + shape.size_of_half));
    const V size_2 = hn::Mul(size, size);
    const V size_3 = hn::Mul(size_2, size);
    const V error = hn::Mul(far, set(256 * Precision::u));
    const V grown = set(shape.radius * (1 + 256 * Precision::u));
    const V smallest = set(shape.is_usable ? Precision::smallest : std::numeric_limits<double>::infinity());
    const Mask is_usable =
        hn::And(hn::Gt(hn::Min(size, far), smallest), hn::Lt(hn::Max(size, far), set(Precision::largest)));

    Interval tilted = interval;
    Point n;
    cross(edge[0], edge[1], n);
    const V reach_of_n = hn::Mul(grown, hn::Sqrt(dot(n, n)));
    {
      const V of_ball = hn::MulAdd(size_2, error, reach_of_n);
      const V reach = hn::Add(of_ball, reach_of_core(n, half));
      const V first = dot(n, w[0]);
      const V at_end = dot(n, end[0]);
      tilted.keep_below(first, at_end, reach);
      tilted.keep_below(hn::Neg(first), hn::Neg(at_end), reach);
    }
    const V across = dot(n, step);
    const V across_error = hn::Mul(hn::Mul(size_2, set(shape.size_of_step)), set(256 * Precision::u));
    for (std::size_t k = 0; k < 3; ++k) {
      Point outward;
      cross(edge[k], n, outward);
      const V of_ball = hn::MulAdd(reach_of_n, hn::Sqrt(dot(edge[k], edge[k])), hn::Mul(size_3, error));
      const V reach = hn::Add(of_ball, reach_of_core(outward, half));
      tilted.keep_below(dot(outward, w[k]), dot(outward, end[k]), reach);
      // Along f = D × e, the corners of the edge are at 0, and the third corner is at D·n.
      Point f;
      cross(step, edge[k], f);
      const V of_f = hn::MulAdd(grown, hn::Sqrt(dot(f, f)), hn::Mul(hn::Mul(set(shape.size_of_step), size), error));
      const V reach_of_f = hn::Add(hn::Add(of_f, reach_of_core(f, half)), across_error);
      const V height = dot(f, w[k]);
      const V low = hn::Min(across, hn::Zero(d));
      const V high = hn::Max(across, hn::Zero(d));
      tilted.beside = hn::Or(
          tilted.beside, hn::Or(hn::Gt(hn::Sub(height, high), reach_of_f), hn::Gt(hn::Sub(low, height), reach_of_f)));
    }
    interval.enters = hn::IfThenElse(is_usable, tilted.enters, interval.enters);
    interval.leaves = hn::IfThenElse(is_usable, tilted.leaves, interval.leaves);
    interval.beside = hn::Or(interval.beside, hn::And(is_usable, tilted.beside));
    Number times[HWY_MAX_BYTES / sizeof(Number)];
    hn::StoreU(interval.enters, d, times);
    std::copy_n(times, hn::Lanes(d), enters);
    return ~bits_of(d, interval.outside_before(last)) & ((std::uint64_t{1} << hn::Lanes(d)) - 1);
  }
};

template <typename Scalar, typename Number>
HWY_INLINE std::uint64_t find(const ShapeFilter<Scalar>& shape, const Scalar* corners, std::size_t count,
                              std::size_t from, double limit, double* enters) {
  switch (shape.core) {
    case Core::box:
      return FilterLanes<Scalar, Number, Core::box>::find(shape, corners, count, from, limit, enters);
    case Core::segment:
      return FilterLanes<Scalar, Number, Core::segment>::find(shape, corners, count, from, limit, enters);
    case Core::point:
      break;
  }
  return FilterLanes<Scalar, Number, Core::point>::find(shape, corners, count, from, limit, enters);
}
std::uint64_t find_floats(const ShapeFilter<float>& shape, const float* corners, std::size_t count, std::size_t from,
                          double limit, double* enters) {
  if (shape.fits_float) return find<float, float>(shape, corners, count, from, limit, enters);
  return find<float, double>(shape, corners, count, from, limit, enters);
}
std::uint64_t find_doubles(const ShapeFilter<double>& shape, const double* corners, std::size_t count, std::size_t from,
                           double limit, double* enters) {
  return find<double, double>(shape, corners, count, from, limit, enters);
}

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace surehit::detail {

HWY_EXPORT(find_floats);
HWY_EXPORT(find_doubles);

template <typename Scalar>
void ShapeFilter<Scalar>::set(Core any_core, const Vector3<Scalar>& any_start, const Vector3<Scalar>& any_end,
                              const Vector3<Scalar>& any_half, Scalar any_radius) {
  // The inverse of a smaller step might not be finite, in float or in double.
  const double least = std::is_same_v<Scalar, float> ? 0x1p-100 : 0x1p-1000;
  core = any_core;
  radius = any_radius;
  size_of_half = size_of_step = 0;
  double largest = radius;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    start[i] = any_start[axis];
    end[i] = any_end[axis];
    half[i] = any_half[axis];
    step[i] = end[i] - start[i];
    const double size = std::fabs(step[i]);
    inverse_step[i] = size >= least && size <= 0x1p1000 ? 1 / step[i] : std::numeric_limits<double>::quiet_NaN();
    size_of_half = std::max(size_of_half, std::fabs(half[i]));
    size_of_step = std::max(size_of_step, std::fabs(step[i]));
    largest = std::max({largest, std::fabs(start[i]), std::fabs(end[i]), std::fabs(half[i])});
  }
  is_usable = (size_of_step == 0 || size_of_step > 0x1p-200) && largest < 0x1p200;
  fits_float = (size_of_step == 0 || size_of_step > smallest_float) &&
               std::max({radius, size_of_half, size_of_step}) < largest_float;
}

template <typename Scalar>
ShapeFilter<Scalar>::ShapeFilter(const SweptBox<Scalar>& box) {
  set(Core::box, box.start, box.end, box.half_extents, 0);
}
template <typename Scalar>
ShapeFilter<Scalar>::ShapeFilter(const SweptSphere<Scalar>& sphere) {
  set(Core::point, sphere.start, sphere.end, {0, 0, 0}, sphere.radius);
}
template <typename Scalar>
ShapeFilter<Scalar>::ShapeFilter(const SweptCapsule<Scalar>& capsule) {
  set(Core::segment, capsule.start, capsule.end, capsule.half_axis, capsule.radius);
}

template <>
std::uint64_t ShapeFilter<float>::find(const float* corners, std::size_t count, std::size_t from, double limit,
                                       Times& enters) const {
  return HWY_DYNAMIC_DISPATCH(find_floats)(*this, corners, count, from, limit, enters.data());
}
template <>
std::uint64_t ShapeFilter<double>::find(const double* corners, std::size_t count, std::size_t from, double limit,
                                        Times& enters) const {
  return HWY_DYNAMIC_DISPATCH(find_doubles)(*this, corners, count, from, limit, enters.data());
}

template ShapeFilter<float>::ShapeFilter(const SweptBox<float>&);
template ShapeFilter<double>::ShapeFilter(const SweptBox<double>&);
template ShapeFilter<float>::ShapeFilter(const SweptSphere<float>&);
template ShapeFilter<double>::ShapeFilter(const SweptSphere<double>&);
template ShapeFilter<float>::ShapeFilter(const SweptCapsule<float>&);
template ShapeFilter<double>::ShapeFilter(const SweptCapsule<double>&);

}  // namespace surehit::detail
#endif
