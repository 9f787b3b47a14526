#pragma once

#include <array>

namespace surehit::detail {

/// A sum of two doubles. The second is at most half a last place of the first.
using DoublePair = std::array<double, 2>;

/// Returns x - y without error (Knuth; Shewchuk 1997, theorem 7). Nothing may overflow.
[[nodiscard]] inline DoublePair exact_difference(double x, double y) {
  const double difference = x - y;
  const double y_part = x - difference;
  const double x_part = difference + y_part;
  return {difference, (x - x_part) + (y_part - y)};
}

}  // namespace surehit::detail
