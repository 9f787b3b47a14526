#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace surehit::test {

/// A point of the plane, in whole numbers.
using Place = std::array<std::int64_t, 2>;

/// Returns twice the area of a triangle, positive where it winds to the left.
[[nodiscard]] inline std::int64_t determinant(const Place& a, const Place& b, const Place& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Returns 1 where the way from a over b to c turns to the left, and -1 where it turns to the right.
[[nodiscard]] inline int turn_of(const Place& a, const Place& b, const Place& c) {
  const std::int64_t d = determinant(a, b, c);
  return d < 0 ? -1 : d > 0 ? 1 : 0;
}

/// Returns whether a point is on a closed edge.
[[nodiscard]] inline bool is_on(const Place& point, const Place& a, const Place& b) {
  const auto between = [&](std::size_t i) {
    return std::min(a[i], b[i]) <= point[i] && point[i] <= std::max(a[i], b[i]);
  };
  return turn_of(a, b, point) == 0 && between(0) && between(1);
}

/// Returns whether two closed edges meet.
[[nodiscard]] inline bool meet(const Place& a, const Place& b, const Place& c, const Place& d) {
  if (is_on(a, c, d) || is_on(b, c, d) || is_on(c, a, b) || is_on(d, a, b)) return true;
  return turn_of(a, b, c) * turn_of(a, b, d) < 0 && turn_of(c, d, a) * turn_of(c, d, b) < 0;
}

}  // namespace surehit::test
