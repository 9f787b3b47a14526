#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "exact/int128.hpp"
#include "exact/rounded_to_nearest.hpp"
#include "support/inlining.hpp"

namespace surehit::detail {

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

  /// Returns the number of bits of the magnitude, which is 0 for zero.
  [[nodiscard]] int bit_length() const { return size_ == 0 ? 0 : 64 * size_ - std::countl_zero(limb_[size_ - 1]); }

  /// Returns 64 bits of the magnitude, of which bit `lowest` is the lowest. Bits below bit 0 are zero.
  [[nodiscard]] std::uint64_t bits_from(int lowest) const {
    if (lowest < 0) return lowest <= -64 ? 0 : bits_from(0) << -lowest;
    const int at = lowest / 64;
    const int shift = lowest % 64;
    const std::uint64_t low = at < size_ ? limb_[at] >> shift : 0;
    const std::uint64_t high = shift != 0 && at + 1 < size_ ? limb_[at + 1] << (64 - shift) : 0;
    return low | high;
  }

  /// Multiplies by 2^count. The caller must know that the result is below 2^Bits.
  void shift_left(int count) {
    if (size_ == 0 || count == 0) return;
    const int limbs = count / 64;
    const int bits = count % 64;
    for (int i = size_; i >= 0; --i) {
      const std::uint64_t high = i < size_ ? limb_[i] << bits : 0;
      const std::uint64_t low = bits != 0 && i > 0 ? limb_[i - 1] >> (64 - bits) : 0;
      if (i + limbs < capacity) limb_[i + limbs] = high | low;
    }
    std::fill_n(limb_, limbs, std::uint64_t{0});
    size_ = std::min(size_ + limbs + 1, capacity);
    trim();
  }

  template <int A, int B>
  void set_product(const WideInt<A>& a, const WideInt<B>& b) {
    static_assert(A + B <= Bits);
    size_ = 0;
    if (a.is_zero() || b.is_zero()) return;
    size_ = a.size_ + b.size_;
    std::fill_n(limb_, size_, std::uint64_t{0});
    for (int i = 0; i < a.size_; ++i) {
      std::uint64_t carry = 0;
      for (int j = 0; j < b.size_; ++j) {
        const Uint128 sum = Uint128{a.limb_[i]} * b.limb_[j] + limb_[i + j] + carry;
        limb_[i + j] = static_cast<std::uint64_t>(sum);
        carry = static_cast<std::uint64_t>(sum >> 64);
      }
      limb_[i + b.size_] = carry;
    }
    negative_ = a.negative_ != b.negative_;
    trim();
  }

  /// Adds `other`, or subtracts it. The caller must know that the result is below 2^Bits.
  template <int B>
  void add(const WideInt<B>& other, bool subtract = false) {
    static_assert(B <= Bits);
    const bool other_negative = other.negative_ != subtract;
    if (other.size_ == 0) return;
    if (size_ == 0) {
      assign(other);
      negative_ = other_negative;
    } else if (negative_ == other_negative) {
      add_magnitude(other);
    } else if (const int order = compare_magnitude(other); order == 0) {
      size_ = 0;
    } else if (order > 0) {
      subtract_magnitude(limb_, size_, other.limb_, other.size_);
    } else {
      subtract_magnitude(other.limb_, other.size_, limb_, size_);
      negative_ = other_negative;
    }
  }

  /// Sets |this| to |this| - factor × |other|, plus |other| as often as needed to bring it into [0, |other|). Returns
  /// how often that is. The difference must be in (-4 |other|, |other|).
  template <int B>
  int reduce(std::uint64_t factor, const WideInt<B>& other) {
    const int length = std::max(size_, other.size_ + 1);
    std::fill(limb_ + size_, limb_ + length, std::uint64_t{0});
    std::uint64_t borrow = 0;  // This is the product's high half plus the borrow of the subtraction.
    for (int i = 0; i < length; ++i) {
      const Uint128 product = Uint128{factor} * (i < other.size_ ? other.limb_[i] : 0) + borrow;
      const auto low = static_cast<std::uint64_t>(product);
      borrow = static_cast<std::uint64_t>(product >> 64) + (limb_[i] < low ? 1 : 0);
      limb_[i] -= low;
    }
    int times = 0;
    // A negative value is in two's complement here. A carry out of the top limb shows that it is no longer negative.
    for (bool below_zero = borrow != 0; below_zero; ++times) {
      std::uint64_t carry = 0;
      for (int i = 0; i < length; ++i) {
        const Uint128 sum = Uint128{limb_[i]} + (i < other.size_ ? other.limb_[i] : 0) + carry;
        limb_[i] = static_cast<std::uint64_t>(sum);
        carry = static_cast<std::uint64_t>(sum >> 64);
      }
      below_zero = carry == 0;
    }
    size_ = length;
    trim();
    return times;
  }

  /// Returns the sign of |this| - |other|.
  template <int B>
  [[nodiscard]] int compare_magnitude(const WideInt<B>& other) const {
    if (size_ != other.size_) return size_ < other.size_ ? -1 : 1;
    for (int i = size_ - 1; i >= 0; --i) {
      if (limb_[i] != other.limb_[i]) return limb_[i] < other.limb_[i] ? -1 : 1;
    }
    return 0;
  }

