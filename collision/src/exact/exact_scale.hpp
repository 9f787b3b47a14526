#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include "exact/exact_terms.hpp"
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

template <typename Int, typename Scalar>
void set_difference(IntVector<Int>& out, const Vector3<Scalar>& x, const Vector3<Scalar>& y, const BinaryUnit& unit) {
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

/// The units in which a path and its triangles are integers. All points share one unit. The direction of a ray or a
/// line has its own unit, which keeps the integers short. So the true t is 2^t_exponent times the t of the integers.
template <typename Scalar>
struct Scale {
  Scale(const Path<Scalar>& path, const Triangle<Scalar>& triangle) {
    points.include(path.start);
    points.include(triangle);
    if (path.kind == PathKind::segment) {
      points.include(path.toward);
      direction = points;
    } else {
      direction.include(path.toward);
    }
    finish();
  }
  Scale(const Path<Scalar>& path, const Triangle<Scalar>& triangle, const Triangle<Scalar>& other)
      : Scale(path, triangle) {
    points.include(other);
    if (path.kind == PathKind::segment) direction = points;
    finish();
  }

  void finish() {
    if (points.exponent == std::numeric_limits<int>::max()) points.exponent = 0;
    if (direction.exponent == std::numeric_limits<int>::max()) direction.exponent = points.exponent;
    t_exponent = points.exponent - direction.exponent;
  }

  /// Returns whether all coordinates fit in compact integers.
  [[nodiscard]] bool is_compact() const { return points.is_compact() && direction.is_compact(); }

  BinaryUnit points;
  BinaryUnit direction;
  int t_exponent = 0;
};

/// A finite limit on t, scaled like the t of the integers. It is ±significand × 2^exponent.
template <typename Scalar>
struct Limit {
  Limit(Scalar limit, int t_exponent) : parts(limit) { parts.exponent -= t_exponent; }

  /// Returns whether a ratio of compact integers can hold the limit.
  [[nodiscard]] bool is_compact() const {
    constexpr int bits = Bits<CompactSize>::cross + 3;  // Of the shortest ratio that may hold it.
    return static_cast<int>(std::bit_width(parts.significand)) + std::max(parts.exponent, 0) <= bits &&
           -parts.exponent < bits;
  }

  /// Returns the sign of ratio - limit. Bit lengths decide first, because a shift of a long integer is expensive.
  template <int B>
  [[nodiscard, gnu::noinline]] int compare(const Ratio<WideInt<B>>& ratio) const {
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
    static_assert(B >= 2 * AnySize<Scalar>::coordinate);
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
