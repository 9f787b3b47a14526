#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace surehit::detail {

/// ±(significand + r) × 2^exponent, where 0 <= r < 1 and r > 0 if `more`, rounded once to nearest, ties to even.
/// The significand has 63 or 64 bits, well above any Scalar's, so r alone never is half an ulp.
template <typename Scalar>
[[nodiscard]] Scalar rounded_to_nearest(std::uint64_t significand, bool more, int exponent, bool negative) {
  using Limits = std::numeric_limits<Scalar>;
  const int leading = exponent + 63 - std::countl_zero(significand);  // the value lies in [2^leading, 2^(leading + 1))
  const int least =
      std::max(leading, Limits::min_exponent - 1) - (Limits::digits - 1);  // exponent of the last place kept
  const int dropped = least - exponent;
  if (dropped > 64) return 0;  // under half the least denormal
  std::uint64_t kept = dropped == 64 ? 0 : significand >> dropped;
  const bool half = ((significand >> (dropped - 1)) & 1) != 0;
  const bool rest = more || (significand & ((std::uint64_t{1} << (dropped - 1)) - 1)) != 0;
  if (half && (rest || (kept & 1) != 0)) ++kept;
  if (kept == 0) return 0;
  const Scalar magnitude = std::ldexp(static_cast<Scalar>(kept), least);
  return negative ? -magnitude : magnitude;
}

}  // namespace surehit::detail
