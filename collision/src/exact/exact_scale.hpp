#pragma once

#include <algorithm>
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

  template <typename Scalar>
  void include(const Vector3<Scalar>& vector) {
    for (int i = 0; i < 3; ++i) {
      const Decomposed<Scalar> parts(vector[i]);
      if (parts.significand != 0) exponent = std::min(exponent, parts.exponent);
    }
  }

  template <typename Scalar>
  void include(const Triangle<Scalar>& triangle) {
    include(triangle.a);
    include(triangle.b);
    include(triangle.c);
  }
};

template <typename Scalar>
void set_integer(WideInt<Bits<Scalar>::difference>& out, Scalar x, const BinaryUnit& unit) {
  const Decomposed<Scalar> parts(x);
  out = parts.significand == 0 ? WideInt<Bits<Scalar>::difference>()
                               : WideInt<Bits<Scalar>::difference>::shifted(
                                     parts.significand, parts.exponent - unit.exponent, parts.negative);
}

template <typename Scalar>
using Differences = WideVector<Bits<Scalar>::difference>;

template <typename Scalar>
void set_difference(Differences<Scalar>& out, const Vector3<Scalar>& x, const Vector3<Scalar>& y,
                    const BinaryUnit& unit) {
  WideInt<Bits<Scalar>::difference> subtrahend;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    set_integer(out[i], x[axis], unit);
    set_integer(subtrahend, y[axis], unit);
    out[i].add(subtrahend, true);
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

  BinaryUnit points;
  BinaryUnit direction;
  int t_exponent = 0;
};

/// A finite limit on t, scaled like the t of the integers. It is ±significand × 2^exponent.
template <typename Scalar>
struct Limit {
  Limit(Scalar limit, int t_exponent) : parts(limit) { parts.exponent -= t_exponent; }

  /// Returns the sign of ratio - limit. Bit lengths decide first, because a shift of a long integer is expensive.
  template <int B>
  [[nodiscard, gnu::noinline]] int compare(const Ratio<B>& ratio) const {
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

  template <int B>
  void store(Ratio<B>& out) const {
    static_assert(B >= Bits<Scalar>::limit);
    out.num = WideInt<B>::shifted(parts.significand, std::max(parts.exponent, 0), parts.negative);
    out.den = WideInt<B>::power_of_two(std::max(-parts.exponent, 0));
  }

  Decomposed<Scalar> parts;
};

}  // namespace surehit::detail
