#pragma once

#include <bit>
#include <cstdint>

/// Arithmetic on magnitudes of any length, for `WideInt`. A function here is compiled once for all bounds.
namespace surehit::detail::limbs {

using Limb = std::uint64_t;

/// A magnitude to read. The lowest limb is first, and the highest one is not zero. Zero has no limbs.
struct Magnitude {
  const Limb* limb = nullptr;
  int size = 0;
};

/// Returns how many limbs are left without leading zeros.
[[nodiscard]] inline int trimmed(const Limb* limb, int size) {
  while (size > 0 && limb[size - 1] == 0) --size;
  return size;
}

/// Returns the number of bits, which is 0 for zero.
[[nodiscard]] inline int bit_length(Magnitude a) {
  return a.size == 0 ? 0 : 64 * a.size - std::countl_zero(a.limb[a.size - 1]);
}

/// Returns 64 bits, of which bit `lowest` is the lowest. Bits below bit 0 are zero.
[[nodiscard]] Limb bits_from(Magnitude a, int lowest);

/// Returns the sign of a - b.
[[nodiscard]] int compare(Magnitude a, Magnitude b);

/// Returns the sign of a b - c d.
[[nodiscard]] int compare_products(Magnitude a, Magnitude b, Magnitude c, Magnitude d);

/// Writes a b, and returns its size. The result has room for the limbs of both factors, and is neither of them.
[[nodiscard]] int set_product(Limb* result, Magnitude a, Magnitude b);

/// Adds ±other to ±limb. There is room for one limb more than the longer one has.
void add(Limb* limb, int& size, bool& negative, Magnitude other, bool other_negative);

/// Multiplies by 2^count, and returns the size. The caller knows that the product fits into `capacity` limbs.
[[nodiscard]] int shift_left(Limb* limb, int size, int count, int capacity);

/// Returns ±numerator / denominator × 2^exponent, rounded once to nearest, ties to even. Zero is +0. The denominator
/// must not be zero. Both have room for two limbs more than the longer one has, and are overwritten.
template <typename Scalar>
[[nodiscard]] Scalar rounded_quotient(Limb* numerator, int numerator_size, Limb* denominator, int denominator_size,
                                      int exponent, bool negative);

extern template float rounded_quotient(Limb*, int, Limb*, int, int, bool);
extern template double rounded_quotient(Limb*, int, Limb*, int, int, bool);

}  // namespace surehit::detail::limbs
