#pragma once

#include <cmath>

#include "support/neighbour.hpp"
#include "support/random.hpp"

namespace surehit::test {

// What a search for the worst rounding errors draws, and how it goes on from the worst that it knows.

template <typename Scalar>
[[nodiscard]] Scalar draw_coordinate(Random& random) {
  const Scalar x = random.symmetric<Scalar>();
  return random.one_in(4) ? std::ldexp(x, static_cast<int>(random.between(-30, 5))) : x;
}

template <typename Scalar>
[[nodiscard]] Scalar changed_coordinate(Random& random, Scalar x) {
  switch (random.below(4)) {
    case 0:
      return draw_coordinate<Scalar>(random);
    case 1:
      return -x;
    case 2:
      return x * (1 + random.symmetric<Scalar>() / 16);
    default:
      return neighbour(x, static_cast<int>(random.between(-4, 4)));
  }
}

}  // namespace surehit::test
