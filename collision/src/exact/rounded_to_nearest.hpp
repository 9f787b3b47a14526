#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace surehit::detail {

/// Returns ±(significand + r) × 2^exponent, rounded once to nearest, ties to even. A result of zero is +0.
/// The value of r is unknown: 0 < r < 1 if `more`, and r = 0 otherwise. The significand must have 63 or 64 bits.
/// A Scalar has fewer, so r alone is always below half an ulp.
template <typename Scalar>
[[nodiscard]] Scalar rounded_to_nearest(std::uint64_t significand, bool more, int exponent, bool negative) {
  using Limits = std::numeric_limits<Scalar>;
  // The value is in [2^leading, 2^(leading + 1)).
  const int leading = exponent + 63 - std::countl_zero(significand);
  // The last bit of the result is worth 2^last_place.
  const int last_place = std::max(leading, Limits::min_exponent - 1) - (Limits::digits - 1);
  const int dropped = last_place - exponent;
  if (dropped > 64) return 0;  // The value is below half the smallest denormal.
  std::uint64_t kept = dropped == 64 ? 0 : significand >> dropped;
  const bool half = ((significand >> (dropped - 1)) & 1) != 0;
  const bool rest = more || (significand & ((std::uint64_t{1} << (dropped - 1)) - 1)) != 0;
  if (half && (rest || (kept & 1) != 0)) ++kept;
  if (kept == 0) return 0;
  const Scalar magnitude = std::ldexp(static_cast<Scalar>(kept), last_place);
  return negative ? -magnitude : magnitude;
}

}  // namespace surehit::detail
