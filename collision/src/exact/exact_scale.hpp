#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include "exact/exact_terms.hpp"
#include "placement.hpp"
#include "support/inlining.hpp"
#include "surehit/path.hpp"
#include "surehit/triangle.hpp"

namespace surehit::detail {

/// The unit in which some coordinates are integers: x = n 2^exponent. It is the largest power of two that divides all
/// of them. Zeros do not change it, and without any other number the exponent is the maximum int.
struct BinaryUnit {
  int exponent = std::numeric_limits<int>::max();
  int end = -(1 << 16);  ///< All coordinates are below 2^end in magnitude.

  template <typename Scalar>
  void include(const Vector3<Scalar>& vector) {
    for (int i = 0; i < 3; ++i) {
      const Decomposed<Scalar> parts(vector[i]);
      if (parts.significand == 0) continue;
      exponent = std::min(exponent, parts.exponent);
      end = std::max(end, parts.exponent + static_cast<int>(std::bit_width(parts.significand)));
    }
  }

  /// Does the same for products of a number of `left` and one of `right`. A number is a sum of at most `terms` of them.
  void include_products(const BinaryUnit& left, const BinaryUnit& right, int terms) {
    if (left.is_empty() || right.is_empty()) return;
    exponent = std::min(exponent, left.exponent + right.exponent);
    end = std::max(end, left.end + right.end + static_cast<int>(std::bit_width(static_cast<unsigned>(terms - 1))));
  }

  /// Returns true if no number but zero was included.
  [[nodiscard]] bool is_empty() const { return exponent == std::numeric_limits<int>::max(); }
  /// Returns the number of units in 1. The unit must be compact.
  [[nodiscard]] double per_one() const {
    return std::bit_cast<double>(static_cast<std::uint64_t>(1023 - exponent) << 52);
  }
  /// Returns whether compact integers hold all coordinates.
  [[nodiscard]] bool is_compact() const {
    constexpr int max_exponent = 1000;  // So `per_one` does not overflow, and no coordinate is a denormal double.
    return end - exponent <= CompactSize::coordinate && std::abs(exponent) <= max_exponent;
  }

  template <typename Scalar>
  void include(const Triangle<Scalar>& triangle) {
    include(triangle.a);
    include(triangle.b);
    include(triangle.c);
  }
};

template <typename Int, typename Scalar>
void set_integer(Int& out, Scalar x, const BinaryUnit& unit) {
  const Decomposed<Scalar> parts(x);
  out =
      parts.significand == 0 ? Int() : Int::shifted(parts.significand, parts.exponent - unit.exponent, parts.negative);
}

/// Does the same for a compact unit. The product is a whole number, so it is exact.
template <int B, typename Scalar>
void set_integer(CompactInt<B>& out, Scalar x, const BinaryUnit& unit) {
  out = CompactInt<B>::of(static_cast<std::int64_t>(double{x} * unit.per_one()));
}

template <typename Size>
using Differences = IntVector<typename Size::template Int<Bits<Size>::difference>>;

/// It is not inlined, because each copy of it would take stack.
template <typename Int, typename Scalar>
SUREHIT_NOINLINE void set_difference(IntVector<Int>& out, const Vector3<Scalar>& x, const Vector3<Scalar>& y,
                                     const BinaryUnit& unit) {
  Int subtrahend;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    set_integer(out[i], x[axis], unit);
    set_integer(subtrahend, y[axis], unit);
    out[i].add(subtrahend, true);
  }
}

/// Does the same for a compact unit.
template <int B, typename Scalar>
void set_difference(IntVector<CompactInt<B>>& out, const Vector3<Scalar>& x, const Vector3<Scalar>& y,
                    const BinaryUnit& unit) {
  const double per_one = unit.per_one();
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    out[i] = CompactInt<B>::of(static_cast<std::int64_t>(double{x[axis]} * per_one) -
                               static_cast<std::int64_t>(double{y[axis]} * per_one));
  }
}

