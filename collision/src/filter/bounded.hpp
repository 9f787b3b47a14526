#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace surehit::detail {

/// A double with a bound of its error. This is running error analysis (Wilkinson 1986). See Higham, "Accuracy and
/// Stability of Numerical Algorithms", section 3.3.
///
/// The rounding error of a sum is computed by Knuth's two-sum, and that of a product by a fused multiply-add. Both are
/// exact. So exact operations keep the radius 0, and even a zero can be certain. The rounding mode must be
/// round-to-nearest, without flush-to-zero.
///
/// After an overflow the radius is infinite or NaN, and nothing is certain.
struct Bounded {
  double value = 0;   ///< The computed value.
  double radius = 0;  ///< The exact value is at most this far from `value`.

  /// Returns the sign if it is certain. Returns 0 only for an exact zero.
  [[nodiscard]] std::optional<int> sign() const {
    if (value > radius) return 1;
    if (value < -radius) return -1;
    if (value == 0 && radius == 0) return 0;
    return std::nullopt;
  }
};

/// BN1. This factor covers the roundings of a computed radius, where eps = 2^-53.
/// Proof. A radius is a sum of at most four terms, and none is negative. A term has at most four roundings, since a
///     product and three sums take part. This factor and `radius_underflow` add one each. Finally,
///     (1 + 16 eps) (1 - eps)^6 > 1.
inline constexpr double radius_growth = 1 + 0x1p-49;
/// BN2. This term covers what a radius loses by underflow.
/// Proof. The radius of a product has four products, and one error from a fused multiply-add. Each loses less than
///     2^-1074, and this is 16 times as much.
inline constexpr double radius_underflow = 0x1p-1070;
/// BN3. From this size on, the error of a product is a double.
/// Proof. The exact product has at most 106 bits. So its last bit is worth 2^-1066 or more, which a double can hold.
inline constexpr double min_exact_product = 0x1p-960;

[[nodiscard]] inline Bounded exact(double x) { return {x, 0}; }

[[nodiscard]] inline Bounded operator+(const Bounded& a, const Bounded& b) {
  const double sum = a.value + b.value;
  const double b_part = sum - a.value;
  const double a_part = sum - b_part;
  const double error = (a.value - a_part) + (b.value - b_part);
  return {sum, (a.radius + b.radius + std::fabs(error)) * radius_growth};
}

[[nodiscard]] inline Bounded operator-(const Bounded& a) { return {-a.value, a.radius}; }
[[nodiscard]] inline Bounded operator-(const Bounded& a, const Bounded& b) { return a + -b; }

/// BN4. `product_error` is a b - product, where `product` is a b as it was rounded, if that is at least
///     `min_exact_product`. Without an instruction, `std::fma` is a call, whose cost is many times that of a product.
/// Proof. For `std::fma` this is BN3. The other way is Dekker's product (1971), in which Veltkamp's `high_half` splits
///     a double into two with 26 bits and a sign each. The four products of halves are exact, because they have no bits
///     below those of a b. See Muller et al., "Handbook of Floating-Point Arithmetic", section 4.4. Nothing overflows,
///     since a, b and `product` are at most 2^900.
[[nodiscard]] inline double product_error(double a, double b, double product) {
#ifndef FP_FAST_FMA
  constexpr double largest = 0x1p900;
  if (a == 0 || b == 0) return product;  // This is 0, or NaN.
  const double size = std::fabs(product);
  if (size >= min_exact_product && std::max({std::fabs(a), std::fabs(b), size}) <= largest) {
    const auto high_half = [](double x) {
      const double scaled = (0x1p27 + 1) * x;
      return scaled - (scaled - x);
    };
    const double a_high = high_half(a);
    const double a_low = a - a_high;
    const double b_high = high_half(b);
    const double b_low = b - b_high;
    return ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low;
  }
#endif
  return std::fma(a, b, -product);
}

[[nodiscard]] inline Bounded operator*(const Bounded& a, const Bounded& b) {
  const double product = a.value * b.value;
  const double error = product_error(a.value, b.value, product);
  const bool error_is_exact = std::fabs(product) >= min_exact_product || a.value == 0 || b.value == 0;
  if (a.radius == 0 && b.radius == 0 && error == 0 && error_is_exact) return {product, 0};
  const double radius =
      std::fabs(a.value) * b.radius + std::fabs(b.value) * a.radius + a.radius * b.radius + std::fabs(error);
  return {product, radius * radius_growth + radius_underflow};
}

}  // namespace surehit::detail
