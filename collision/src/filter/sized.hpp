#pragma once

#include <cmath>
#include <optional>

namespace surehit::detail {

/// A double with its size: the sum of its terms without their signs. It costs less than a `Bounded` number, and decides
/// less.
struct Sized {
  double value = 0;  ///< The computed value.
  double size = 0;   ///< What it would be if nothing were subtracted. It is 0 only if the exact value is 0.

  /// Returns a bound of the error (Z1).
  [[nodiscard]] double error() const;
  /// Returns the sign if it is certain.
  [[nodiscard]] std::optional<int> sign() const;
};

/// Z1. If no term of a number has more than 100 roundings, it is off by less than 2^-46 of its size.
/// Proof. Let u = 2^-53. A term with k roundings is off by a factor of at most (1 + u)^k, and so is its size. With k =
///     100 this is below 101 u of the exact size, which is below 102 u of the computed one. 2^-46 is 128 u.
///
/// Z2. This holds if every number that takes part is 0 or between 2^-60 and 2^50 in magnitude, and if no term has more
///     than 16 factors.
/// Proof. Then no size is below 2^-960 or above 2^800, so none underflows or overflows. A cancelled value may be
///     smaller than its size, and a product with it may lose 2^-1075. Later factors scale this as they scale the size.
///     So it stays far below the 26 u of the size that Z1 leaves over.
inline constexpr double sized_error = 0x1p-46;
inline constexpr double min_sized = 0x1p-60;
inline constexpr double max_sized = 0x1p50;

inline double Sized::error() const { return size * sized_error; }
inline std::optional<int> Sized::sign() const {
  if (size == 0) return 0;
  if (!(std::fabs(value) > error())) return std::nullopt;
  return value > 0 ? 1 : -1;
}

[[nodiscard]] inline Sized operator+(const Sized& a, const Sized& b) { return {a.value + b.value, a.size + b.size}; }
[[nodiscard]] inline Sized operator-(const Sized& a, const Sized& b) { return {a.value - b.value, a.size + b.size}; }
[[nodiscard]] inline Sized operator-(const Sized& a) { return {-a.value, a.size}; }
[[nodiscard]] inline Sized operator*(const Sized& a, const Sized& b) { return {a.value * b.value, a.size * b.size}; }

}  // namespace surehit::detail
