#include "support/floating_point_environment.hpp"

#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>
#include <limits>

#include "support/floating_point_mode.hpp"

namespace surehit::test::floating_point_environment_test {
namespace {

/// The arguments are volatile, so that the sum is taken in the environment of the call and not by the compiler.
double sum(double x, double y) {
  const volatile double left = x;
  const volatile double right = y;
  return left + right;
}

double product(double x, double y) {
  const volatile double left = x;
  const volatile double right = y;
  return left * right;
}

constexpr double least = std::numeric_limits<double>::denorm_min();

/// What the library's proofs rest on.
void expect_default_environment() {
  EXPECT_EQ(sum(1, 0x1p-60), 1);
  EXPECT_EQ(sum(-1, -0x1p-60), -1);
  EXPECT_EQ(sum(1, -0x1p-60), 1);
  EXPECT_EQ(product(0x1p-1000, 0x1p-74), least);
  EXPECT_EQ(product(least, 2), 2 * least);
}

TEST(FloatingPointEnvironmentTest, leaves_the_default_alone) {
  const auto before = control_word();
  {
    const FloatingPointEnvironment environment;
    EXPECT_EQ(control_word(), before);
  }
  EXPECT_EQ(control_word(), before);
}

TEST(FloatingPointEnvironmentTest, leaves_sticky_flags_of_the_default_alone) {
  std::feclearexcept(FE_ALL_EXCEPT);
  std::feraiseexcept(FE_DIVBYZERO);
  {
    const FloatingPointEnvironment environment;
    EXPECT_EQ(std::fetestexcept(FE_ALL_EXCEPT), FE_DIVBYZERO);
    std::feraiseexcept(FE_INVALID);
  }
  EXPECT_EQ(std::fetestexcept(FE_ALL_EXCEPT), FE_DIVBYZERO | FE_INVALID);
  std::feclearexcept(FE_ALL_EXCEPT);
}

TEST(FloatingPointEnvironmentTest, rounds_to_nearest_under_every_rounding_mode) {
  for (const int rounding : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    const FloatingPointModeScope mode({"rounding", rounding, false});
    const auto before = control_word();
    {
      const FloatingPointEnvironment environment;
      expect_default_environment();
    }
    EXPECT_EQ(control_word(), before);
  }
}

TEST(FloatingPointEnvironmentTest, puts_back_the_sticky_flags_of_the_caller) {
  const FloatingPointModeScope mode({"upward", FE_UPWARD, false});
  std::feclearexcept(FE_ALL_EXCEPT);
  std::feraiseexcept(FE_OVERFLOW);
  const auto before = control_word();
  {
    const FloatingPointEnvironment environment;
    EXPECT_EQ(sum(1, 0x1p-60), 1);
    // An operation raises this flag. Some systems' functions raise it in the registers of the x87 too.
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(std::isnan(sum(infinity, -infinity)));
  }
  EXPECT_EQ(control_word(), before);
  EXPECT_EQ(std::fetestexcept(FE_ALL_EXCEPT), FE_OVERFLOW);
}

TEST(FloatingPointEnvironmentTest, nests_without_any_effect) {
  const FloatingPointModeScope mode({"downward", FE_DOWNWARD, false});
  {
    const FloatingPointEnvironment outer;
    {
      const FloatingPointEnvironment inner;
      expect_default_environment();
    }
    expect_default_environment();
  }
  EXPECT_EQ(sum(1, -0x1p-60), 1 - 0x1p-53);
}

#if defined(__SSE2__)

TEST(FloatingPointEnvironmentTest, keeps_denormals_where_the_caller_flushes_them) {
  const FloatingPointModeScope mode({"flushing", FE_TONEAREST, true});
  ASSERT_EQ(product(0x1p-1000, 0x1p-74), 0);
  ASSERT_EQ(product(least, 0x1p100), 0);
  const auto before = control_word();
  {
    const FloatingPointEnvironment environment;
    expect_default_environment();
  }
  EXPECT_EQ(control_word() & ~std::uint64_t{0x3f}, before & ~std::uint64_t{0x3f});
  EXPECT_EQ(product(0x1p-1000, 0x1p-74), 0);
  EXPECT_EQ(product(least, 0x1p100), 0);
}

/// Each of the two alone, for a test of both could pass on one of them.
TEST(FloatingPointEnvironmentTest, sees_each_bit_of_the_control_word) {
  const unsigned before = _mm_getcsr();
  constexpr unsigned sticky_flags = 0x3f;
  for (unsigned bit = 0x40; bit <= 0x8000; bit <<= 1) {
    // No exception is pending, so that one that is not masked does not strike here.
    const unsigned changed = (before ^ bit) & ~sticky_flags;
    _mm_setcsr(changed);
    unsigned inside = 0;
    {
      const FloatingPointEnvironment environment;
      inside = _mm_getcsr();
    }
    const unsigned after = _mm_getcsr();
    _mm_setcsr(before);
    EXPECT_EQ(inside, 0x1f80U) << std::hex << bit;
    EXPECT_EQ(after, changed) << std::hex << bit;
  }
}

TEST(FloatingPointEnvironmentTest, does_not_trap) {
  const unsigned before = _mm_getcsr();
  _mm_setcsr(0);  // every exception would strike
  double infinity = 0;
  {
    const FloatingPointEnvironment environment;
    infinity = product(1e300, 1e300);
  }
  _mm_setcsr(before);
  EXPECT_EQ(infinity, std::numeric_limits<double>::infinity());
}

#endif

}  // namespace
}  // namespace surehit::test::floating_point_environment_test
