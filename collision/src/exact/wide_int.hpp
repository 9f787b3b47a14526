#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "exact/int128.hpp"
#include "exact/limbs.hpp"
#include "support/inlining.hpp"

namespace surehit::detail {

template <int Bits>
class WideInt;

/// Returns numerator / denominator × 2^exponent, rounded once to nearest, ties to even. Zero is +0. The denominator
/// must not be zero.
template <typename Scalar, int N, int D>
[[nodiscard]] Scalar rounded_quotient(const WideInt<N>& numerator, const WideInt<D>& denominator, int exponent = 0);

/// An exact integer below 2^Bits in magnitude. The bound is part of the type and grows with each operation. So no
/// overflow can happen, and none is checked. Only the limbs in use are read or written, so small values are cheap for
/// any bound. Integers do not depend on the floating-point mode.
template <int Bits>
class WideInt {
 public:
  /// One limb more than the bound needs. A sum or a product writes its carry there, and `trim` then drops a zero.
  static constexpr int capacity = (Bits + 63) / 64 + 1;

  WideInt() {}
  WideInt(const WideInt& other) { *this = other; }
  template <int OtherBits>
  requires(OtherBits < Bits) WideInt(const WideInt<OtherBits>& other) { assign(other); }
  WideInt& operator=(const WideInt& other) {
    if (this != &other) assign(other);
    return *this;
  }

  template <int OtherBits>
  requires(OtherBits < Bits) WideInt& operator=(const WideInt<OtherBits>& other) {
    assign(other);
    return *this;
  }

  static WideInt power_of_two(int exponent) {
    WideInt result;
    result.size_ = exponent / 64 + 1;
    std::fill_n(result.limb_, result.size_, std::uint64_t{0});
    result.limb_[exponent / 64] = std::uint64_t{1} << (exponent % 64);
    return result;
  }

  /// Returns ±significand × 2^exponent. The exponent must not be negative.
  static WideInt shifted(std::uint64_t significand, int exponent, bool negative) {
    WideInt result;
    if (significand == 0) return result;
    const int low = exponent / 64;
    std::fill_n(result.limb_, low, std::uint64_t{0});
    const Uint128 wide = Uint128{significand} << (exponent % 64);
    result.limb_[low] = static_cast<std::uint64_t>(wide);
    result.limb_[low + 1] = static_cast<std::uint64_t>(wide >> 64);
    result.size_ = low + 2;
    result.trim();
    result.negative_ = negative;
    return result;
  }

  /// Returns ±magnitude.
  static WideInt of(Uint128 magnitude, bool negative) {
    WideInt result;
    result.limb_[0] = static_cast<std::uint64_t>(magnitude);
    result.limb_[1] = static_cast<std::uint64_t>(magnitude >> 64);
    result.size_ = 2;
    result.trim();
    result.negative_ = negative;
    return result;
  }

  [[nodiscard]] int sign() const { return size_ == 0 ? 0 : negative_ ? -1 : 1; }
  [[nodiscard]] bool is_zero() const { return size_ == 0; }
  void negate() { negative_ = !negative_; }

  [[nodiscard]] limbs::Magnitude magnitude() const { return {limb_, size_}; }

  /// Returns the number of bits of the magnitude, which is 0 for zero.
  [[nodiscard]] int bit_length() const { return limbs::bit_length(magnitude()); }

  /// Returns 64 bits of the magnitude, of which bit `lowest` is the lowest. Bits below bit 0 are zero.
  [[nodiscard]] std::uint64_t bits_from(int lowest) const { return limbs::bits_from(magnitude(), lowest); }

  /// Multiplies by 2^count. The caller must know that the result is below 2^Bits.
  void shift_left(int count) { size_ = limbs::shift_left(limb_, size_, count, capacity); }

  template <int A, int B>
  void set_product(const WideInt<A>& a, const WideInt<B>& b) {
    static_assert(A + B <= Bits);
    size_ = limbs::set_product(limb_, a.magnitude(), b.magnitude());
    negative_ = a.negative_ != b.negative_;
  }

  /// Adds `other`, or subtracts it. The caller must know that the result is below 2^Bits.
  template <int B>
  void add(const WideInt<B>& other, bool subtract = false) {
    static_assert(B <= Bits);
    limbs::add(limb_, size_, negative_, other.magnitude(), other.negative_ != subtract);
  }

