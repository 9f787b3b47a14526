#include "shape/exact_direction.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "support/hill_climb.hpp"
#include "support/random.hpp"

namespace surehit::test::exact_direction_test {
namespace {

using Float = mpf_class;
using detail::Direction;
using detail::SignedSize;

constexpr int bits = 120;
using Int = detail::WideInt<bits>;
using Root = detail::QuadraticRoot<bits>;

/// A whole number of up to 120 bits. Few of its bits may be set.
struct Whole {
  std::uint64_t significand;
  int exponent;
  bool is_negative;

  [[nodiscard]] Int integer() const {
    Int sum = Int::shifted(significand >> 20, exponent + 20, is_negative);
    sum.add(Int::shifted(significand & 0xfffff, exponent, is_negative));
    return sum;
  }
  [[nodiscard]] Float number() const {
    Float x(mpz_class(static_cast<unsigned long>(significand)), 1024);
    mpf_mul_2exp(x.get_mpf_t(), x.get_mpf_t(), static_cast<mp_bitcnt_t>(exponent));
    return is_negative ? Float(-x) : x;
  }
};

Whole draw_whole(Random& random) {
  const auto length = static_cast<int>(random.between(1, 64));
  return {random.bits() >> (64 - length), static_cast<int>(random.between(0, 50)), random.one_in(2)};
}
Whole changed_whole(Random& random, Whole x) {
  switch (random.below(4)) {
    case 0:
      return draw_whole(random);
    case 1:
      x.is_negative = !x.is_negative;
      return x;
    case 2:
      x.exponent = std::clamp(x.exponent + static_cast<int>(random.between(-2, 2)), 0, 50);
      return x;
    default:
      x.significand ^= std::uint64_t{1} << random.below(64);
      return x;
  }
}

/// The numbers of x + t y at a root t: those of x, of y, and the three of the quadratic.
using Numbers = std::array<Whole, 9>;

Numbers draw_numbers(Random& random) {
  Numbers numbers;
  for (Whole& x : numbers) x = draw_whole(random);
  return numbers;
}
Numbers changed_numbers(Random& random, Numbers numbers) {
  Whole& x = numbers[random.below(numbers.size())];
  x = changed_whole(random, x);
  return numbers;
}

using Integers = detail::Vector<Int>;
using Point = std::array<Float, 3>;

/// A vector as the library has it, and in long floats.
struct DirectionPair {
  Direction direction;
  Point exact;
};
/// x + t y at the lower root t.
DirectionPair at_root(const Numbers& numbers) {
  const auto& [x0, x1, x2, y0, y1, y2, a_whole, b_whole, c_whole] = numbers;
  const Root root{a_whole.integer(), b_whole.integer(), c_whole.integer()};
  const Float a = a_whole.number();
  const Float b = b_whole.number();
  const Float discriminant = b * b - a * c_whole.number();
  const auto component = [&](std::size_t i) {
    const Float rational = a * numbers[i].number() - b * numbers[3 + i].number();
    return Float(rational - numbers[3 + i].number() * sqrt(discriminant));
  };
  return {direction_at(root, Integers{x0.integer(), x1.integer(), x2.integer()},
                       Integers{y0.integer(), y1.integer(), y2.integer()}),
          {component(0), component(1), component(2)}};
}
bool has_roots(const Numbers& numbers) {
  const auto& [x0, x1, x2, y0, y1, y2, a, b, c] = numbers;
  return a.number() > 0 && b.number() * b.number() >= a.number() * c.number();
}

/// x itself.
DirectionPair of_integers(const Numbers& numbers) {
  const auto& [x, y, z] = std::array{numbers[0], numbers[1], numbers[2]};
  return {detail::direction_of(Integers{x.integer(), y.integer(), z.integer()}), {x.number(), y.number(), z.number()}};
}

/// Returns the share of 9 eps by which components are off (N1).
double share_of_sizes(const DirectionPair& pair) {
  double worst = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& [sign, size] = pair.direction[i];
    EXPECT_EQ(sign, abs(pair.exact[i]) < 1e-100 ? 0 : sgn(pair.exact[i]));
    if (sign == 0) continue;
    Float value(sign * size.value, 1024);
    if (size.exponent >= 0) {
      mpf_mul_2exp(value.get_mpf_t(), value.get_mpf_t(), static_cast<mp_bitcnt_t>(size.exponent));
    } else {
      mpf_div_2exp(value.get_mpf_t(), value.get_mpf_t(), static_cast<mp_bitcnt_t>(-size.exponent));
    }
    worst = std::max(worst, Float(abs(value / pair.exact[i] - 1) / (9 * 0x1p-53)).get_d());
  }
  return worst;
}

/// Returns the share of 12 eps by which components of the unit vector are off (N2).
double share_of_unit(const DirectionPair& pair) {
  const auto& [x, y, z] = pair.exact;
  const Float length = sqrt(x * x + y * y + z * z);
  if (length < 1e-100) return 0;
  const Vector3<double> unit = detail::unit_of<double>(pair.direction);
  double worst = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Float error = abs(pair.exact[i] / length - unit[static_cast<Eigen::Index>(i)]);
    worst = std::max(worst, Float(error / (12 * 0x1p-53)).get_d());
  }
  return worst;
}

template <typename ShareOf>
double worst_share(std::uint64_t seed, const ShareOf& share_of) {
  Random random(seed);
  return climb_to_worst(
      10, 1000, [&] { return draw_numbers(random); },
      [&](const Numbers& numbers) { return changed_numbers(random, numbers); }, share_of);
}

double at_root_share(const Numbers& numbers, double (*share_of)(const DirectionPair&)) {
  return has_roots(numbers) ? share_of(at_root(numbers)) : 0;
}

TEST(ExactDirection, of_integers_stays_within_its_bound) {
  const auto share_of = [](const Numbers& numbers) { return share_of_sizes(of_integers(numbers)); };
  expect_within_bound("N1_of_integers", worst_share(167, share_of));
}

TEST(ExactDirection, at_a_root_stays_within_its_bound) {
  const auto share_of = [](const Numbers& numbers) { return at_root_share(numbers, share_of_sizes); };
  expect_within_bound("N1", worst_share(173, share_of));
}

TEST(ExactDirection, of_length_one_stays_within_its_bound) {
  const auto share_of = [](const Numbers& numbers) { return at_root_share(numbers, share_of_unit); };
  expect_within_bound("N2", worst_share(179, share_of));
}

}  // namespace
}  // namespace surehit::test::exact_direction_test
