#pragma once

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "exact/exact_terms.hpp"
#include "surehit/path.hpp"
#include "surehit/triangle.hpp"

namespace surehit::detail {

/// Where the places of coordinates begin: as integers they are x 2^-place. Zeros have no place of their own.
struct Place {
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
void set_integer(WideInt<Bits<Scalar>::difference>& out, Scalar x, const Place& place) {
  const Decomposed<Scalar> parts(x);
  out = parts.significand == 0 ? WideInt<Bits<Scalar>::difference>()
                               : WideInt<Bits<Scalar>::difference>::shifted(
                                     parts.significand, parts.exponent - place.exponent, parts.negative);
}

template <typename Scalar>
using Differences = WideVector<Bits<Scalar>::difference>;

template <typename Scalar>
void set_difference(Differences<Scalar>& out, const Vector3<Scalar>& x, const Vector3<Scalar>& y, const Place& place) {
  WideInt<Bits<Scalar>::difference> subtrahend;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    set_integer(out[i], x[axis], place);
    set_integer(subtrahend, y[axis], place);
    out[i].add(subtrahend, true);
  }
}

/// The scale of a path against triangles: points are counted in units of 2^points.exponent, the direction of a ray or a
/// line in units of its own, so that a true t is the integers' t times 2^t_exponent.
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

  Place points;
  Place direction;
  int t_exponent = 0;
};

/// A finite limit on t in the integers' terms: ±significand × 2^exponent.
template <typename Scalar>
struct Limit {
  Limit(Scalar limit, int t_exponent) : parts(limit) { parts.exponent -= t_exponent; }

  /// The sign of ratio - limit. The limit is multiplied in and shifted only when both sides have the same length.
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
