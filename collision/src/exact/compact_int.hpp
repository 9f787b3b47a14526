#pragma once

#include <cstdint>
#include <type_traits>

#include "exact/int128.hpp"
#include "exact/wide_int.hpp"
#include "support/inlining.hpp"

namespace surehit::detail {

/// An exact integer below 2^Bits in magnitude, in one number of 64 or 128 bits. It has the functions of `WideInt` that
/// the exact stage needs. The bound is part of the type and grows with each operation.
template <int Bits>
class CompactInt {
 public:
  static_assert(Bits <= 127);
  using Value = std::conditional_t<(Bits < 64), std::int64_t, Int128>;

  CompactInt() = default;
  template <int OtherBits>
  requires(OtherBits < Bits) CompactInt(const CompactInt<OtherBits>& other) : value_(other.value_) {}

  /// Returns ±significand × 2^exponent. The exponent must not be negative.
  static CompactInt shifted(std::uint64_t significand, int exponent, bool negative) {
    CompactInt result;
    result.value_ = static_cast<Value>(Uint128{significand} << exponent);
    if (negative) result.negate();
    return result;
  }
  static CompactInt of(std::int64_t value) {
    CompactInt result;
    result.value_ = value;
    return result;
  }
  static CompactInt power_of_two(int exponent) { return shifted(1, exponent, false); }

  [[nodiscard]] int sign() const { return (value_ > 0) - (value_ < 0); }
  [[nodiscard]] bool is_zero() const { return value_ == 0; }
  void negate() { value_ = -value_; }

  template <int A, int B>
  void set_product(const CompactInt<A>& a, const CompactInt<B>& b) {
    static_assert(A + B <= Bits);
    value_ = static_cast<Value>(Int128{a.value_} * b.value_);
  }
  /// Adds `other`, or subtracts it. The caller must know that the result is below 2^Bits.
  template <int B>
  void add(const CompactInt<B>& other, bool subtract = false) {
    static_assert(B <= Bits);
    value_ = subtract ? value_ - Value{other.value_} : value_ + Value{other.value_};
  }

  /// Returns the same number as a wide integer.
  [[nodiscard]] WideInt<Bits> widened() const { return WideInt<Bits>::of(magnitude(), value_ < 0); }

  /// Returns the sign of this - other.
  [[nodiscard]] int compare(const CompactInt& other) const { return (value_ > other.value_) - (value_ < other.value_); }
  /// Returns the sign of |a b| - |c d|.
  template <int A, int B, int C, int D>
  friend int compare_products(const CompactInt<A>& a, const CompactInt<B>& b, const CompactInt<C>& c,
                              const CompactInt<D>& d);

 private:
  template <int>
  friend class CompactInt;

  [[nodiscard]] Uint128 magnitude() const {
    const Uint128 value = static_cast<Uint128>(Int128{value_});
    return value_ < 0 ? -value : value;
  }

  Value value_ = 0;
};

/// Returns the sign of |a b| - |c d|.
template <int A, int B, int C, int D>
int compare_products(const CompactInt<A>& a, const CompactInt<B>& b, const CompactInt<C>& c, const CompactInt<D>& d) {
  /// A product of 256 bits.
  struct Product {
    Uint128 high, low;
  };
  const auto product = [](Uint128 x, Uint128 y) -> Product {
    const auto half = [](Uint128 z) { return static_cast<std::uint64_t>(z); };
    const Uint128 low = Uint128{half(x)} * half(y);
    const Uint128 left = Uint128{half(x >> 64)} * half(y);
    const Uint128 right = Uint128{half(x)} * half(y >> 64);
    const Uint128 middle = (low >> 64) + half(left) + half(right);
    return {Uint128{half(x >> 64)} * half(y >> 64) + (left >> 64) + (right >> 64) + (middle >> 64),
            middle << 64 | half(low)};
  };
  const Product x = product(a.magnitude(), b.magnitude());
  const Product y = product(c.magnitude(), d.magnitude());
  if (x.high != y.high) return x.high < y.high ? -1 : 1;
  return (x.low > y.low) - (x.low < y.low);
}

template <>
inline constexpr bool is_exact_int<CompactInt> = true;

/// Returns the number as a wide integer.
template <int B>
const WideInt<B>& wide(const WideInt<B>& x) {
  return x;
}
template <int B>
WideInt<B> wide(const CompactInt<B>& x) {
  return x.widened();
}

/// Does the same as `rounded_quotient` of wide integers.
template <typename Scalar, int N, int D>
[[nodiscard]] SUREHIT_NOINLINE Scalar rounded_quotient(const CompactInt<N>& numerator, const CompactInt<D>& denominator,
                                                       int exponent = 0) {
  return rounded_quotient<Scalar>(numerator.widened(), denominator.widened(), exponent);
}

}  // namespace surehit::detail
