#include "exact/int128.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>

#include "support/case_count.hpp"
#include "support/random.hpp"

namespace surehit::test::int128_test {
namespace {

using detail::portable_quotient;
using detail::PortableInt128;
using detail::PortableUint128;

__extension__ typedef unsigned __int128 Native;
__extension__ typedef __int128 SignedNative;

Native value_of(const PortableUint128& x) { return Native{x.high()} << 64 | static_cast<std::uint64_t>(x); }
SignedNative value_of(const PortableInt128& x) {
  return static_cast<SignedNative>(value_of(static_cast<PortableUint128>(x)));
}

/// Words of zeros, of ones and with one bit are common: carries and borrows run through those.
std::uint64_t draw_word(Random& random) {
  switch (random.below(5)) {
    case 0:
      return 0;
    case 1:
      return ~std::uint64_t{0};
    case 2:
      return std::uint64_t{1} << random.below(64);
    case 3:
      return (std::uint64_t{1} << random.below(64)) - 1;
    default:
      return random.bits();
  }
}
PortableUint128 draw(Random& random) {
  const std::uint64_t high = draw_word(random);
  return {high, draw_word(random)};
}

TEST(PortableUint128, computes_as_the_built_in_integer) {
  Random random(1);
  for (std::size_t i = case_count(100'000); i > 0; --i) {
    const PortableUint128 x = draw(random);
    const PortableUint128 y = random.one_in(8) ? x : draw(random);
    const Native a = value_of(x);
    const Native b = value_of(y);
    ASSERT_TRUE(value_of(x + y) == a + b);
    ASSERT_TRUE(value_of(x - y) == a - b);
    ASSERT_TRUE(value_of(x * y) == a * b);
    ASSERT_TRUE(value_of(x | y) == (a | b));
    ASSERT_TRUE(value_of(-x) == -a);
    const int count = static_cast<int>(random.below(128));
    ASSERT_TRUE(value_of(x << count) == a << count) << count;
    ASSERT_TRUE(value_of(x >> count) == a >> count) << count;
    ASSERT_EQ(x == y, a == b);
    ASSERT_EQ(x < y, a < b);
    ASSERT_EQ(x > y, a > b);
    PortableUint128 sum = x;
    sum += y;
    ASSERT_TRUE(value_of(sum) == a + b);
    ASSERT_EQ(static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(a));
    ASSERT_EQ(static_cast<std::int64_t>(x), static_cast<std::int64_t>(a));
  }
}

TEST(PortableInt128, computes_as_the_built_in_integer) {
  Random random(2);
  for (std::size_t i = case_count(100'000); i > 0; --i) {
    const PortableUint128 x_bits = draw(random);
    const PortableUint128 y_bits = random.one_in(8) ? x_bits : draw(random);
    const PortableInt128 x{x_bits};
    const PortableInt128 y{y_bits};
    const Native a = value_of(x_bits);
    const Native b = value_of(y_bits);
    ASSERT_TRUE(static_cast<Native>(value_of(x + y)) == a + b);
    ASSERT_TRUE(static_cast<Native>(value_of(x - y)) == a - b);
    ASSERT_TRUE(static_cast<Native>(value_of(x * y)) == a * b);
    ASSERT_TRUE(static_cast<Native>(value_of(-x)) == -a);
    ASSERT_EQ(x == y, value_of(x) == value_of(y));
    ASSERT_EQ(x < y, value_of(x) < value_of(y));
    ASSERT_EQ(x > y, value_of(x) > value_of(y));
    ASSERT_EQ(x < 0, value_of(x) < 0);
    ASSERT_EQ(static_cast<std::int64_t>(x), static_cast<std::int64_t>(value_of(x)));
  }
}

TEST(PortableInt128, is_made_from_a_word_with_its_sign) {
  Random random(3);
  for (std::size_t i = case_count(10'000); i > 0; --i) {
    const auto word = static_cast<std::int64_t>(draw_word(random));
    ASSERT_TRUE(value_of(PortableInt128{word}) == SignedNative{word});
  }
}

TEST(PortableQuotient, is_that_of_the_built_in_integers) {
  Random random(4);
  for (std::size_t i = case_count(100'000); i > 0; --i) {
    const std::uint64_t divisor = draw_word(random);
    if (divisor == 0) continue;
    const PortableUint128 numerator{draw_word(random) % divisor, draw_word(random)};
    ASSERT_EQ(portable_quotient(numerator, divisor), static_cast<std::uint64_t>(value_of(numerator) / divisor));
    if (divisor > 1) {  // right below a whole multiple, and at it
      const PortableUint128 multiple = PortableUint128{divisor} * PortableUint128{divisor - 1};
      ASSERT_EQ(portable_quotient(multiple, divisor), divisor - 1);
      ASSERT_EQ(portable_quotient(multiple - 1, divisor), divisor - 2);
    }
  }
}

}  // namespace
}  // namespace surehit::test::int128_test
