#include "mesh_io/parse_number.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <type_traits>

#include "error_of.hpp"
#include "support/case_count.hpp"
#include "support/random.hpp"

namespace surehit::test::parse_number_test {
namespace {

using example::parse_integer;
using example::parse_number;
using example::parse_number_or_non_finite;

template <typename Scalar>
std::string hex_of(Scalar value) {
  char text[64];
  std::snprintf(text, sizeof text, "%a", static_cast<double>(value));
  return text;
}

/// The C library's own parser, which rounds to nearest as well but shares no code with ours.
float nearest(const std::string& text, float) { return std::strtof(text.c_str(), nullptr); }
double nearest(const std::string& text, double) { return std::strtod(text.c_str(), nullptr); }

template <typename Scalar>
class ParseNumber : public testing::Test {
 protected:
  using Limits = std::numeric_limits<Scalar>;

  static void expect_parses_to(Scalar expected, const std::string& text) {
    Scalar parsed = 0;
    ASSERT_NO_THROW(parsed = parse_number<Scalar>(text)) << text;
    EXPECT_EQ(hex_of(parsed), hex_of(expected)) << text;
  }

  static void expect_beyond(const std::string& text) {
    const std::string error = error_of([&] { return parse_number<Scalar>(text); });
    EXPECT_NE(error.find("is beyond the largest"), std::string::npos) << text << ": " << error;
  }

  static void expect_as_the_c_library_parses(const std::string& text) {
    const Scalar expected = nearest(text, Scalar{});
    if (std::isinf(expected)) {
      expect_beyond(text);
    } else {
      expect_parses_to(expected, text);
    }
  }

  /// All digits of the number half-way between the magnitudes of x and of its neighbour away from zero. long double
  /// holds it.
  static std::string half_way_above(Scalar x) {
    const Scalar neighbour = std::nextafter(x, std::copysign(Limits::infinity(), x));
    const long double middle = (static_cast<long double>(x) + static_cast<long double>(neighbour)) / 2;
    char text[1400];
    std::snprintf(text, sizeof text, "%.1200Le", middle);
    return text;
  }

  static std::string just_above(std::string number) { return number.replace(last_digit(number) + 1, 4, "0001"); }

  static std::string just_below(std::string number) {
    const std::size_t last = last_digit(number);
    const char less = static_cast<char>(number[last] - 1);
    return number.replace(last, 5, less + std::string("9999"));
  }

  /// The last digit of the significand that is not 0: far fewer than the digits written follow.
  static std::size_t last_digit(const std::string& number) {
    return number.find_last_not_of('0', number.find('e') - 1);
  }