  /// Returns digit `index` of |a b|, where a is this number. `carry` holds the carry of the digits below, and then that
  /// of this digit. Products are added by column (Comba 1990), so a product can be read without memory for it.
  template <int B>
  [[nodiscard]] std::uint64_t next_product_digit(const WideInt<B>& b, int index,
                                                 std::array<std::uint64_t, 2>& carry) const {
    Uint128 low = carry[0];
    Uint128 high = carry[1];
    for (int i = std::max(0, index - b.size_ + 1); i < std::min(size_, index + 1); ++i) {
      const Uint128 product = Uint128{limb_[i]} * b.limb_[index - i];
      low += static_cast<std::uint64_t>(product);
      high += static_cast<std::uint64_t>(product >> 64);
    }
    high += low >> 64;
    carry = {static_cast<std::uint64_t>(high), static_cast<std::uint64_t>(high >> 64)};
    return static_cast<std::uint64_t>(low);
  }

  /// Returns the sign of |a b| - |c d|.
  template <int A, int B, int C, int D>
  friend int compare_products(const WideInt<A>& a, const WideInt<B>& b, const WideInt<C>& c, const WideInt<D>& d);

 private:
  template <int>
  friend class WideInt;

  template <int B>
  void assign(const WideInt<B>& other) {
    size_ = other.size_;
    negative_ = other.negative_;
    std::copy_n(other.limb_, size_, limb_);
  }

  void trim() {
    while (size_ > 0 && limb_[size_ - 1] == 0) --size_;
  }

  template <int B>
  void add_magnitude(const WideInt<B>& other) {
    const int longest = std::max(size_, other.size_);
    std::uint64_t carry = 0;
    for (int i = 0; i < longest; ++i) {
      const Uint128 sum = Uint128{i < size_ ? limb_[i] : 0} + (i < other.size_ ? other.limb_[i] : 0) + carry;
      limb_[i] = static_cast<std::uint64_t>(sum);
      carry = static_cast<std::uint64_t>(sum >> 64);
    }
    limb_[longest] = carry;
    size_ = longest + 1;
    trim();
  }

  /// Sets |this| = |large| - |small|. Either may be the limbs of this number.
  void subtract_magnitude(const std::uint64_t* large, int large_size, const std::uint64_t* small, int small_size) {
    std::uint64_t borrow = 0;
    for (int i = 0; i < large_size; ++i) {
      const Uint128 difference = Uint128{large[i]} - (i < small_size ? small[i] : 0) - borrow;
      limb_[i] = static_cast<std::uint64_t>(difference);
      borrow = static_cast<std::uint64_t>(difference >> 64) & 1;
    }
    size_ = large_size;
    trim();
  }

  int size_ = 0;
  bool negative_ = false;
  std::uint64_t limb_[capacity];  ///< The lowest limb is first. Limbs from size_ on are not initialized.
};

template <int A, int B, int C, int D>
int compare_products(const WideInt<A>& a, const WideInt<B>& b, const WideInt<C>& c, const WideInt<D>& d) {
  std::array<std::uint64_t, 2> first_carry = {0, 0};
  std::array<std::uint64_t, 2> second_carry = {0, 0};
  int order = 0;
  for (int index = 0; index < std::max(a.size_ + b.size_, c.size_ + d.size_); ++index) {
    const std::uint64_t first = a.next_product_digit(b, index, first_carry);
    const std::uint64_t second = c.next_product_digit(d, index, second_carry);
    if (first != second) order = first < second ? -1 : 1;  // Higher digits come later and overrule lower ones.
  }
  return order;
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

/// Returns numerator / denominator × 2^exponent, rounded once to nearest, ties to even. Zero is +0. The denominator
/// must not be zero.
///
/// This is one step of Knuth's long division with digits of 64 bits (The Art of Computer Programming 2, section 4.3.1,
/// algorithm D). A shift first gives the quotient 63 or 64 bits. The leading bits then give an estimate, which is at
/// most 3 too large. The remainder corrects it. Of all bits below the quotient, rounding only needs to know whether the
/// remainder is zero.
template <typename Scalar, int N, int D>
[[nodiscard]] SUREHIT_NOINLINE Scalar rounded_quotient(const WideInt<N>& numerator, const WideInt<D>& denominator,
                                                       int exponent = 0) {
  if (numerator.is_zero()) return 0;
  WideInt<std::max(N, D) + 65> n = numerator;
  WideInt<std::max(N, D) + 65> d = denominator;
  const int shift = 63 - (n.bit_length() - d.bit_length());
  if (shift >= 0) {
    n.shift_left(shift);
  } else {
    d.shift_left(-shift);
  }
  const int below = d.bit_length() - 64;
  const Uint128 leading = (Uint128{n.bits_from(below + 64)} << 64) | n.bits_from(below);
  std::uint64_t estimate = quotient(leading, d.bits_from(below));
  estimate -= static_cast<std::uint64_t>(n.reduce(estimate, d));
  const bool negative = (numerator.sign() < 0) != (denominator.sign() < 0);
  return rounded_to_nearest<Scalar>(estimate, !n.is_zero(), exponent - shift, negative);
}

}  // namespace surehit::detail