/// The units of an instance and of one of its triangles.
template <typename Scalar>
struct PlacedUnits {
  explicit PlacedUnits(const PlacedTriangle<Scalar>& triangle) {
    corners.include(triangle.local);
    const auto& [pose, motion_given, moves] = triangle.placement;
    for (Eigen::Index column = 0; column < 3; ++column) linear.include<Scalar>(pose.linear.col(column));
    motion.include(motion_given);
    share.include<Scalar>({triangle.share, 0, 0});
  }

  BinaryUnit linear;   ///< The unit of the pose's matrix.
  BinaryUnit corners;  ///< The unit of the mesh's triangle.
  BinaryUnit motion;   ///< The unit of the motion.
  BinaryUnit share;    ///< The unit of the share of the motion.
};

/// The units in which a path and its triangles are integers. All points share one unit. The direction of a ray or a
/// line has its own unit, which keeps the integers short. So the true t is 2^t_exponent times the t of the integers.
template <typename Scalar>
struct Scale {
  /// `Triangles` are `Triangle` or `PlacedTriangle`.
  template <typename... Triangles>
  explicit Scale(const Path<Scalar>& path, const Triangles&... triangles) {
    points.include(path.start);
    if (path.kind == PathKind::segment) points.include(path.toward);
    (include(path, triangles), ...);
    if (path.kind == PathKind::segment) {
      direction = points;
    } else {
      direction.include(path.toward);
    }
    if (points.is_empty()) points.exponent = 0;
    if (direction.is_empty()) direction.exponent = points.exponent;
    t_exponent = points.exponent - direction.exponent;
  }

  /// Returns whether all coordinates fit in compact integers.
  [[nodiscard]] bool is_compact() const { return points.is_compact() && direction.is_compact(); }

  BinaryUnit points;
  BinaryUnit direction;
  int t_exponent = 0;

 private:
  void include(const Path<Scalar>&, const Triangle<Scalar>& triangle) { points.include(triangle); }
  /// The points include a placed corner, and the end of a segment less the motion. Each is a sum of two parts.
  void include(const Path<Scalar>& path, const PlacedTriangle<Scalar>& triangle) {
    const PlacedUnits<Scalar> units(triangle);
    points.include_products(units.linear, units.corners, 3);
    points.include(triangle.placement.pose.translation);
    if (path.kind == PathKind::segment) points.include_products(units.motion, units.share, 1);
    ++points.end;
  }
};

/// Returns the mesh's triangle of a triangle of either kind.
template <typename Scalar>
const Triangle<Scalar>& local_corners(const Triangle<Scalar>& triangle) {
  return triangle;
}
template <typename Scalar>
const Triangle<Scalar>& local_corners(const PlacedTriangle<Scalar>& triangle) {
  return triangle.local;
}

/// Sets D in the units of the scale.
template <typename Vector, typename Scalar>
void set_direction(Vector& d, const Path<Scalar>& path, const Scale<Scalar>& scale) {
  if (path.kind == PathKind::segment) {
    set_difference(d, path.toward, path.start, scale.points);
    return;
  }
  for (std::size_t i = 0; i < 3; ++i) set_integer(d[i], path.toward[static_cast<Eigen::Index>(i)], scale.direction);
}

/// Sets S, D, E1 and E2 in the units of the scale.
template <typename Vector, typename Scalar>
void set_vectors(const Path<Scalar>& path, const Triangle<Scalar>& triangle, const Scale<Scalar>& scale, Vector& s,
                 Vector& d, Vector& e1, Vector& e2) {
  set_difference(s, path.start, triangle.a, scale.points);
  set_direction(d, path, scale);
  set_difference(e1, triangle.b, triangle.a, scale.points);
  set_difference(e2, triangle.c, triangle.a, scale.points);
}

