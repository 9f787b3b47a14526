#pragma once

#include <cmath>
#include <limits>
#include <optional>

namespace surehit::detail {

/// A double and a bound on its distance from the true value: running error analysis (Wilkinson 1986; Higham, "Accuracy
/// and Stability of Numerical Algorithms", section 3.3), made exact where it can be: the rounding error of each sum and
/// product is itself computed without error (Knuth's two-sum; a fused multiply-add), so that a chain of exact
/// operations keeps radius 0 and even a zero is certain. Round-to-nearest without flush-to-zero is presupposed.
///
/// An overflow makes the radius infinite or NaN, and then nothing is certain.
struct Bounded {
  double value = 0;
  double radius = 0;

  /// The sign, if it is certain: 0 only for an exact zero.
  [[nodiscard]] std::optional<int> sign() const {
    if (value > radius) return 1;
    if (value < -radius) return -1;
    if (value == 0 && radius == 0) return 0;
    return std::nullopt;
  }
};

/// The radius of an operation is a sum of at most four terms that are not negative, each a product rounded once: what
/// is computed is at least (1 - u)^5 of what it should be, u = 2^-53. This factor makes up for it, its own rounding
/// included.
inline constexpr double radius_growth = 1 + 0x1p-49;
/// What underflow in such products, and in the error that a fused multiply-add returns, can hide: below 2^-1074 each.
inline constexpr double radius_underflow = 0x1p-1070;
/// A product from here on has an error that is a double itself: its last place is at least 2^-1074 (2^-960 leaves
/// 2^-1066).
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

[[nodiscard]] inline Bounded operator*(const Bounded& a, const Bounded& b) {
  const double product = a.value * b.value;
  const double error = std::fma(a.value, b.value, -product);
  const bool error_is_exact = std::fabs(product) >= min_exact_product || a.value == 0 || b.value == 0;
  if (a.radius == 0 && b.radius == 0 && error == 0 && error_is_exact) return {product, 0};
  const double radius =
      std::fabs(a.value) * b.radius + std::fabs(b.value) * a.radius + a.radius * b.radius + std::fabs(error);
  return {product, radius * radius_growth + radius_underflow};
}

}  // namespace surehit::detail
