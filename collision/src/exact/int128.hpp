#pragma once

#include <compare>
#include <cstdint>

namespace surehit::detail {

// Integers of 128 bits: the compiler's own, or the two classes below where it has none. SUREHIT_PORTABLE_CODE chooses
// the classes everywhere, for the tests.

/// An unsigned integer of 128 bits, in two words. It has those operations of a built-in one that the exact stage needs,
/// and wraps round as that does.
class PortableUint128 {
 public:
  PortableUint128() = default;
  constexpr PortableUint128(std::uint64_t value) : low_(value) {}
  constexpr PortableUint128(std::uint64_t high, std::uint64_t low) : high_(high), low_(low) {}

  [[nodiscard]] constexpr std::uint64_t high() const { return high_; }
  explicit constexpr operator std::uint64_t() const { return low_; }
  explicit constexpr operator std::int64_t() const { return static_cast<std::int64_t>(low_); }

  friend constexpr PortableUint128 operator+(const PortableUint128& x, const PortableUint128& y) {
    const std::uint64_t low = x.low_ + y.low_;
    return {x.high_ + y.high_ + (low < x.low_ ? 1 : 0), low};
  }
  friend constexpr PortableUint128 operator-(const PortableUint128& x, const PortableUint128& y) {
    return {x.high_ - y.high_ - (x.low_ < y.low_ ? 1 : 0), x.low_ - y.low_};
  }
  friend constexpr PortableUint128 operator-(const PortableUint128& x) { return PortableUint128{0} - x; }
  friend constexpr PortableUint128 operator*(const PortableUint128& x, const PortableUint128& y) {
    const PortableUint128 low = product(x.low_, y.low_);
    return {low.high_ + x.high_ * y.low_ + x.low_ * y.high_, low.low_};
  }
  /// The count must be below 128, as for a built-in integer.
  friend constexpr PortableUint128 operator<<(const PortableUint128& x, int count) {
    if (count == 0) return x;
    if (count >= 64) return {x.low_ << (count - 64), 0};
    return {x.high_ << count | x.low_ >> (64 - count), x.low_ << count};
  }
  friend constexpr PortableUint128 operator>>(const PortableUint128& x, int count) {
    if (count == 0) return x;
    if (count >= 64) return {0, x.high_ >> (count - 64)};
    return {x.high_ >> count, x.low_ >> count | x.high_ << (64 - count)};
  }
  friend constexpr PortableUint128 operator|(const PortableUint128& x, const PortableUint128& y) {
    return {x.high_ | y.high_, x.low_ | y.low_};
  }
  constexpr PortableUint128& operator+=(const PortableUint128& other) { return *this = *this + other; }

  friend constexpr bool operator==(const PortableUint128&, const PortableUint128&) = default;
  friend constexpr auto operator<=>(const PortableUint128&, const PortableUint128&) = default;

 private:
  /// Returns the whole product of two words. It is the sum of the products of their halves.
  static constexpr PortableUint128 product(std::uint64_t x, std::uint64_t y) {
    constexpr std::uint64_t half = 0xffffffff;
    const std::uint64_t low = (x & half) * (y & half);
    const std::uint64_t left = (x >> 32) * (y & half);
    const std::uint64_t right = (x & half) * (y >> 32);
    const std::uint64_t middle = (low >> 32) + (left & half) + (right & half);  // below 3 · 2^32
    return {(x >> 32) * (y >> 32) + (left >> 32) + (right >> 32) + (middle >> 32), middle << 32 | (low & half)};
  }

  // Comparisons look at the high word first.
  std::uint64_t high_ = 0;
  std::uint64_t low_ = 0;
};

/// A signed integer of 128 bits, in two's complement.
class PortableInt128 {
 public:
  PortableInt128() = default;
  constexpr PortableInt128(std::int64_t value)
      : bits_(value < 0 ? ~std::uint64_t{0} : 0, static_cast<std::uint64_t>(value)) {}
  explicit constexpr PortableInt128(const PortableUint128& bits) : bits_(bits) {}

  explicit constexpr operator PortableUint128() const { return bits_; }
  explicit constexpr operator std::int64_t() const { return static_cast<std::int64_t>(bits_); }

  friend constexpr PortableInt128 operator+(const PortableInt128& x, const PortableInt128& y) {
    return PortableInt128{x.bits_ + y.bits_};
  }
  friend constexpr PortableInt128 operator-(const PortableInt128& x, const PortableInt128& y) {
    return PortableInt128{x.bits_ - y.bits_};
  }
  friend constexpr PortableInt128 operator-(const PortableInt128& x) { return PortableInt128{-x.bits_}; }
  friend constexpr PortableInt128 operator*(const PortableInt128& x, const PortableInt128& y) {
    return PortableInt128{x.bits_ * y.bits_};
  }

  friend constexpr bool operator==(const PortableInt128&, const PortableInt128&) = default;
  friend constexpr std::strong_ordering operator<=>(const PortableInt128& x, const PortableInt128& y) {
    const auto sign_flipped = [](const PortableInt128& z) { return z.bits_ + PortableUint128{sign_bit, 0}; };
    return sign_flipped(x) <=> sign_flipped(y);
  }

 private:
  static constexpr std::uint64_t sign_bit = std::uint64_t{1} << 63;

  PortableUint128 bits_;
};

/// Returns numerator / divisor, rounded down, bit by bit. The quotient must be below 2^64.
[[nodiscard]] constexpr std::uint64_t portable_quotient(const PortableUint128& numerator, std::uint64_t divisor) {
  std::uint64_t rest = numerator.high();
  std::uint64_t quotient = 0;
  for (int bit = 63; bit >= 0; --bit) {
    const bool carry = rest >> 63 != 0;
    rest = rest << 1 | (static_cast<std::uint64_t>(numerator) >> bit & 1);
    if (!carry && rest < divisor) continue;
    rest -= divisor;
    quotient |= std::uint64_t{1} << bit;
  }
  return quotient;
}

#if defined(__SIZEOF_INT128__) && !defined(SUREHIT_PORTABLE_CODE)

__extension__ typedef unsigned __int128 Uint128;
__extension__ typedef __int128 Int128;

/// Returns numerator / divisor, rounded down. The quotient must be below 2^64.
[[nodiscard]] inline std::uint64_t quotient(Uint128 numerator, std::uint64_t divisor) {
#if defined(_MSC_VER)  // Clang for MSVC's libraries, where none has the function that divides.
  return portable_quotient({static_cast<std::uint64_t>(numerator >> 64), static_cast<std::uint64_t>(numerator)},
                           divisor);
#else
  return static_cast<std::uint64_t>(numerator / divisor);
#endif
}

#else

using Uint128 = PortableUint128;
using Int128 = PortableInt128;

[[nodiscard]] inline std::uint64_t quotient(const Uint128& numerator, std::uint64_t divisor) {
  return portable_quotient(numerator, divisor);
}

#endif

}  // namespace surehit::detail
