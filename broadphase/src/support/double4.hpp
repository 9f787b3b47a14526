#pragma once

#include <array>
#include <cstdint>

#include "support/float4.hpp"
#include "support/inlining.hpp"

namespace surehit::detail {

// Vectors of x, y and z in double, and of a fourth lane, which is 0 unless a function says otherwise. All functions are
// inlined, so the convention for calls does not matter to GCC. Clang lets code for AVX pass and get such vectors only
// where the function is for AVX too. So what such code calls takes references, and returns no Double4.

using Double4 = VectorOf<double, 4>;
using Long4 = VectorOf<std::int64_t, 4>;  ///< It may be a mask, whose lanes are all ones or zero.

/// Returns x in every lane.
SUREHIT_ALWAYS_INLINE inline Double4 all_lanes(double x) { return Double4{x, x, x, x}; }

/// Returns each lane as a double.
SUREHIT_ALWAYS_INLINE inline Double4 to_double(Float4 x) { return converted<Double4>(x); }

/// Returns a vector of three coordinates.
template <typename Vector>
SUREHIT_ALWAYS_INLINE inline Double4 to_double4(const Vector& x) {
  if constexpr (sizeof(x[0]) == sizeof(float)) return to_double(Float4{x[0], x[1], x[2], 0});
  return Double4{double{x[0]}, double{x[1]}, double{x[2]}, 0};
}

SUREHIT_ALWAYS_INLINE inline Double4 max(Double4 a, Double4 b) { return greater(a, b); }

SUREHIT_ALWAYS_INLINE inline Double4 absolute(Double4 x) {
  return with_bits_of<Double4>(with_bits_of<Long4>(x) & 0x7fffffffffffffff);
}

SUREHIT_ALWAYS_INLINE inline Double4 with_fourth(Double4 x, double fourth) {
  return shuffled<0, 1, 2, 4>(x, all_lanes(fourth));
}

/// Returns the maximum lane.
SUREHIT_ALWAYS_INLINE inline double max_lane(const Double4& x) {
  const Double4 pairs = max(x, shuffled<2, 3, 0, 1>(x, x));
  return pairs[0] > pairs[1] ? pairs[0] : pairs[1];
}

/// Returns the maximum lane of the absolute values.
SUREHIT_ALWAYS_INLINE inline double max_size(const Double4& x) { return max_lane(absolute(x)); }

/// Returns the sum of the first three lanes.
SUREHIT_ALWAYS_INLINE inline double sum_of_three(const Double4& x) { return x[0] + x[1] + x[2]; }

/// Rounds each lane to float.
SUREHIT_ALWAYS_INLINE inline Float4 to_float(const Double4& x) { return converted<Float4>(x); }

/// Returns true if any of the first three lanes of a mask is all ones.
SUREHIT_ALWAYS_INLINE inline bool any_of_three(Long4 mask) { return (mask[0] | mask[1] | mask[2]) != 0; }

/// Returns x - y without error, in each lane: the difference and what it leaves out (Knuth). Nothing may overflow.
SUREHIT_ALWAYS_INLINE inline std::array<Double4, 2> exact_difference(Double4 x, Double4 y) {
  const Double4 difference = x - y;
  const Double4 y_part = x - difference;
  const Double4 x_part = difference + y_part;
  return {difference, (x - x_part) + (y_part - y)};
}

}  // namespace surehit::detail
