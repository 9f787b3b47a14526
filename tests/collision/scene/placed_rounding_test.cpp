// How close the intervals of hits of placed paths come to their exact numbers (I15). Rationals tell what is exact.

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "collision/filter/coordinate_changes.hpp"
#include "collision/filter/on_every_instruction_set.hpp"
#include "collision/rational_determinants.hpp"
#include "exact_matrix.hpp"
#include "place_lanes_on_targets.hpp"
#include "support/exact_oracle.hpp"
#include "support/hill_climb.hpp"
#include "support/instruction_sets.hpp"
#include "support/random.hpp"

namespace surehit::test::placed_rounding_test {
namespace {

/// The number of a hit.
enum class Number : std::size_t { t, u, v };

/// A computed path, how far off it is in shares of its errors, and a triangle.
struct Hit {
  detail::CertainPath path;
  Vector3<double> start_share, direction_share;
  Triangle<double> triangle;

  /// Returns the hit where a number is larger by `step`.
  [[nodiscard]] Hit moved(Number number, double step) const {
    Hit next = *this;
    if (number == Number::t) {
      next.path.moved_t += step;
      return next;
    }
    const Vector3<double> edge = (number == Number::u ? triangle.b : triangle.c) - triangle.a;
    for (std::size_t i = 0; i < 3; ++i) next.path.start[i] += step * edge[static_cast<Eigen::Index>(i)];
    return next;
  }
};

Vector3<double> vector(Random& random, double size) {
  const double x = size * random.symmetric<double>();
  const double y = size * random.symmetric<double>();
  return {x, y, size * random.symmetric<double>()};
}

/// Draws a path that meets a triangle at t from 0 to 1. It may be off by the whole of its errors.
Hit draw_hit(Random& random) {
  Hit hit;
  hit.triangle = {vector(random, 1), vector(random, 1), vector(random, 1)};
  const double u = random.unit<double>();
  const double v = (1 - u) * random.unit<double>();
  const auto& [a, b, c] = hit.triangle;
  const Vector3<double> point = a + u * (b - a) + v * (c - a);
  const Vector3<double> direction = vector(random, 4);
  const Vector3<double> start = point - direction * random.symmetric<double>() / 4;
  for (std::size_t i = 0; i < 3; ++i) {
    hit.path.start[i] = start[static_cast<Eigen::Index>(i)];
    hit.path.direction[i] = direction[static_cast<Eigen::Index>(i)];
  }
  // In many cases, one of the errors is all that there is.
  const auto error = [&] {
    return random.one_in(3) ? 0x1p-100 : std::ldexp(1.0, -static_cast<int>(random.between(38, 50)));
  };
  hit.path.start_error = error();
  hit.path.direction_error = error();
  hit.path.moved_t = random.one_in(4) ? 0 : random.unit<double>();
  const auto share = [&] { return random.one_in(4) ? random.symmetric<double>() : random.one_in(2) ? 1.0 : -1.0; };
  for (auto* const shares : {&hit.start_share, &hit.direction_share}) {
    for (double& x : *shares) x = share();
  }
  return hit;
}

/// Returns the hit with another number.
Hit changed(Hit hit, Random& random) {
  std::vector<double*> numbers = {&hit.path.moved_t};
  for (auto* const corner : {&hit.triangle.a, &hit.triangle.b, &hit.triangle.c}) {
    for (double& x : *corner) numbers.push_back(&x);
  }
  for (double& x : hit.path.start) numbers.push_back(&x);
  for (double& x : hit.path.direction) numbers.push_back(&x);
  if (random.one_in(3)) {
    Vector3<double>& shares = random.one_in(2) ? hit.start_share : hit.direction_share;
    double& x = shares[static_cast<Eigen::Index>(random.below(3))];
    x = -x;
  } else if (random.one_in(4)) {
    double& error = random.one_in(2) ? hit.path.start_error : hit.path.direction_error;
    error = std::clamp(error * std::exp2(random.symmetric<double>()), 0x1p-200, 0x1p-38);
  } else {
    double& x = *numbers[random.below(numbers.size())];
    x = changed_coordinate(random, x);
  }
  return hit;
}

/// Returns the exact t, u and v. There are none if the path is parallel to the triangle.
std::vector<mpq_class> exact_numbers(const Hit& hit) {
  const auto off = [](const Vector3<double>& shares, double error) { return mpq_class(error) * exact(shares); };
  const RationalDeterminants of = rational_determinants(
      exact(hit.path.start) + off(hit.start_share, hit.path.start_error),
      exact(hit.path.direction) + off(hit.direction_share, hit.path.direction_error), hit.triangle);
  if (of.det == 0) return {};
  return {of.height / of.det + mpq_class(hit.path.moved_t), of.u / of.det, of.v / of.det};
}

PlacedHit rounded(const Hit& hit) {
  PlacedHit of;
  round_placed_hits({&hit.path, 1}, {&hit.triangle, 1}, {&of, 1});
  return of;
}

/// Moves a number of a hit to the middle between two floats, and away from it on both sides until it is rounded. There,
/// an end of its interval is at the middle. Returns how far the exact number is off the middle of the interval, in half
/// its width: 1 if it is at an end of it.
double share_of_interval(const Hit& hit, Number number) {
  const auto which = static_cast<std::size_t>(number);
  const std::vector<mpq_class> numbers = exact_numbers(hit);
  if (numbers.empty() || abs(numbers[which]) > 2 || abs(numbers[which]) < mpq_class(0x1p-4)) return 0;
  const auto below = nearest<float>(numbers[which]);
  const float above = std::nextafter(below, 3.0F);
  const mpq_class tie = (mpq_class(double{below}) + mpq_class(double{above})) / 2;
  const double at_tie = mpq_class(tie - numbers[which]).get_d();
  const auto is_rounded = [&](double step) { return rounded(hit.moved(number, at_tie + step)).is_rounded; };
  // It is not certain on which side of the tie the exact number is.
  if (is_rounded(0)) return std::numeric_limits<double>::infinity();
  mpq_class gaps[2];
  for (const int side : {0, 1}) {
    const double sign = side == 0 ? -1 : 1;
    double outside = 0x1p-54;
    while (outside < 0x1p-30 && !is_rounded(sign * outside)) outside *= 2;
    if (outside >= 0x1p-30) return 0;
    double inside = outside / 2;
    for (int i = 0; i < 12; ++i) {
      const double between = inside + (outside - inside) / 2;
      (is_rounded(sign * between) ? outside : inside) = between;
    }
    const Hit at_end = hit.moved(number, at_tie + sign * outside);
    const std::vector<mpq_class> exactly = exact_numbers(at_end);
    const PlacedHit of = rounded(at_end);
    EXPECT_EQ(of.t, nearest<float>(exactly[0]));
    EXPECT_EQ(of.u, nearest<float>(exactly[1]));
    EXPECT_EQ(of.v, nearest<float>(exactly[2]));
    gaps[side] = sign * (exactly[which] - tie);
  }
  return mpq_class(abs(gaps[0] - gaps[1]) / (gaps[0] + gaps[1])).get_d();
}

TEST(PlacedRounding, holds_what_is_exact_where_hill_climbing_makes_the_error_worst) {
  for (const auto& [name, number] : {std::pair("t", Number::t), std::pair("u", Number::u), std::pair("v", Number::v)}) {
    Random random(71);
    // There are fewer starts on each instruction set if there are many.
    const std::size_t starts = std::max<std::size_t>(1, 12 / instruction_sets().size());
    double worst = 0;
    on_every_instruction_set([&, number = number] {
      worst = std::max(worst, climb_to_worst(
                                  starts, 120, [&] { return draw_hit(random); },
                                  [&](const Hit& hit) { return changed(hit, random); },
                                  [&](const Hit& hit) { return share_of_interval(hit, number); }));
    });
    expect_within_bound(name, worst);
  }
}

}  // namespace
}  // namespace surehit::test::placed_rounding_test
