#pragma once

#include <array>
#include <cstdint>
#include <limits>

namespace surehit::detail {

// Vectors of x, y and z, and of a fourth lane. The fourth lane gets numbers that do not change a result. GCC and Clang
// compile these types for the vectors of any target.

using Float4 = float __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));  ///< It may be a mask, whose lanes are all ones or zero.

/// Returns x in every lane.
[[gnu::always_inline]] inline Float4 all_lanes(float x) { return Float4{x, x, x, x}; }
[[gnu::always_inline]] inline Int4 all_lanes(std::int32_t x) { return Int4{x, x, x, x}; }

[[gnu::always_inline]] inline Float4 min(Float4 a, Float4 b) { return a < b ? a : b; }
[[gnu::always_inline]] inline Float4 max(Float4 a, Float4 b) { return a > b ? a : b; }
[[gnu::always_inline]] inline Int4 min(Int4 a, Int4 b) { return a < b ? a : b; }
[[gnu::always_inline]] inline Int4 max(Int4 a, Int4 b) { return a > b ? a : b; }

[[gnu::always_inline]] inline Float4 to_float(Int4 x) { return __builtin_convertvector(x, Float4); }
/// Rounds toward zero. Returns any integer for a number that no integer can hold.
[[gnu::always_inline]] inline Int4 to_int(Float4 x) { return __builtin_convertvector(x, Int4); }

/// Returns x where the mask's lanes are all ones, and +0 elsewhere. A mask with a sum or a maximum takes fewer
/// operations than `mask ? x : y`, which is three operations on many x86 processors.
[[gnu::always_inline]] inline Float4 masked(Int4 mask, Float4 x) {
  return reinterpret_cast<Float4>(mask & reinterpret_cast<Int4>(x));
}

/// Returns -x where the mask's lanes are all ones, and x elsewhere.
[[gnu::always_inline]] inline Float4 negated_where(Float4 x, Int4 mask) {
  return reinterpret_cast<Float4>(reinterpret_cast<Int4>(x) ^ (mask & std::numeric_limits<std::int32_t>::min()));
}

[[gnu::always_inline]] inline Float4 absolute(Float4 x) {
  return reinterpret_cast<Float4>(reinterpret_cast<Int4>(x) & 0x7fffffff);
}

/// Returns x with its third lane in the fourth lane too.
[[gnu::always_inline]] inline Float4 without_fourth(Float4 x) { return __builtin_shufflevector(x, x, 0, 1, 2, 2); }

[[gnu::always_inline]] inline Float4 with_fourth(Float4 x, float fourth) {
  return __builtin_shufflevector(x, all_lanes(fourth), 0, 1, 2, 4);
}

/// Returns the maximum lane of each of the four vectors.
[[gnu::always_inline]] inline Float4 max_lanes(Float4 a, Float4 b, Float4 c, Float4 d) {
  const Float4 ab = max(__builtin_shufflevector(a, b, 0, 4, 1, 5), __builtin_shufflevector(a, b, 2, 6, 3, 7));
  const Float4 cd = max(__builtin_shufflevector(c, d, 0, 4, 1, 5), __builtin_shufflevector(c, d, 2, 6, 3, 7));
  return max(__builtin_shufflevector(ab, cd, 0, 1, 4, 5), __builtin_shufflevector(ab, cd, 2, 3, 6, 7));
}

/// Returns the minimum of all lanes, in every lane.
[[gnu::always_inline]] inline Float4 min_lane(Float4 x) {
  const Float4 pairs = min(x, __builtin_shufflevector(x, x, 1, 0, 3, 2));
  return min(pairs, __builtin_shufflevector(pairs, pairs, 2, 3, 0, 1));
}

/// Returns the maximum of all lanes, in every lane.
[[gnu::always_inline]] inline Float4 max_lane(Float4 x) {
  const Float4 pairs = max(x, __builtin_shufflevector(x, x, 1, 0, 3, 2));
  return max(pairs, __builtin_shufflevector(pairs, pairs, 2, 3, 0, 1));
}

/// Returns the sum of all lanes.
[[gnu::always_inline]] inline float sum_of(Float4 x) {
  const Float4 pairs = x + __builtin_shufflevector(x, x, 2, 3, 0, 1);
  return pairs[0] + pairs[1];
}

/// Returns the sum of the first three lanes.
[[gnu::always_inline]] inline float sum_of_three(Float4 x) { return x[0] + x[1] + x[2]; }

/// Returns the bits of a mask. Bit k is lane k.
[[gnu::always_inline]] inline std::uint32_t bits_of_lanes(Int4 mask) {
#if defined(__SSE__)
  return static_cast<std::uint32_t>(__builtin_ia32_movmskps(reinterpret_cast<Float4>(mask)));
#else
  const Int4 bits = mask & Int4{1, 2, 4, 8};
  return static_cast<std::uint32_t>(bits[0] | bits[1] | bits[2] | bits[3]);
#endif
}

[[gnu::always_inline]] inline bool any_lane(Int4 mask) {
#if defined(__SSE__)
  return bits_of_lanes(mask) != 0;
#else
  using Long2 = std::int64_t __attribute__((vector_size(16)));
  const auto halves = reinterpret_cast<Long2>(mask);
  return (halves[0] | halves[1]) != 0;
#endif
}

/// Returns whether the maximum lane of a is greater than the minimum lane of b. It is faster than to compute both.
[[gnu::always_inline]] inline bool any_lane_exceeds_any(Float4 a, Float4 b) {
  const Int4 next = a > __builtin_shufflevector(b, b, 1, 2, 3, 0);
  const Int4 second = a > __builtin_shufflevector(b, b, 2, 3, 0, 1);
  const Int4 third = a > __builtin_shufflevector(b, b, 3, 0, 1, 2);
  return any_lane((a > b) | next | second | third);
}

}  // namespace surehit::detail
