#include "filter/bounded.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "support/case_count.hpp"
#include "support/random.hpp"

namespace surehit::test::bounded_test {
namespace {

using detail::Bounded;
using detail::exact;
using detail::product_error;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The true value that a Bounded stands for: anywhere within its radius, most often at an end.
mpq_class draw_truth(Random& random, const Bounded& x) {
  const mpq_class radius(x.radius);
  switch (random.below(3)) {
    case 0:
      return mpq_class(x.value) - radius;
    case 1:
      return mpq_class(x.value) + radius;
    default:
      return mpq_class(x.value) + radius * mpq_class(random.symmetric<double>());
  }
}

Bounded draw(Random& random, int min_exponent, int max_exponent) {
  const double value =
      std::ldexp(random.symmetric<double>(), static_cast<int>(random.between(min_exponent, max_exponent)));
  if (random.one_in(4)) return exact(value);
  return {value, std::fabs(value) * std::ldexp(random.unit<double>(), -static_cast<int>(random.between(0, 60)))};
}

bool is_bound(const Bounded& x, const mpq_class& truth) {
  if (!(x.radius < infinity) || !(std::fabs(x.value) < infinity)) return !x.sign().has_value();
  return abs(mpq_class(x.value) - truth) <= mpq_class(x.radius);
}

struct Exponents {
  const char* name;
  int least;
  int greatest;
};

class BoundedOperations : public testing::TestWithParam<Exponents> {
 protected:
  template <typename Check>
  void for_each_pair(Check&& check) {
    Random random(1);
    for (std::size_t i = case_count(100'000); i > 0 && !HasFailure(); --i) {
      const Bounded x = draw(random, GetParam().least, GetParam().greatest);
      const Bounded y = draw(random, GetParam().least, GetParam().greatest);
      check(x, draw_truth(random, x), y, draw_truth(random, y));
    }
  }
};

TEST_P(BoundedOperations, sum_holds_the_true_sum) {
  for_each_pair([](const Bounded& x, const mpq_class& true_x, const Bounded& y, const mpq_class& true_y) {
    EXPECT_TRUE(is_bound(x + y, true_x + true_y));
    EXPECT_TRUE(is_bound(x - y, true_x - true_y));
  });
}

TEST_P(BoundedOperations, product_holds_the_true_product) {
  for_each_pair([](const Bounded& x, const mpq_class& true_x, const Bounded& y, const mpq_class& true_y) {
    EXPECT_TRUE(is_bound(x * y, true_x * true_y));
  });
}

TEST_P(BoundedOperations, certain_sign_is_the_true_sign) {
  for_each_pair([](const Bounded& x, const mpq_class& true_x, const Bounded& y, const mpq_class& true_y) {
    const Bounded result = x * y - y * x + x * (x - y);
    const mpq_class truth = true_x * (true_x - true_y);
    if (const auto sign = result.sign()) {
      EXPECT_EQ(*sign, sgn(truth));
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Exponents, BoundedOperations,
                         testing::Values(Exponents{"alike", -2, 2}, Exponents{"mixed", -300, 300},
                                         Exponents{"products_underflow", -1074, -500},
                                         Exponents{"denormal", -1074, -1015}, Exponents{"overflowing", 480, 1024}),
                         [](const auto& exponents) { return exponents.param.name; });

TEST(Bounded, exact_operations_keep_a_radius_of_zero) {
  const Bounded product = (exact(3) - exact(0x1p-30)) * (exact(5) + exact(0x1p-10));
  EXPECT_EQ(product.radius, 0);
  EXPECT_EQ(product.value, (3 - 0x1p-30) * (5 + 0x1p-10));
  EXPECT_EQ((product - product).sign(), 0);
}

TEST(Bounded, rounded_operations_have_a_radius) {
  EXPECT_GT((exact(1) + exact(0x1p-60)).radius, 0);
  EXPECT_GT((exact(1 + 0x1p-40) * exact(1 + 0x1p-40)).radius, 0);
  EXPECT_EQ((exact(1) + exact(0x1p-60) - exact(1)).sign(), std::nullopt);
}

TEST(Bounded, radius_is_no_larger_than_a_few_roundings) {
  EXPECT_LE((exact(1) + exact(0x1p-60)).radius, 0x1p-59);
  EXPECT_LE((exact(1 + 0x1p-40) * exact(1 + 0x1p-40)).radius, 0x1p-79);
}

TEST(Bounded, product_error_is_that_of_a_fused_multiply_add) {
  Random random(2);
  std::size_t rounded = 0;
  for (std::size_t i = case_count(300'000); i > 0; --i) {
    const auto draw_number = [&] {
      if (random.one_in(20)) return 0.0;
      const int exponent = static_cast<int>(random.between(-1074, 1023));
      const double number = std::ldexp(random.symmetric<double>(), random.one_in(2) ? exponent : exponent / 32);
      return random.one_in(4) ? static_cast<double>(static_cast<float>(number)) : number;
    };
    const double a = draw_number();
    const double b = draw_number();
    const double product = a * b;
    const double error = product_error(a, b, product);
    const double expected = std::fma(a, b, -product);
    rounded += expected != 0;
    if (std::isnan(expected)) {
      ASSERT_FALSE(error == error) << a << ' ' << b;
    } else {
      ASSERT_EQ(error, expected) << a << ' ' << b;
    }
  }
  EXPECT_GT(rounded, case_count(100'000));
}

TEST(Bounded, product_that_underflows_to_zero_is_not_a_certain_zero) {
  const Bounded product = exact(0x1p-600) * exact(0x1p-600);
  EXPECT_EQ(product.value, 0);
  EXPECT_EQ(product.sign(), std::nullopt);
}

TEST(Bounded, product_with_zero_is_a_certain_zero) {
  EXPECT_EQ((exact(0) * exact(1e308)).sign(), 0);
  EXPECT_EQ((exact(5e-324) * exact(-0.0)).sign(), 0);
}

TEST(Bounded, overflow_makes_nothing_certain) {
  const Bounded largest = exact(std::numeric_limits<double>::max());
  for (const Bounded& overflown : std::vector<Bounded>{
           largest + largest, largest * largest, -largest - largest, (largest + largest) - (largest + largest),
           (largest * largest) * exact(0), (largest + largest) + exact(1)}) {
    EXPECT_EQ(overflown.sign(), std::nullopt);
  }
}

TEST(Bounded, sign_is_certain_only_outside_the_radius) {
  EXPECT_EQ((Bounded{1, 0.5}.sign()), 1);
  EXPECT_EQ((Bounded{-1, 0.5}.sign()), -1);
  EXPECT_EQ((Bounded{1, 1}.sign()), std::nullopt);
  EXPECT_EQ((Bounded{-1, 1}.sign()), std::nullopt);
  EXPECT_EQ((Bounded{0, 0x1p-1074}.sign()), std::nullopt);
  EXPECT_EQ((Bounded{0, 0}.sign()), 0);
}

}  // namespace
}  // namespace surehit::test::bounded_test
