#pragma once

#include <bit>
#include <cstdint>
#include <limits>

#include "exact/scaled_double.hpp"
#include "exact/wide_int.hpp"
#include "support/inlining.hpp"

namespace surehit::detail {

/// The nonnegative number significand × 2^exponent.
struct Dyadic {
  std::uint64_t significand = 0;  ///< It has at most 54 bits.
  int exponent = 0;               ///< The power of two that it is multiplied by.
};

/// Returns the number in the middle between a nonnegative finite Scalar and the next greater one.
template <typename Scalar>
[[nodiscard]] Dyadic middle_above(Scalar x) {
  using Parts = Decomposed<Scalar>;
  const auto word = std::bit_cast<typename Parts::Word>(x);
  const std::uint64_t fraction = word & ((typename Parts::Word{1} << Parts::stored_bits) - 1);
  const int biased = static_cast<int>(word >> Parts::stored_bits);
  const std::uint64_t significand = biased == 0 ? fraction : fraction | (std::uint64_t{1} << Parts::stored_bits);
  return {2 * significand + 1, Parts::min_exponent + (biased == 0 ? 1 : biased) - 2};
}

/// Returns a number in [0, 1], rounded once to nearest, ties to even. `range` has bounds of the number. `compare(x)`
/// returns the sign of the number less a dyadic x, exactly. It is asked once for each bisection of what lies between
/// the rounded bounds.
template <typename Scalar, typename Compare>
[[nodiscard]] Scalar round_between(const DoubleRange& range, const Compare& compare) {
  using Word = typename Decomposed<Scalar>::Word;
  const auto word_of = [](double x) { return std::bit_cast<Word>(static_cast<Scalar>(x < 1 ? x : 1.0)); };
  Word low = word_of(range.lower > 0 ? range.lower : 0.0);  // Nonnegative Scalars are in the order of their words.
  Word high = word_of(range.upper);
  while (low < high) {
    const Word word = low + (high - low) / 2;
    const int sign = compare(middle_above(std::bit_cast<Scalar>(word)));
    if (sign == 0) return std::bit_cast<Scalar>(static_cast<Word>(word + (word & 1)));
    if (sign > 0) {
      low = word + 1;
    } else {
      high = word;
    }
  }
  return std::bit_cast<Scalar>(low);
}

/// Returns the sign of x + y √d, where d must not be negative.
template <int X, int Y, int D>
[[nodiscard]] SUREHIT_NOINLINE int sign_with_root(const WideInt<X>& x, const WideInt<Y>& y, const WideInt<D>& d) {
  const int of_x = x.sign();
  const int of_y = y.sign() * d.sign();
  if (of_x == of_y || of_y == 0) return of_x;
  if (of_x == 0) return of_y;
  const WideInt<2 * X> left = x * x;
  WideInt<2 * Y + D> right;
  {
    const WideInt<2 * Y> square = y * y;
    right.set_product(square, d);
  }
  return of_x * left.compare_magnitude(right);
}

/// The number (p + q √d) / r, with d ≥ 0 and r > 0.
template <int P, int Q, int D, int R>
struct RootNumber {
  WideInt<P> p;  ///< The rational part.
  WideInt<Q> q;  ///< The factor of the root.
  WideInt<D> d;  ///< The radicand.
  WideInt<R> r;  ///< The denominator.

  /// Returns the sign of the number less x, for a midpoint of two Scalars.
  template <typename Scalar>
  [[nodiscard]] SUREHIT_NOINLINE int compare(const Dyadic& x) const {
    constexpr int shift = 1 - Decomposed<Scalar>::min_exponent;
    WideInt<std::max(P + shift, R + 55) + 1> left = p;
    WideInt<Q + shift> factor = q;
    left.shift_left(-x.exponent);  // The midpoint above the largest Scalar below 1 has an exponent below 0 too.
    factor.shift_left(-x.exponent);
    {
      const WideInt<R + 55> product = r * WideInt<55>::shifted(x.significand, 0, false);
      left.add(product, true);
    }
    return sign_with_root(left, factor, d);
  }

  /// Returns bounds of the number, which must not be negative.
  [[nodiscard]] DoubleRange range() const { return range_of(size() / ScaledDouble::of_magnitude(r)); }

  /// Returns |p + q √d|. If p and q √d have opposite signs, they cancel. The conjugate number then gives the same value
  /// without a cancellation: (p² - q² d) / (p - q √d).
  [[nodiscard]] SUREHIT_NOINLINE ScaledDouble size() const {
    const ScaledDouble root = ScaledDouble::of_magnitude(q) * sqrt(ScaledDouble::of_magnitude(d));
    const ScaledDouble sum = ScaledDouble::of_magnitude(p) + root;
    if (p.sign() * q.sign() * d.sign() >= 0) return sum;
    WideInt<std::max(2 * P, 2 * Q + D) + 1> difference = p * p;
    {
      WideInt<2 * Q + D> product;
      {
        const WideInt<2 * Q> square = q * q;
        product.set_product(square, d);
      }
      difference.add(product, true);
    }
    return ScaledDouble::of_magnitude(difference) / sum;
  }

  /// Returns the number, which must be in [0, 1], rounded once to nearest.
  template <typename Scalar>
  [[nodiscard]] Scalar rounded() const {
    return round_between<Scalar>(range(), [&](const Dyadic& x) { return compare<Scalar>(x); });
  }
};

}  // namespace surehit::detail
