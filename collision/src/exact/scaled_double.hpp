#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "exact/wide_int.hpp"
#include "support/inlining.hpp"

namespace surehit::detail {

/// A nonnegative number as value × 2^exponent, for numbers whose size no double can hold. The value is 0 or in
/// [0.5, 1). Each function is off by a factor of at most (1 + eps)^2, where eps = 2^-53.
struct ScaledDouble {
  double value = 0;  ///< The leading bits.
  int exponent = 0;  ///< The power of two that they are multiplied by.

  /// Returns |x|.
  template <int Bits>
  SUREHIT_NOINLINE static ScaledDouble of_magnitude(const WideInt<Bits>& x) {
    if (x.is_zero()) return {};
    const int below = x.bit_length() - 64;
    // Two roundings: bits below the leading 64 are cut, and the conversion rounds to 53 of these.
    return {std::ldexp(static_cast<double>(x.bits_from(below)), -64), below + 64};
  }

  friend ScaledDouble operator*(const ScaledDouble& a, const ScaledDouble& b) {
    return normalized(a.value * b.value, a.exponent + b.exponent);
  }
  /// b must not be zero.
  friend ScaledDouble operator/(const ScaledDouble& a, const ScaledDouble& b) {
    return normalized(a.value / b.value, a.exponent - b.exponent);
  }
  friend ScaledDouble operator+(const ScaledDouble& a, const ScaledDouble& b) {
    if (a.value == 0) return b;
    if (b.value == 0) return a;
    const int exponent = std::max(a.exponent, b.exponent);
    // What underflows in ldexp is below 2^-1022 of the sum.
    return normalized(std::ldexp(a.value, a.exponent - exponent) + std::ldexp(b.value, b.exponent - exponent),
                      exponent);
  }
  friend ScaledDouble sqrt(const ScaledDouble& a) {
    const int odd = a.exponent & 1;
    return normalized(std::sqrt(odd != 0 ? a.value * 2 : a.value), (a.exponent - odd) / 2);
  }

 private:
  static ScaledDouble normalized(double value, int exponent) {
    int shift = 0;
    const double fraction = std::frexp(value, &shift);
    return {fraction, value == 0 ? 0 : exponent + shift};
  }
};

/// Bounds of a number.
struct DoubleRange {
  double lower = 0;  ///< The number is at least this.
  double upper = 0;  ///< The number is at most this.
};

/// Returns bounds of a number that was computed with at most twelve functions of ScaledDouble, roots included. Their
/// roundings are at most (1 + eps)^24, and 2^-47 is more than 24 eps and the roundings here.
[[nodiscard]] inline DoubleRange range_of(const ScaledDouble& x) {
  if (x.value == 0) return {0, 0};
  const int exponent = std::clamp(x.exponent, -1200, 1200);
  const double lower = std::ldexp(x.value * (1 - 0x1p-47), exponent);
  const double upper = std::ldexp(x.value * (1 + 0x1p-47), exponent);
  // A denormal is rounded, so each bound moves to its neighbour.
  return {std::max(0.0, std::nextafter(lower, 0.0)), std::nextafter(upper, std::numeric_limits<double>::infinity())};
}

}  // namespace surehit::detail
