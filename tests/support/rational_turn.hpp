#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "support/random.hpp"
#include "surehit/path.hpp"

namespace surehit::test {

using IntegerVector = Vector3<std::int64_t>;

/// A rotation by a rational angle, times `scale`. All entries are whole numbers.
struct Turn {
  std::array<IntegerVector, 3> rows;
  std::int64_t scale;

  [[nodiscard]] IntegerVector operator()(const IntegerVector& x) const {
    return {rows[0].dot(x), rows[1].dot(x), rows[2].dot(x)};
  }
};

/// The rotation of a quaternion of small whole numbers.
[[nodiscard]] inline Turn draw_turn(Random& random) {
  const auto draw = [&] { return random.between(-2, 2); };
  const std::int64_t a = random.between(1, 2);
  const std::int64_t b = draw();
  const std::int64_t c = draw();
  const std::int64_t d = draw();
  return {{IntegerVector{a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)},
           IntegerVector{2 * (b * c + a * d), a * a - b * b + c * c - d * d, 2 * (c * d - a * b)},
           IntegerVector{2 * (b * d - a * c), 2 * (c * d + a * b), a * a - b * b - c * c + d * d}},
          a * a + b * b + c * c + d * d};
}

}  // namespace surehit::test
