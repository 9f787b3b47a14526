#pragma once

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "surehit/path.hpp"

namespace surehit::test {

/// A whole number of a power of two. Each finite float and double is one, and so is each of their sums and products.
class Dyadic {
 public:
  Dyadic() = default;
  /// x must be finite.
  explicit Dyadic(double x) {
    constexpr int digits = std::numeric_limits<double>::digits;
    int exponent = 0;
    const mpz_class significand = std::ldexp(std::frexp(x, &exponent), digits);
    *this = Dyadic(significand, exponent - digits);
  }

  [[nodiscard]] bool is_zero() const { return number_ == 0; }
  /// Returns the exponent of the largest power of two of which this is a whole number. It must not be zero.
  [[nodiscard]] long exponent() const { return exponent_; }
  /// Returns the number of units of 2^exponent. This must be a whole number.
  [[nodiscard]] mpz_class in_units_of(long exponent) const {
    return is_zero() ? mpz_class(0) : mpz_class(number_ << static_cast<mp_bitcnt_t>(exponent_ - exponent));
  }
  [[nodiscard]] mpq_class rational() const {
    mpq_class x = number_;
    if (exponent_ > 0) x <<= static_cast<mp_bitcnt_t>(exponent_);
    if (exponent_ < 0) x >>= static_cast<mp_bitcnt_t>(-exponent_);
    return x;
  }

  friend Dyadic operator+(const Dyadic& left, const Dyadic& right) {
    if (left.is_zero()) return right;
    if (right.is_zero()) return left;
    const long exponent = std::min(left.exponent_, right.exponent_);
    return {left.in_units_of(exponent) + right.in_units_of(exponent), exponent};
  }
  friend Dyadic operator-(const Dyadic& left, const Dyadic& right) {
    return left + Dyadic(-right.number_, right.exponent_);
  }
  friend Dyadic operator*(const Dyadic& left, const Dyadic& right) {
    return {left.number_ * right.number_, left.exponent_ + right.exponent_};
  }

 private:
  /// The number is kept odd, so small numbers stay short.
  Dyadic(mpz_class number, long exponent) : number_(std::move(number)), exponent_(exponent) {
    if (is_zero()) {
      exponent_ = 0;
      return;
    }
    const mp_bitcnt_t zeros = mpz_scan1(number_.get_mpz_t(), 0);
    number_ >>= zeros;
    exponent_ += static_cast<long>(zeros);
  }

  mpz_class number_;
  long exponent_ = 0;
};

using DyadicVector = std::array<Dyadic, 3>;

template <typename Scalar>
[[nodiscard]] DyadicVector dyadic(const Vector3<Scalar>& x) {
  return {Dyadic(double{x[0]}), Dyadic(double{x[1]}), Dyadic(double{x[2]})};
}

[[nodiscard]] inline DyadicVector operator+(const DyadicVector& left, const DyadicVector& right) {
  return {left[0] + right[0], left[1] + right[1], left[2] + right[2]};
}
[[nodiscard]] inline DyadicVector operator-(const DyadicVector& left, const DyadicVector& right) {
  return {left[0] - right[0], left[1] - right[1], left[2] - right[2]};
}
[[nodiscard]] inline DyadicVector operator*(const Dyadic& factor, const DyadicVector& vector) {
  return {factor * vector[0], factor * vector[1], factor * vector[2]};
}

}  // namespace surehit::test
