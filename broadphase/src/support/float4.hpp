#pragma once

#include <cstdint>
#include <limits>

#include "support/vector_of.hpp"

namespace surehit::detail {

// Vectors of x, y and z, and of a fourth lane. The fourth lane gets numbers that do not change a result.

using Float4 = VectorOf<float, 4>;
using Int4 = VectorOf<std::int32_t, 4>;  ///< It may be a mask, whose lanes are all ones or zero.

/// Returns x in every lane.
SUREHIT_ALWAYS_INLINE inline Float4 all_lanes(float x) { return Float4{x, x, x, x}; }
SUREHIT_ALWAYS_INLINE inline Int4 all_lanes(std::int32_t x) { return Int4{x, x, x, x}; }

SUREHIT_ALWAYS_INLINE inline Float4 min(Float4 a, Float4 b) { return lesser(a, b); }
SUREHIT_ALWAYS_INLINE inline Float4 max(Float4 a, Float4 b) { return greater(a, b); }
SUREHIT_ALWAYS_INLINE inline Int4 min(Int4 a, Int4 b) { return lesser(a, b); }
SUREHIT_ALWAYS_INLINE inline Int4 max(Int4 a, Int4 b) { return greater(a, b); }

SUREHIT_ALWAYS_INLINE inline Float4 to_float(Int4 x) { return converted<Float4>(x); }
/// Rounds toward zero. Returns any integer for a number that no integer can hold.
SUREHIT_ALWAYS_INLINE inline Int4 to_int(Float4 x) { return converted<Int4>(x); }

/// Returns x where the mask's lanes are all ones, and +0 elsewhere. A mask with a sum or a maximum takes fewer
/// operations than `mask ? x : y`, which is three operations on many x86 processors.
SUREHIT_ALWAYS_INLINE inline Float4 masked(Int4 mask, Float4 x) {
  return with_bits_of<Float4>(mask & with_bits_of<Int4>(x));
}

/// Returns -x where the mask's lanes are all ones, and x elsewhere.
SUREHIT_ALWAYS_INLINE inline Float4 negated_where(Float4 x, Int4 mask) {
  return with_bits_of<Float4>(with_bits_of<Int4>(x) ^ (mask & std::numeric_limits<std::int32_t>::min()));
}

SUREHIT_ALWAYS_INLINE inline Float4 absolute(Float4 x) {
  return with_bits_of<Float4>(with_bits_of<Int4>(x) & 0x7fffffff);
}

/// Returns x with its third lane in the fourth lane too.
SUREHIT_ALWAYS_INLINE inline Float4 without_fourth(Float4 x) { return shuffled<0, 1, 2, 2>(x, x); }

SUREHIT_ALWAYS_INLINE inline Float4 with_fourth(Float4 x, float fourth) {
  return shuffled<0, 1, 2, 4>(x, all_lanes(fourth));
}

/// Returns the maximum lane of each of the four vectors.
SUREHIT_ALWAYS_INLINE inline Float4 max_lanes(Float4 a, Float4 b, Float4 c, Float4 d) {
  const Float4 ab = max(shuffled<0, 4, 1, 5>(a, b), shuffled<2, 6, 3, 7>(a, b));
  const Float4 cd = max(shuffled<0, 4, 1, 5>(c, d), shuffled<2, 6, 3, 7>(c, d));
  return max(shuffled<0, 1, 4, 5>(ab, cd), shuffled<2, 3, 6, 7>(ab, cd));
}

/// Returns the minimum of all lanes, in every lane.
SUREHIT_ALWAYS_INLINE inline Float4 min_lane(Float4 x) {
  const Float4 pairs = min(x, shuffled<1, 0, 3, 2>(x, x));
  return min(pairs, shuffled<2, 3, 0, 1>(pairs, pairs));
}

/// Returns the maximum of all lanes, in every lane.
SUREHIT_ALWAYS_INLINE inline Float4 max_lane(Float4 x) {
  const Float4 pairs = max(x, shuffled<1, 0, 3, 2>(x, x));
  return max(pairs, shuffled<2, 3, 0, 1>(pairs, pairs));
}

/// Returns the sum of all lanes.
SUREHIT_ALWAYS_INLINE inline float sum_of(Float4 x) {
  const Float4 pairs = x + shuffled<2, 3, 0, 1>(x, x);
  return pairs[0] + pairs[1];
}

/// Returns the sum of the first three lanes.
SUREHIT_ALWAYS_INLINE inline float sum_of_three(Float4 x) { return x[0] + x[1] + x[2]; }

/// Returns the bits of a mask. Bit k is lane k.
SUREHIT_ALWAYS_INLINE inline std::uint32_t bits_of_lanes(Int4 mask) {
#if defined(__SSE__) && defined(SUREHIT_HAS_GNU_VECTORS)
  return static_cast<std::uint32_t>(__builtin_ia32_movmskps(with_bits_of<Float4>(mask)));
#else
  const Int4 bits = mask & Int4{1, 2, 4, 8};
  return static_cast<std::uint32_t>(bits[0] | bits[1] | bits[2] | bits[3]);
#endif
}

SUREHIT_ALWAYS_INLINE inline bool any_lane(Int4 mask) {
#if defined(__SSE__) && defined(SUREHIT_HAS_GNU_VECTORS)
  return bits_of_lanes(mask) != 0;
#else
  const auto halves = with_bits_of<VectorOf<std::int64_t, 2> >(mask);
  return (halves[0] | halves[1]) != 0;
#endif
}

/// Returns whether the maximum lane of a is greater than the minimum lane of b. It is faster than to compute both.
SUREHIT_ALWAYS_INLINE inline bool any_lane_exceeds_any(Float4 a, Float4 b) {
  const Int4 next = a > shuffled<1, 2, 3, 0>(b, b);
  const Int4 second = a > shuffled<2, 3, 0, 1>(b, b);
  const Int4 third = a > shuffled<3, 0, 1, 2>(b, b);
  return any_lane((a > b) | next | second | third);
}

}  // namespace surehit::detail
