#include "exact/quadratic_root.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include "exact/root_rounding.hpp"
#include "support/case_count.hpp"
#include "support/exact_oracle.hpp"
#include "support/random.hpp"

namespace surehit::test::quadratic_root_test {
namespace {

constexpr int bits = 128;
using Root = detail::QuadraticRoot<bits>;
using Int = detail::WideInt<bits>;

Int integer(std::int64_t x) { return Int::shifted(static_cast<std::uint64_t>(std::abs(x)), 0, x < 0); }

/// A quadratic with real roots, and its lower root in floats.
struct Quadratic {
  std::int64_t a, b, c;
  [[nodiscard]] Root root() const { return {integer(a), integer(b), integer(c)}; }
  [[nodiscard]] bool is_real() const { return a > 0 && b * b >= a * c; }
  [[nodiscard]] mpf_class value() const {
    const mpf_class d(mpz_class(static_cast<long>(b * b - a * c)), 1000);
    return mpf_class((-mpf_class(static_cast<long>(b), 1000) - sqrt(d)) / mpf_class(static_cast<long>(a), 1000));
  }
};

int sign_of(const mpf_class& x) { return abs(x) < 1e-100 ? 0 : sgn(x); }

Quadratic draw(Random& random, std::int64_t size) {
  for (;;) {
    Quadratic q{random.between(1, size), random.between(-size, size), random.between(-size, size)};
    if (q.is_real()) return q;
  }
}

TEST(QuadraticRoot, IsOrderedAsItsValueIs) {
  Random random(1);
  std::array<int, 3> orders = {};
  for (std::size_t i = 0; i < case_count(40000); ++i) {
    const std::int64_t size = std::int64_t{1} << (1 + random.below(9));
    const Quadratic x = draw(random, size);
    Quadratic y = draw(random, size);
    if (random.one_in(3)) y = {x.a * 3, x.b * 3, x.c * 3};  // The same roots.
    if (random.one_in(3)) {
      // A root of x that is rational, and another one of y's own.
      const std::int64_t shared = random.between(-9, 9);
      const std::int64_t other = random.between(-9, 9);
      const Quadratic q{2, -shared - other, 2 * shared * other};
      y = {q.a, q.b, q.c};
      const std::int64_t third = random.between(-9, 9);
      const Quadratic z{2, -shared - third, 2 * shared * third};
      const int order = detail::RootOrder(y.root(), z.root()).sign();
      ASSERT_EQ(order, sign_of(y.value() - z.value())) << shared << ' ' << other << ' ' << third;
      ++orders[static_cast<std::size_t>(order + 1)];
    }
    const int order = detail::RootOrder(x.root(), y.root()).sign();
    ASSERT_EQ(order, sign_of(x.value() - y.value()))
        << x.a << ' ' << x.b << ' ' << x.c << ", " << y.a << ' ' << y.b << ' ' << y.c;
    ++orders[static_cast<std::size_t>(order + 1)];
  }
  for (const int count : orders) EXPECT_GE(count, static_cast<int>(case_count(1000)));
}

TEST(QuadraticRoot, IsComparedWithDyadicNumbers) {
  Random random(2);
  for (std::size_t i = 0; i < case_count(20000); ++i) {
    const Quadratic q = draw(random, 64);
    const auto significand = static_cast<std::uint64_t>(random.between(0, 64));
    const int exponent = -static_cast<int>(random.below(7));
    const mpf_class x(std::ldexp(static_cast<double>(significand), exponent), 1000);
    ASSERT_EQ(q.root().compare<double>({significand, exponent}), sign_of(q.value() - x))
        << q.a << ' ' << q.b << ' ' << q.c << ", " << significand << ' ' << exponent;
  }
}

TEST(QuadraticRoot, IsRoundedToNearest) {
  Random random(3);
  std::size_t rounded = 0;
  for (std::size_t i = 0; i < case_count(20000); ++i) {
    const Quadratic q = draw(random, std::int64_t{1} << (2 + random.below(20)));
    if (q.b >= 0 || q.c <= 0 || q.value() > 1) continue;
    ++rounded;
    const auto check = [&](auto x) {
      using Scalar = decltype(x);
      const mpf_class error = abs(q.value() - mpf_class(double{x}, 1000));
      const mpf_class above = abs(q.value() - mpf_class(double{std::nextafter(x, Scalar{2})}, 1000));
      const mpf_class below = abs(q.value() - mpf_class(double{std::nextafter(x, Scalar{0})}, 1000));
      return error <= above && error <= below;
    };
    ASSERT_TRUE(check(q.root().rounded<float>())) << q.a << ' ' << q.b << ' ' << q.c;
    ASSERT_TRUE(check(q.root().rounded<double>())) << q.a << ' ' << q.b << ' ' << q.c;
    const detail::DoubleRange range = q.root().range();
    ASSERT_TRUE(mpf_class(range.lower, 1000) <= q.value() && q.value() <= mpf_class(range.upper, 1000));
  }
  EXPECT_GE(rounded, case_count(1000));
}

TEST(QuadraticRoot, RoundsTiesToEven) {
  // The root is 1/2 + 2^-25, which is between two floats, and 1/2 + 3 2^-25.
  const auto root_at = [](std::int64_t numerator) {
    const std::int64_t denominator = std::int64_t{1} << 25;
    return Quadratic{denominator, -numerator, 0};
  };
  for (const auto& [numerator, expected] :
       {std::pair{(1 << 24) + 1, 0x1p-1F}, std::pair{(1 << 24) + 3, 0x1.000004p-1F}}) {
    // (t - p/q) (t - 2): q t^2 - (p + 2 q) t + 2 p, with halved middle terms.
    const Quadratic half = root_at(numerator);
    const Quadratic q{2 * half.a, half.b - 2 * half.a, -4 * half.b};
    EXPECT_EQ(q.root().rounded<float>(), expected) << numerator;
  }
}

TEST(RootNumber, IsRoundedToNearest) {
  Random random(4);
  using Number = detail::RootNumber<bits, bits, bits, bits>;
  std::size_t rounded = 0;
  for (std::size_t i = 0; i < case_count(40000); ++i) {
    const std::int64_t size = std::int64_t{1} << (2 + random.below(20));
    const std::int64_t p = random.between(-size, size);
    const std::int64_t q = random.between(-size, size);
    const std::int64_t d = random.between(0, size);
    const std::int64_t r = random.between(1, size);
    const mpf_class value((mpf_class(static_cast<long>(p), 1000) +
                           mpf_class(static_cast<long>(q), 1000) * sqrt(mpf_class(static_cast<long>(d), 1000))) /
                          static_cast<long>(r));
    if (value < 0 || value > 1) continue;
    ++rounded;
    const Number number{integer(p), integer(q), integer(d), integer(r)};
    const auto check = [&](auto x) {
      using Scalar = decltype(x);
      const mpf_class error = abs(value - mpf_class(double{x}, 1000));
      return error <= abs(value - mpf_class(double{std::nextafter(x, Scalar{2})}, 1000)) + 1e-200 &&
             error <= abs(value - mpf_class(double{std::nextafter(x, Scalar{-1})}, 1000)) + 1e-200;
    };
    ASSERT_TRUE(check(number.rounded<float>())) << p << ' ' << q << ' ' << d << ' ' << r;
    ASSERT_TRUE(check(number.rounded<double>())) << p << ' ' << q << ' ' << d << ' ' << r;
  }
  EXPECT_GE(rounded, case_count(1000));
}

TEST(MiddleAbove, IsBetweenTwoScalars) {
  const auto value = [](const detail::Dyadic& x) {
    return mpq_class(mpz_class(static_cast<unsigned long>(x.significand)),
                     mpz_class(1) << static_cast<mp_bitcnt_t>(-x.exponent));
  };
  for (const double x : {0.0, 0x1p-1074, 0x1p-1022, 0x1.fffffffffffffp-1023, 0.1, 0.5, 1 - 0x1p-53}) {
    const mpq_class middle = (mpq_class(x) + mpq_class(std::nextafter(x, 2.0))) / 2;
    EXPECT_EQ(value(detail::middle_above(x)), middle) << x;
  }
  for (const float x : {0.0F, 0x1p-149F, 0x1p-126F, 0x1.fffffcp-127F, 0.1F, 0.5F, 1 - 0x1p-24F}) {
    const mpq_class middle = (mpq_class(double{x}) + mpq_class(double{std::nextafter(x, 2.0F)})) / 2;
    EXPECT_EQ(value(detail::middle_above(x)), middle) << x;
  }
}

}  // namespace
}  // namespace surehit::test::quadratic_root_test
