#include "exact/wide_int.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <utility>

#include "support/case_count.hpp"
#include "support/exact_oracle.hpp"
#include "support/random.hpp"
#include "support/same_bits.hpp"
#include "support/scalars.hpp"

namespace surehit::test::wide_int_test {
namespace {

using detail::Decomposed;
using detail::WideInt;

template <int B>
mpz_class value_of(const WideInt<B>& x) {
  mpz_class result = 0;
  for (int limb = (x.bit_length() + 63) / 64 - 1; limb >= 0; --limb) {
    result = (result << 64) + mpz_class(static_cast<unsigned long>(x.bits_from(64 * limb)));
  }
  return x.sign() < 0 ? mpz_class(-result) : result;
}

/// Any length up to `max_bits`. Limbs of ones and of zeros are common: carries and borrows run far through those.
template <int B>
WideInt<B> draw(Random& random, int max_bits = B) {
  WideInt<B> result;
  const int bits = static_cast<int>(random.between(0, max_bits));
  for (int lowest = 0; lowest < bits; lowest += 64) {
    const std::uint64_t kind = random.below(4);
    std::uint64_t limb = kind == 0 ? 0 : kind == 1 ? ~std::uint64_t{0} : random.bits();
    if (bits - lowest < 64) limb &= (std::uint64_t{1} << (bits - lowest)) - 1;
    result.add(WideInt<B>::shifted(limb, lowest, false));
  }
  if (random.one_in(2)) result.negate();
  return result;
}

mpq_class times_power_of_two(const mpz_class& x, int exponent) {
  mpq_class result = x;
  if (exponent >= 0) {
    mpq_mul_2exp(result.get_mpq_t(), result.get_mpq_t(), static_cast<mp_bitcnt_t>(exponent));
  } else {
    mpq_div_2exp(result.get_mpq_t(), result.get_mpq_t(), static_cast<mp_bitcnt_t>(-exponent));
  }
  return result;
}

/// The bounds, in bits, of two operands.
template <int A, int B>
struct Bounds {
  static constexpr int a = A;
  static constexpr int b = B;
};

template <typename Bounds>
class WideIntOperations : public testing::Test {
 protected:
  static constexpr int a = Bounds::a;
  static constexpr int b = Bounds::b;

  template <typename Check>
  void for_each_pair(Check&& check) {
    Random random(static_cast<std::uint64_t>(a + b));
    for (std::size_t i = case_count(5'000); i > 0 && !this->HasFailure(); --i) {
      check(draw<a>(random), draw<b>(random), random);
    }
  }
};

using AllBounds = testing::Types<Bounds<1, 1>, Bounds<64, 64>, Bounds<65, 63>, Bounds<278, 279>, Bounds<839, 560>,
                                 Bounds<2099, 2100>, Bounds<6306, 4202>>;
TYPED_TEST_SUITE(WideIntOperations, AllBounds);

TYPED_TEST(WideIntOperations, add) {
  this->for_each_pair(
      [](const auto& x, const auto& y, Random&) { EXPECT_EQ(value_of(x + y), value_of(x) + value_of(y)); });
}

TYPED_TEST(WideIntOperations, subtract) {
  this->for_each_pair([](const auto& x, const auto& y, Random&) {
    EXPECT_EQ(value_of(x - y), value_of(x) - value_of(y));
    EXPECT_TRUE((x - x).is_zero());
    EXPECT_EQ((x - x).sign(), 0);
  });
}

TYPED_TEST(WideIntOperations, multiply) {
  this->for_each_pair(
      [](const auto& x, const auto& y, Random&) { EXPECT_EQ(value_of(x * y), value_of(x) * value_of(y)); });
}

TYPED_TEST(WideIntOperations, overwrite_longer_values) {
  this->for_each_pair([](const auto& x, const auto& y, Random& random) {
    auto result = draw<TestFixture::a + TestFixture::b>(random);
    result.set_product(x, y);
    EXPECT_EQ(value_of(result), value_of(x) * value_of(y));
    auto sum = draw<TestFixture::a + TestFixture::b>(random);
    sum = x;
    EXPECT_EQ(value_of(sum), value_of(x));
  });
}

TYPED_TEST(WideIntOperations, compare_magnitudes_and_signs) {
  this->for_each_pair([](const auto& x, const auto& y, Random&) {
    const mpz_class x_value = value_of(x);
    const mpz_class y_value = value_of(y);
    EXPECT_EQ(x.compare_magnitude(y), sgn(mpz_class(abs(x_value) - abs(y_value))));
    EXPECT_EQ(x.compare_magnitude(x), 0);
    EXPECT_EQ(x.sign(), sgn(x_value));
    EXPECT_EQ(x.is_zero(), x_value == 0);
    EXPECT_EQ(static_cast<std::size_t>(x.bit_length()), x_value == 0 ? 0 : mpz_sizeinbase(x_value.get_mpz_t(), 2));
  });
}

TYPED_TEST(WideIntOperations, shift_left) {
  this->for_each_pair([](const auto& x, const auto&, Random& random) {
    WideInt<TestFixture::a + TestFixture::b> shifted = x;
    const int count = static_cast<int>(random.between(0, TestFixture::a + TestFixture::b - x.bit_length()));
    shifted.shift_left(count);
    EXPECT_EQ(value_of(shifted), value_of(x) << static_cast<mp_bitcnt_t>(count));
  });
}

TYPED_TEST(WideIntOperations, bits_from_any_place) {
  this->for_each_pair([](const auto& x, const auto&, Random& random) {
    const int lowest = static_cast<int>(random.between(-70, TestFixture::a + 70));
    mpz_class expected = abs(value_of(x));
    expected = lowest < 0 ? mpz_class(expected << static_cast<mp_bitcnt_t>(-lowest))
                          : mpz_class(expected >> static_cast<mp_bitcnt_t>(lowest));
    mpz_fdiv_r_2exp(expected.get_mpz_t(), expected.get_mpz_t(), 64);
    EXPECT_EQ(mpz_class(static_cast<unsigned long>(x.bits_from(lowest))), expected);
  });
}

template <typename Scalar>
class RoundedQuotient : public testing::Test {
 protected:
  using Limits = std::numeric_limits<Scalar>;