/// Adds a b 2^exponent, or subtracts it. The exponent must not be negative.
template <int Out, int A, int B>
SUREHIT_NOINLINE void add_product(WideInt<Out>& out, const WideInt<A>& a, const WideInt<B>& b, int exponent,
                                  bool subtract) {
  static_assert(A + B <= Out);
  WideInt<Out> product;
  product.set_product(a, b);
  product.shift_left(exponent);
  out.add(product, subtract);
}
template <int Out>
void add_product(CompactInt<Out>& out, std::int64_t a, std::int64_t b, int exponent, bool subtract) {
  out.add(CompactInt<Out>::of(static_cast<std::int64_t>(static_cast<std::uint64_t>(a * b) << exponent)), subtract);
}

/// The integers of one number, of the sizes that `add_product` multiplies (I16).
template <typename Int, typename Scalar>
struct PlacedFactor;
template <int B, typename Scalar>
struct PlacedFactor<WideInt<B>, Scalar> {
  using Entry = WideInt<128 + std::numeric_limits<Scalar>::digits>;
  using Coordinate = WideInt<AnySize<Scalar>::coordinate + 1>;
  using Share = WideInt<1 - Decomposed<Scalar>::min_exponent>;  // A share is at most 1.
  static Share share(Scalar x, const BinaryUnit& unit) {
    Share out;
    set_integer(out, x, unit);
    return out;
  }
  static Entry entry(Scalar x, const BinaryUnit& unit) {
    Entry out;
    set_integer(out, x, unit);
    return out;
  }
  static Coordinate coordinate(Scalar x, Scalar y, const BinaryUnit& unit) {
    Coordinate out;
    Coordinate subtrahend;
    set_integer(out, x, unit);
    set_integer(subtrahend, y, unit);
    out.add(subtrahend, true);
    return out;
  }
};
template <int B, typename Scalar>
struct PlacedFactor<CompactInt<B>, Scalar> {
  static std::int64_t entry(Scalar x, const BinaryUnit& unit) {
    return static_cast<std::int64_t>(std::ldexp(double{x}, -unit.exponent));
  }
  static std::int64_t share(Scalar x, const BinaryUnit& unit) { return entry(x, unit); }
  static std::int64_t coordinate(Scalar x, Scalar y, const BinaryUnit& unit) { return entry(x, unit) - entry(y, unit); }
};

/// Adds linear (x - y) to `out`, or subtracts it.
template <typename Int, typename Scalar>
void add_image(IntVector<Int>& out, const PlacedTriangle<Scalar>& triangle, const PlacedUnits<Scalar>& units,
               const Vector3<Scalar>& x, const Vector3<Scalar>& y, const BinaryUnit& points, bool subtract) {
  if (units.linear.is_empty() || units.corners.is_empty()) return;
  const int exponent = units.linear.exponent + units.corners.exponent - points.exponent;
  for (Eigen::Index column = 0; column < 3; ++column) {
    const auto coordinate = PlacedFactor<Int, Scalar>::coordinate(x[column], y[column], units.corners);
    for (std::size_t row = 0; row < 3; ++row) {
      const Scalar entry = triangle.placement.pose.linear(static_cast<Eigen::Index>(row), column);
      if (entry == 0) continue;
      add_product(out[row], PlacedFactor<Int, Scalar>::entry(entry, units.linear), coordinate, exponent, subtract);
    }
  }
}