  static std::string random_number(Random& random, const std::string& prefix, const std::string& digits, char mark,
                                   int limit) {
    constexpr const char* signs[] = {"", "+", "-"};
    std::string text = signs[random.below(3)] + prefix;
    const std::uint64_t count = 1 + random.below(random.one_in(8) ? 200 : 24);
    const std::uint64_t point = random.below(2 * count);
    for (std::uint64_t i = 0; i < count; ++i) {
      if (i == point) text += '.';
      text += random.one_in(4) ? '0' : digits[random.below(digits.size())];
    }
    if (random.one_in(4)) return text;
    return text + mark + std::to_string(random.between(-limit, limit));
  }
};

using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(ParseNumber, Scalars);

TYPED_TEST(ParseNumber, reads_ordinary_decimals) {
  this->expect_parses_to(0, "0");
  this->expect_parses_to(1, "1");
  this->expect_parses_to(1, "1.");
  this->expect_parses_to(TypeParam{0.5}, ".5");
  this->expect_parses_to(-1500, "-1.5e3");
  this->expect_parses_to(1500, "+1.5E+3");
  this->expect_parses_to(static_cast<TypeParam>(0.1L), "0.1");
  this->expect_parses_to(7, "0000000000000000000000000000000000000000000000000000000000000007");
}

TYPED_TEST(ParseNumber, reads_hex) {
  this->expect_parses_to(TypeParam{0.1875}, "0x1.8p-3");
  this->expect_parses_to(TypeParam{-0.1875}, "-0X1.8P-3");
  this->expect_parses_to(TypeParam{171}, "+0xaB");
  this->expect_parses_to(TypeParam{0.5}, "0x.8");
  this->expect_parses_to(16, "0x8.p+1");
}

TYPED_TEST(ParseNumber, keeps_the_sign_of_zero) {
  for (const char* text : {"-0", "-0.0e9", "-0x0p0", "-1e-9999", "-0x1p-9999", "-0e99999999999999999999"}) {
    this->expect_parses_to(-TypeParam{0}, text);
  }
}

TYPED_TEST(ParseNumber, rounds_what_lies_around_half_way_cases) {
  using Limits = std::numeric_limits<TypeParam>;
  using Bits = std::conditional_t<sizeof(TypeParam) == 4, std::uint32_t, std::uint64_t>;
  Random random(11);
  const std::size_t cases = case_count(3000);
  for (std::size_t i = 0; i < cases; ++i) {
    TypeParam below = random.any_finite<TypeParam>();
    if (random.one_in(3)) below = static_cast<TypeParam>(random.between(-40, 40)) * Limits::denorm_min();
    const TypeParam above = std::nextafter(below, std::copysign(Limits::infinity(), below));
    if (std::isinf(above)) continue;
    const TypeParam even = (std::bit_cast<Bits>(below) & 1) == 0 ? below : above;
    const std::string half_way = this->half_way_above(below);
    this->expect_parses_to(even, half_way);
    this->expect_parses_to(above, this->just_above(half_way));
    this->expect_parses_to(below, this->just_below(half_way));
    ASSERT_FALSE(this->HasFailure());
  }
}

TYPED_TEST(ParseNumber, rounds_around_half_of_the_least_denormal) {
  const TypeParam least = std::numeric_limits<TypeParam>::denorm_min();
  const std::string half = this->half_way_above(0);
  for (const std::string sign : {"", "-"}) {
    const TypeParam one = sign.empty() ? TypeParam{1} : TypeParam{-1};
    this->expect_parses_to(0 * one, sign + half);
    this->expect_parses_to(0 * one, sign + this->just_below(half));
    this->expect_parses_to(least * one, sign + this->just_above(half));
  }
  const std::string half_exponent = std::to_string(std::ilogb(least) - 1);
  this->expect_parses_to(0, "0x1p" + half_exponent);
  this->expect_parses_to(0, "0x0.ffffffffffffffffffffffffffp" + half_exponent);
  this->expect_parses_to(least, "0x1.00000000000000000000000001p" + half_exponent);
}

TYPED_TEST(ParseNumber, rounds_what_is_far_below_the_least_denormal_to_zero) {
  for (const char* text : {"1e-400", "1e-99999999999999999999", "0x1p-9999", "0x1p-99999999999999999999",
                           "123456789012345678901234567890e-9999", "0.0000000001e-400",
                           "0xffffffffffffffffffffffffffffffp-9223372036854775808"}) {
    this->expect_parses_to(0, text);
  }
}

TYPED_TEST(ParseNumber, reads_up_to_the_greatest_number_and_rejects_what_rounds_beyond) {
  using Limits = std::numeric_limits<TypeParam>;
  const TypeParam greatest = Limits::max();
  // Half an ulp above the greatest number: from there on, to nearest is infinity.
  const bool is_float = Limits::digits == 24;
  const std::string limit = is_float ? "0x0.ffffff8" : "0x0.fffffffffffffc";
  const std::string just_below = is_float ? "0x0.ffffff7fffffffffffffff" : "0x0.fffffffffffffbffffffffffffff";
  const std::string exponent = "p" + std::to_string(Limits::max_exponent);
  this->expect_parses_to(greatest, just_below + exponent);
  this->expect_parses_to(-greatest, "-" + just_below + exponent);
  this->expect_beyond(limit + exponent);
  this->expect_beyond("-" + limit + exponent);
  this->expect_beyond("0x1" + exponent);

  // The same limit in all its decimal digits.
  char digits[400];
  std::snprintf(digits, sizeof digits, "%.0Lf", std::strtold((limit + exponent).c_str(), nullptr));
  std::string decimal_limit = digits;
  this->expect_beyond(decimal_limit);
  decimal_limit.back() = static_cast<char>(decimal_limit.back() - 1);
  this->expect_parses_to(greatest, decimal_limit);
}

TYPED_TEST(ParseNumber, rejects_what_is_far_beyond_the_greatest_number) {
  for (const char* text : {"1e400", "-1e400", "1e99999999999999999999", "0x1p9999", "0x1p+99999999999999999999",
                           "0.0000000001e+500", "0x.0000000000000000001p9223372036854775807"}) {
    this->expect_beyond(text);
  }
  this->expect_beyond("1" + std::string(400, '0'));
  this->expect_beyond("0x1" + std::string(400, '0'));
}

TYPED_TEST(ParseNumber, lets_an_exponent_make_up_for_many_zeros) {
  this->expect_parses_to(1, "1" + std::string(1000, '0') + "e-1000");
  this->expect_parses_to(1, "0." + std::string(999, '0') + "1e1000");
  this->expect_parses_to(1, "0x1" + std::string(1000, '0') + "p-4000");
  this->expect_parses_to(1, "0x." + std::string(999, '0') + "1p4000");
}

TYPED_TEST(ParseNumber, agrees_with_the_c_library_on_random_decimals) {
  Random random(21);
  const std::size_t cases = case_count(200000);
  const int limit = std::numeric_limits<TypeParam>::max_exponent10 * 5 / 4;
  for (std::size_t i = 0; i < cases && !this->HasFailure(); ++i) {
    this->expect_as_the_c_library_parses(this->random_number(random, "", "0123456789", 'e', limit));
  }
}

TYPED_TEST(ParseNumber, agrees_with_the_c_library_on_random_hex) {
  Random random(22);
  const std::size_t cases = case_count(200000);
  const int limit = std::numeric_limits<TypeParam>::max_exponent * 5 / 4;
  for (std::size_t i = 0; i < cases && !this->HasFailure(); ++i) {
    this->expect_as_the_c_library_parses(this->random_number(random, "0x", "0123456789abcdefABCDEF", 'p', limit));
  }
}

TYPED_TEST(ParseNumber, rejects_what_is_no_number) {
  for (const char* text : {"",      "+",      "-",
                           ".",     "-.",     "e5",
                           "1e",    "1e+",    "1.2.3",
                           "1,5",   "1 ",     " 1",
                           "--1",   "+-1",    "-+1",
                           "0x",    "0x.",    "0xg",
                           "0x1p",  "0x-1",   "0x0x1",
                           "1p3",   "0x1e-3", "nan",
                           "NaN",   "-nan",   "nan(1)",
                           "inf",   "-inf",   "infinity",
                           "0xinf", "1f",     "1e99999999999999999999x",
                           "one"}) {
    EXPECT_EQ(error_of([&] { return parse_number<TypeParam>(text); }), example::quoted(text) + " is not a number");
  }
}

TYPED_TEST(ParseNumber, rejects_non_finite_numbers_as_old_windows_spells_them) {
  for (const char* text : {"1.#QNAN", "-1.#QNAN0", "1.#SNAN", "-1.#IND", "-1.#IND00", "1.#INF", "-1.#INF00", "1.#J"}) {
    const std::string error = example::quoted(text) + " is not a number";
    EXPECT_EQ(error_of([&] { return parse_number<TypeParam>(text); }), error);
    EXPECT_EQ(error_of([&] { return parse_number_or_non_finite<TypeParam>(text); }), error);
  }
}

TYPED_TEST(ParseNumber, may_take_what_is_not_finite) {
  for (const char* text : {"nan", "NaN", "NAN", "+nan", "-nan", "nan()", "-nan(ind)", "nan(0x8000)"}) {
    EXPECT_TRUE(std::isnan(parse_number_or_non_finite<TypeParam>(text))) << text;
  }
  constexpr TypeParam infinity = std::numeric_limits<TypeParam>::infinity();
  for (const char* text : {"inf", "Inf", "INF", "+inf", "infinity", "+INFINITY"}) {
    EXPECT_EQ(parse_number_or_non_finite<TypeParam>(text), infinity) << text;
    EXPECT_EQ(parse_number_or_non_finite<TypeParam>("-" + std::string(text).substr(text[0] == '+' ? 1 : 0)), -infinity);
  }
}

TYPED_TEST(ParseNumber, takes_finite_numbers_as_before_where_it_may_take_others) {
  EXPECT_EQ(parse_number_or_non_finite<TypeParam>("-1.5e3"), -1500);
  EXPECT_EQ(parse_number_or_non_finite<TypeParam>("+0x1.8p1"), 3);
  const std::string beyond = error_of([] { return parse_number_or_non_finite<TypeParam>("-1e400"); });
  EXPECT_NE(beyond.find("'-1e400' is beyond the largest "), std::string::npos) << beyond;
  for (const char* text : {"", "-", "n", "i", "in", "na", "nanx", "nan(", "nan)", "-nan(", "infinit", "infinity1",
                           "--inf", "+-nan", "- nan", "0xnan", "1inf"}) {
    EXPECT_EQ(error_of([&] { return parse_number_or_non_finite<TypeParam>(text); }),
              example::quoted(text) + " is not a number");
  }
}

TEST(ParseNumberToFloat, does_not_round_to_double_first) {
  // Above half-way between two floats by less than a double can tell: two roundings would go to the even one, below.
  const std::string text = "1.00000005960464477539062500000000000000001";
  EXPECT_EQ(parse_number<double>(text), 0x1.000001p0);
  EXPECT_EQ(parse_number<float>(text), 0x1.000002p0f);
  EXPECT_EQ(parse_number<float>("0x1.0000010000000000000000001"), 0x1.000002p0f);
}

TEST(ParseNumberMessage, names_the_type_that_is_too_small) {
  EXPECT_EQ(error_of([] { return parse_number<float>("1e39"); }), "'1e39' is beyond the largest float");
  EXPECT_EQ(error_of([] { return parse_number<double>("-1e309"); }), "'-1e309' is beyond the largest double");
}

TEST(ParseNumberMessage, stays_one_short_line) {
  EXPECT_EQ(error_of([] { return parse_number<float>("\x1b[31m\xff"); }), "'?[31m?' is not a number");
  EXPECT_EQ(error_of([] { return parse_number<float>(std::string(100, 'x')); }),
            "'" + std::string(40, 'x') + "…' is not a number");
}

TEST(ParseInteger, reads_all_of64_bits) {
  EXPECT_EQ(parse_integer("0"), 0);
  EXPECT_EQ(parse_integer("-17"), -17);
  EXPECT_EQ(parse_integer("9223372036854775807"), std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(parse_integer("-9223372036854775808"), std::numeric_limits<std::int64_t>::min());
}

TEST(ParseInteger, rejects_everything_else) {
  for (const char* text : {"", "-", "1.0", "1e3", "0x1", "1 ", "seven"}) {
    EXPECT_EQ(error_of([&] { return parse_integer(text); }), example::quoted(text) + " is not an integer");
  }
  EXPECT_EQ(error_of([] { return parse_integer("9223372036854775808"); }), "'9223372036854775808' is beyond 64 bits");
}

}  // namespace
}  // namespace surehit::test::parse_number_test
