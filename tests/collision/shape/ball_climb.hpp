#pragma once

#include <gmpxx.h>

#include <array>
#include <cmath>
#include <cstddef>

#include "collision/filter/coordinate_changes.hpp"
#include "exact/scaled_double.hpp"
#include "support/hill_climb.hpp"
#include "support/one_root_number.hpp"
#include "support/random.hpp"
#include "support/shape_families.hpp"

namespace surehit::test {

inline mpf_class long_float(const OneRootNumber& x) {
  constexpr mp_bitcnt_t bits = 8192;
  const mpf_class root = sqrt(mpf_class(x.d, bits));
  return (mpf_class(x.p, bits) + mpf_class(x.q, bits) * root) / mpf_class(x.r, bits);
}

/// Returns how far a number is from the middle of its bounds. It is 1 at a bound.
inline double share_of_range(const detail::DoubleRange& range, const OneRootNumber& exact) {
  const mpf_class number = long_float(exact);
  const mpf_class twice_off = abs(2 * number - mpf_class(range.lower) - mpf_class(range.upper));
  return mpf_class(twice_off / (mpf_class(range.upper) - mpf_class(range.lower))).get_d();
}

/// Numbers of a ball and a triangle, one after the other.
template <typename Scalar>
using BallNumbers = std::array<Scalar, 16>;

template <typename Scalar>
BallNumbers<Scalar> draw_numbers(Random& random) {
  const auto [ball, triangle] = draw_shape_pair<Scalar>(SphereFamily::general, random);
  BallNumbers<Scalar> numbers;
  std::size_t k = 0;
  for (const Vector3<Scalar>* point : {&ball.start, &ball.end, &triangle.a, &triangle.b, &triangle.c}) {
    for (const Scalar x : *point) numbers[k++] = x;
  }
  numbers[k] = ball.radius;
  return numbers;
}

template <typename Scalar>
SpherePair<Scalar> pair_of(const BallNumbers<Scalar>& x) {
  return {{{x[0], x[1], x[2]}, {x[3], x[4], x[5]}, std::fabs(x[15])},
          {{x[6], x[7], x[8]}, {x[9], x[10], x[11]}, {x[12], x[13], x[14]}}};
}

/// Climbs from drawn balls to worse ones, and returns the greatest share that it finds. `share_of(pair)` is 0 where a
/// pair has none.
template <typename Scalar, typename ShareOf>
double worst_share(Random& random, const ShareOf& share_of) {
  const auto changed = [&](BallNumbers<Scalar> numbers) {
    Scalar& number = numbers[random.below(numbers.size())];
    number = changed_coordinate(random, number);
    return numbers;
  };
  return climb_to_worst(
      10, 400, [&] { return draw_numbers<Scalar>(random); }, changed,
      [&](const BallNumbers<Scalar>& numbers) { return share_of(pair_of(numbers)); });
}

}  // namespace surehit::test