  /// Returns the sign of |this| - |other|.
  template <int B>
  [[nodiscard]] int compare_magnitude(const WideInt<B>& other) const {
    return limbs::compare(magnitude(), other.magnitude());
  }

 private:
  template <int>
  friend class WideInt;
  template <typename Scalar, int N, int D>
  friend Scalar rounded_quotient(const WideInt<N>& numerator, const WideInt<D>& denominator, int exponent);

  template <int B>
  void assign(const WideInt<B>& other) {
    size_ = other.size_;
    negative_ = other.negative_;
    std::copy_n(other.limb_, size_, limb_);
  }

  void trim() { size_ = limbs::trimmed(limb_, size_); }

  int size_ = 0;
  bool negative_ = false;
  std::uint64_t limb_[capacity];  ///< The lowest limb is first. Limbs from size_ on are not initialized.
};

/// Returns the sign of |a b| - |c d|.
template <int A, int B, int C, int D>
[[nodiscard]] int compare_products(const WideInt<A>& a, const WideInt<B>& b, const WideInt<C>& c, const WideInt<D>& d) {
  return limbs::compare_products(a.magnitude(), b.magnitude(), c.magnitude(), d.magnitude());
}

/// True for the exact integers, whose bound is part of the type.
template <template <int> class Int>
constexpr bool is_exact_int = false;
template <>
inline constexpr bool is_exact_int<WideInt> = true;

template <template <int> class Int, int A, int B>
requires is_exact_int<Int>
[[nodiscard]] Int<A + B> operator*(const Int<A>& a, const Int<B>& b) {
  Int<A + B> result;
  result.set_product(a, b);
  return result;
}

template <template <int> class Int, int A, int B>
requires is_exact_int<Int>
[[nodiscard]] Int<std::max(A, B) + 1> operator+(const Int<A>& a, const Int<B>& b) {
  Int<std::max(A, B) + 1> result = a;
  result.add(b);
  return result;
}

template <template <int> class Int, int A, int B>
requires is_exact_int<Int>
[[nodiscard]] Int<std::max(A, B) + 1> operator-(const Int<A>& a, const Int<B>& b) {
  Int<std::max(A, B) + 1> result = a;
  result.add(b, true);
  return result;
}

/// A finite Scalar as ±significand × 2^exponent. The significand is odd, except for zero, which is 0 × 2^0.
template <typename Scalar>
struct Decomposed {
  using Word = std::conditional_t<sizeof(Scalar) == 4, std::uint32_t, std::uint64_t>;
  static constexpr int stored_bits = std::numeric_limits<Scalar>::digits - 1;
  static constexpr int exponent_bits = static_cast<int>(8 * sizeof(Scalar)) - 1 - stored_bits;
  /// The smallest denormal is 2^min_exponent: 2^-149 for float and 2^-1074 for double.
  static constexpr int min_exponent = std::numeric_limits<Scalar>::min_exponent - std::numeric_limits<Scalar>::digits;

  /// Reads the bits of x, so flush-to-zero cannot change the result.
  explicit Decomposed(Scalar x) {
    const Word word = std::bit_cast<Word>(x);
    const Word fraction = word & ((Word{1} << stored_bits) - 1);
    const int biased = static_cast<int>((word >> stored_bits) & ((Word{1} << exponent_bits) - 1));
    negative = (word >> (8 * sizeof(Scalar) - 1)) != 0;
    significand = biased == 0 ? fraction : fraction | (Word{1} << stored_bits);
    if (significand == 0) return;
    const int zeros = std::countr_zero(significand);
    significand >>= zeros;
    exponent = min_exponent + std::max(biased, 1) - 1 + zeros;
  }

  std::uint64_t significand = 0;
  int exponent = 0;
  bool negative = false;
};

template <typename Scalar, int N, int D>
SUREHIT_NOINLINE Scalar rounded_quotient(const WideInt<N>& numerator, const WideInt<D>& denominator, int exponent) {
  WideInt<std::max(N, D) + 65> n = numerator;
  WideInt<std::max(N, D) + 65> d = denominator;
  return limbs::rounded_quotient<Scalar>(n.limb_, n.size_, d.limb_, d.size_, exponent, n.negative_ != d.negative_);
}

}  // namespace surehit::detail
