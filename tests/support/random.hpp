#pragma once

#include <bit>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace surehit::test {

/// SplitMix64 (Steele, Lea and Flood 2014). Neither libm nor a std:: distribution is asked, so every platform draws the
/// same. Draws of one expression are in braces or in statements of their own, since compilers evaluate arguments in
/// different orders.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  /// 0 … count - 1, for a count far below 2^64.
  std::uint64_t below(std::uint64_t count) { return bits() % count; }

  /// low … high, both included.
  std::int64_t between(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(below(static_cast<std::uint64_t>(high - low) + 1));
  }

  bool one_in(std::uint64_t count) { return below(count) == 0; }

  /// [0, 1), all bits of the significand drawn. Every step is exact, so the caller's rounding mode does not matter.
  template <typename Scalar>
  Scalar unit() {
    constexpr int digits = std::numeric_limits<Scalar>::digits;
    constexpr Scalar ulp = std::numeric_limits<Scalar>::epsilon() / 2;
    return static_cast<Scalar>(static_cast<std::int64_t>(bits() >> (64 - digits))) * ulp;
  }

  /// [-1, 1)
  template <typename Scalar>
  Scalar symmetric() {
    return 2 * unit<Scalar>() - 1;
  }

  /// Any finite number, every bit pattern alike: mostly very large and very small ones.
  template <typename Scalar>
  Scalar any_finite() {
    using Bits = std::conditional_t<sizeof(Scalar) == 4, std::uint32_t, std::uint64_t>;
    for (;;) {
      const Scalar x = std::bit_cast<Scalar>(static_cast<Bits>(bits()));
      if (x - x == 0) return x;
    }
  }

 private:
  std::uint64_t state_;
};

}  // namespace surehit::test