  template <int N, int D>
  static void check(const WideInt<N>& numerator, const WideInt<D>& denominator, int exponent) {
    const mpq_class quotient = times_power_of_two(value_of(numerator), exponent) / mpq_class(value_of(denominator));
    const Scalar rounded = detail::rounded_quotient<Scalar>(numerator, denominator, exponent);
    EXPECT_TRUE(same_bits(rounded, nearest<Scalar>(quotient)))
        << value_of(numerator) << " / " << value_of(denominator) << " 2^" << exponent;
  }

  /// An exponent that brings the quotient near `place`.
  template <int N, int D>
  static int exponent_to(int place, const WideInt<N>& numerator, const WideInt<D>& denominator) {
    return place - numerator.bit_length() + denominator.bit_length();
  }

  template <int N, int D>
  static void check_random_quotients() {
    Random random(N + D);
    for (std::size_t i = case_count(20'000); i > 0 && !testing::Test::HasFailure(); --i) {
      const auto numerator = draw<N>(random);
      const auto denominator = draw<D>(random);
      if (denominator.is_zero()) continue;
      const auto place = random.between(Limits::min_exponent - Limits::digits - 4, Limits::max_exponent + 4);
      check(numerator, denominator, exponent_to(static_cast<int>(place), numerator, denominator));
      check(numerator, denominator, 0);
    }
  }
};
TYPED_TEST_SUITE(RoundedQuotient, Scalars, ScalarNames);

TYPED_TEST(RoundedQuotient, of_words) { (TestFixture::template check_random_quotients<64, 64>()); }
TYPED_TEST(RoundedQuotient, of_long_by_short) { (TestFixture::template check_random_quotients<2100, 70>()); }
TYPED_TEST(RoundedQuotient, of_short_by_long) { (TestFixture::template check_random_quotients<70, 2100>()); }
TYPED_TEST(RoundedQuotient, of_long_by_long) { (TestFixture::template check_random_quotients<4202, 4202>()); }

TYPED_TEST(RoundedQuotient, of_zero_is_positive_zero) {
  WideInt<64> zero;
  zero.negate();
  EXPECT_TRUE(same_bits(detail::rounded_quotient<TypeParam>(zero, WideInt<64>::shifted(3, 0, true)), TypeParam{0}));
}

TYPED_TEST(RoundedQuotient, at_ties_and_right_beside_them) {
  using Limits = std::numeric_limits<TypeParam>;
  Random random(1);
  for (std::size_t i = case_count(20'000); i > 0 && !this->HasFailure(); --i) {
    auto denominator = draw<500>(random);
    if (denominator.is_zero()) continue;
    // An odd number of halves of a last place, in [2^digits, 2^(digits + 1)): halfway between two neighbours.
    const std::uint64_t halves = (random.bits() >> (64 - Limits::digits)) | (std::uint64_t{1} << Limits::digits) | 1;
    WideInt<600> numerator = denominator * WideInt<64>::shifted(halves, 0, random.one_in(2));
    if (random.one_in(2)) {
      numerator.add(WideInt<1>::shifted(1, 0, random.one_in(2)));
    }
    this->check(numerator, denominator,
                static_cast<int>(random.between(Limits::min_exponent - 2 * Limits::digits, Limits::max_exponent)) -
                    Limits::digits);
  }
}

TYPED_TEST(RoundedQuotient, at_half_the_least_denormal) {
  const auto one = WideInt<64>::shifted(1, 0, false);
  const auto almost_one = WideInt<200>::power_of_two(150) - one;
  const auto above_one = WideInt<200>::power_of_two(150) + one;
  constexpr int half = Decomposed<TypeParam>::min_exponent - 1;
  EXPECT_EQ(detail::rounded_quotient<TypeParam>(one, one, half), 0);
  EXPECT_EQ(detail::rounded_quotient<TypeParam>(almost_one, one, half - 150), 0);
  EXPECT_EQ(detail::rounded_quotient<TypeParam>(above_one, one, half - 150),
            std::numeric_limits<TypeParam>::denorm_min());
}

template <typename Scalar>
class DecomposedNumber : public testing::Test {};
TYPED_TEST_SUITE(DecomposedNumber, Scalars, ScalarNames);

TYPED_TEST(DecomposedNumber, is_the_number_with_an_odd_significand) {
  Random random(5);
  for (std::size_t i = case_count(20'000); i > 0; --i) {
    const auto x = random.any_finite<TypeParam>();
    const Decomposed<TypeParam> parts(x);
    ASSERT_TRUE(parts.significand % 2 == 1 || x == 0);
    ASSERT_EQ(parts.negative, std::signbit(x));
    const mpq_class magnitude =
        times_power_of_two(mpz_class(static_cast<unsigned long>(parts.significand)), parts.exponent);
    ASSERT_EQ(parts.negative ? mpq_class(-magnitude) : magnitude, mpq_class(double{x}));
  }
}

TYPED_TEST(DecomposedNumber, of_zero_has_no_place) {
  for (const TypeParam zero : {TypeParam{0}, -TypeParam{0}}) {
    EXPECT_EQ(Decomposed<TypeParam>(zero).significand, 0u);
    EXPECT_EQ(Decomposed<TypeParam>(zero).exponent, 0);
  }
}

}  // namespace
}  // namespace surehit::test::wide_int_test