/// Sets S, D, E1 and E2 of a placed triangle. The path is seen from the instance, so D is less by the motion.
template <typename Int, typename Scalar>
SUREHIT_NOINLINE void set_vectors(const Path<Scalar>& path, const PlacedTriangle<Scalar>& triangle,
                                  const Scale<Scalar>& scale, IntVector<Int>& s, IntVector<Int>& d, IntVector<Int>& e1,
                                  IntVector<Int>& e2) {
  const PlacedUnits<Scalar> units(triangle);
  const Vector3<Scalar> zero = Vector3<Scalar>::Zero();
  const auto& [a, b, c] = triangle.local;
  set_difference(s, path.start, triangle.placement.pose.translation, scale.points);
  add_image(s, triangle, units, a, zero, scale.points, true);
  set_direction(d, path, scale);
  if (path.kind == PathKind::segment && triangle.placement.moves) {
    const int exponent = units.motion.exponent + units.share.exponent - scale.points.exponent;
    const auto share = PlacedFactor<Int, Scalar>::share(triangle.share, units.share);
    for (std::size_t i = 0; i < 3; ++i) {
      const Scalar motion = triangle.placement.motion[static_cast<Eigen::Index>(i)];
      add_product(d[i], share, PlacedFactor<Int, Scalar>::coordinate(motion, 0, units.motion), exponent, true);
    }
  }
  for (Int& x : e1) x = Int();
  for (Int& x : e2) x = Int();
  add_image(e1, triangle, units, b, a, scale.points, false);
  add_image(e2, triangle, units, c, a, scale.points, false);
}

/// A finite limit on t, scaled like the t of the integers. It is ±significand × 2^exponent.
template <typename Scalar>
struct Limit {
  Limit(Scalar limit, int t_exponent) : parts(limit) { parts.exponent -= t_exponent; }

  /// Returns whether a ratio of compact integers can hold the limit.
  [[nodiscard]] bool is_compact() const {
    constexpr int bits = Bits<CompactSize>::cross + 3;  // The bits of the shortest ratio that may hold it.
    return static_cast<int>(std::bit_width(parts.significand)) + std::max(parts.exponent, 0) <= bits &&
           -parts.exponent < bits;
  }

  /// Returns the sign of ratio - limit. Bit lengths decide first, because a shift of a long integer is expensive.
  template <int B>
  [[nodiscard]] SUREHIT_NOINLINE int compare(const Ratio<WideInt<B>>& ratio) const {
    const int sign = parts.significand == 0 ? 0 : parts.negative ? -1 : 1;
    if (ratio.num.sign() != sign) return ratio.num.sign() < sign ? -1 : 1;
    if (sign == 0) return 0;
    WideInt<B + 64> x = ratio.num;
    WideInt<B + 64> y = ratio.den * WideInt<64>::shifted(parts.significand, 0, false);
    const int longer = x.bit_length() - (y.bit_length() + parts.exponent);
    if (longer != 0) return longer < 0 ? -sign : sign;
    (parts.exponent < 0 ? x : y).shift_left(std::abs(parts.exponent));
    return sign * x.compare_magnitude(y);
  }

  /// Does the same for compact integers. The usual limits are 0 and 1.
  template <int B>
  [[nodiscard]] int compare(const Ratio<CompactInt<B>>& ratio) const {
    if (parts.significand == 0) return ratio.num.sign();
    if (parts.significand == 1 && parts.exponent == 0 && !parts.negative) return ratio.num.compare(ratio.den);
    return compare(Ratio<WideInt<B>>{ratio.num.widened(), ratio.den.widened()});
  }

  template <int B>
  void store(Ratio<WideInt<B>>& out) const {
    static_assert(B >= 2 * AnySize<Scalar>::coordinate);  // I16
    out.num = WideInt<B>::shifted(parts.significand, std::max(parts.exponent, 0), parts.negative);
    out.den = WideInt<B>::power_of_two(std::max(-parts.exponent, 0));
  }
  /// Does the same for compact integers. The limit must be compact.
  template <int B>
  void store(Ratio<CompactInt<B>>& out) const {
    out.num = CompactInt<B>::shifted(parts.significand, std::max(parts.exponent, 0), parts.negative);
    out.den = CompactInt<B>::power_of_two(std::max(-parts.exponent, 0));
  }

  Decomposed<Scalar> parts;
};

}  // namespace surehit::detail
