#include "exact/compact_int.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <cstdint>

#include "support/case_count.hpp"
#include "support/random.hpp"

namespace surehit::test::compact_int_test {
namespace {

using detail::CompactInt;
using detail::WideInt;

template <int B>
mpz_class value_of(const CompactInt<B>& x) {
  const WideInt<B> wide = x.widened();
  mpz_class result = 0;
  for (int limb = (wide.bit_length() + 63) / 64 - 1; limb >= 0; --limb) {
    result = (result << 64) + mpz_class(static_cast<unsigned long>(wide.bits_from(64 * limb)));
  }
  return wide.sign() < 0 ? mpz_class(-result) : result;
}

/// Any length up to B bits. Zeros and numbers of ones alone are common.
template <int B>
CompactInt<B> draw(Random& random) {
  const int bits = static_cast<int>(random.between(0, B));
  CompactInt<B> result;
  for (int lowest = 0; lowest < bits; lowest += 64) {
    std::uint64_t limb = random.one_in(3) ? ~std::uint64_t{0} : random.bits();
    if (bits - lowest < 64) limb &= (std::uint64_t{1} << (bits - lowest)) - 1;
    result.add(CompactInt<B>::shifted(limb, lowest, false));
  }
  if (random.one_in(2)) result.negate();
  return result;
}

TEST(CompactInt, computes_as_integers_of_any_size) {
  Random random(5);
  for (std::size_t i = case_count(20'000); i > 0; --i) {
    const auto a = draw<41>(random);
    const auto b = draw<85>(random);
    const auto c = draw<127>(random);
    const auto d = draw<127>(random);
    const mpz_class x = value_of(a);
    const mpz_class y = value_of(b);
    ASSERT_EQ(value_of(a * b), x * y);
    ASSERT_EQ(value_of(a + b), x + y);
    ASSERT_EQ(value_of(a - b), x - y);
    ASSERT_EQ(a.sign(), sgn(x));
    ASSERT_EQ(a.is_zero(), x == 0);
    ASSERT_EQ(c.compare(d), cmp(value_of(c), value_of(d)) < 0 ? -1 : cmp(value_of(c), value_of(d)) > 0 ? 1 : 0);
    const mpz_class left = abs(value_of(c)) * abs(x);
    const mpz_class right = abs(value_of(d)) * abs(y);
    ASSERT_EQ(compare_products(c, a, d, b), sgn(mpz_class(left - right)));
    ASSERT_EQ(compare_products(c, b, b, c), 0);
    const mpz_class whole = abs(value_of(c)) * abs(value_of(d));
    const mpz_class square = value_of(d) * value_of(d);
    ASSERT_EQ(compare_products(c, d, d, d), sgn(mpz_class(whole - square)));
  }
}

/// Where the products are equal, every carry counts.
TEST(CompactInt, compares_equal_products_of_other_factors) {
  Random random(6);
  for (std::size_t i = case_count(20'000); i > 0; --i) {
    const auto a = draw<126>(random);
    const auto b = draw<126>(random);
    ASSERT_EQ(compare_products(a + a, b, a, b + b), 0);
    const auto c = draw<60>(random);
    const auto d = draw<60>(random);
    const auto e = draw<60>(random);
    ASSERT_EQ(compare_products(c * d, e, c, d * e), 0);
  }
}

TEST(CompactInt, holds_shifted_significands) {
  EXPECT_EQ(value_of(CompactInt<127>::shifted(3, 100, true)), -(mpz_class(3) << 100));
  EXPECT_EQ(value_of(CompactInt<127>::power_of_two(126)), mpz_class(1) << 126);
  EXPECT_TRUE(CompactInt<40>::shifted(0, 39, true).is_zero());
}

}  // namespace
}  // namespace surehit::test::compact_int_test
