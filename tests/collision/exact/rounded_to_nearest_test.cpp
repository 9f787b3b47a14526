#include "exact/rounded_to_nearest.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <cstddef>

#include "support/case_count.hpp"
#include "support/exact_oracle.hpp"
#include "support/random.hpp"
#include "support/same_bits.hpp"
#include "support/scalars.hpp"

namespace surehit::test::rounded_to_nearest_test {
namespace {

template <typename Scalar>
class RoundedToNearest : public testing::Test {
 protected:
  using Limits = std::numeric_limits<Scalar>;

  static void check(std::uint64_t significand, bool more, int exponent, bool negative) {
    mpq_class value(mpz_class(static_cast<unsigned long>(significand)));
    if (more) value += mpq_class(1, 3);
    if (exponent >= 0) {
      mpq_mul_2exp(value.get_mpq_t(), value.get_mpq_t(), static_cast<mp_bitcnt_t>(exponent));
    } else {
      mpq_div_2exp(value.get_mpq_t(), value.get_mpq_t(), static_cast<mp_bitcnt_t>(-exponent));
    }
    if (negative) value = -value;
    EXPECT_TRUE(
        same_bits(detail::rounded_to_nearest<Scalar>(significand, more, exponent, negative), nearest<Scalar>(value)))
        << significand << (more ? " and more" : "") << " 2^" << exponent;
  }

  static int any_exponent(Random& random) {
    return static_cast<int>(random.between(Limits::min_exponent - Limits::digits - 67, Limits::max_exponent - 60));
  }
};
TYPED_TEST_SUITE(RoundedToNearest, Scalars, ScalarNames);

TYPED_TEST(RoundedToNearest, of_63_and_64_bits) {
  Random random(1);
  for (std::size_t i = case_count(50'000); i > 0 && !this->HasFailure(); --i) {
    const std::uint64_t significand = (random.bits() | (std::uint64_t{1} << 63)) >> random.below(2);
    this->check(significand, random.one_in(2), this->any_exponent(random), random.one_in(2));
  }
}

TYPED_TEST(RoundedToNearest, at_ties_and_right_beside_them) {
  Random random(2);
  for (std::size_t i = case_count(50'000); i > 0 && !this->HasFailure(); --i) {
    // Few leading bits and then a run of zeros or ones: halfway cases at every length that denormals leave.
    const int kept = static_cast<int>(random.between(1, 62));
    std::uint64_t significand = (random.bits() | (std::uint64_t{1} << 63)) >> (64 - kept) << (64 - kept);
    significand += std::uint64_t{1} << (63 - kept);
    significand += static_cast<std::uint64_t>(random.between(-1, 1));
    this->check(significand, random.one_in(2), this->any_exponent(random), random.one_in(2));
  }
}

TYPED_TEST(RoundedToNearest, goes_to_infinity_from_half_an_ulp_beyond_the_largest) {
  using Limits = std::numeric_limits<TypeParam>;
  constexpr int exponent = Limits::max_exponent - 64;
  constexpr std::uint64_t halfway = ~std::uint64_t{0} << (63 - Limits::digits);
  EXPECT_EQ(detail::rounded_to_nearest<TypeParam>(halfway - 1, true, exponent, false), Limits::max());
  EXPECT_EQ(detail::rounded_to_nearest<TypeParam>(halfway, false, exponent, false), Limits::infinity());
  EXPECT_EQ(detail::rounded_to_nearest<TypeParam>(halfway, false, exponent, true), -Limits::infinity());
}

TYPED_TEST(RoundedToNearest, underflows_to_positive_zero_from_below_half_the_least_denormal) {
  using Limits = std::numeric_limits<TypeParam>;
  constexpr std::uint64_t one = std::uint64_t{1} << 63;
  constexpr int half = Limits::min_exponent - Limits::digits - 1 - 63;
  EXPECT_TRUE(same_bits(detail::rounded_to_nearest<TypeParam>(one, false, half, true), TypeParam{0}));
  EXPECT_EQ(detail::rounded_to_nearest<TypeParam>(one, true, half, false), Limits::denorm_min());
  EXPECT_TRUE(same_bits(detail::rounded_to_nearest<TypeParam>(one - 1, true, half, true), TypeParam{0}));
  EXPECT_TRUE(same_bits(detail::rounded_to_nearest<TypeParam>(one, true, half - 200, true), TypeParam{0}));
}

}  // namespace
}  // namespace surehit::test::rounded_to_nearest_test
