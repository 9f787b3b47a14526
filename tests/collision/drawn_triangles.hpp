#pragma once

#include "support/random.hpp"
#include "surehit/triangle.hpp"

namespace surehit::test {

template <typename Scalar>
[[nodiscard]] Vector3<Scalar> draw_vector(Random& random) {
  return Vector3<Scalar>::NullaryExpr([&] { return random.symmetric<Scalar>(); });
}

/// Around the point, which is inside but for rounding.
template <typename Scalar>
[[nodiscard]] Triangle<Scalar> draw_around(Random& random, const Vector3<Scalar>& point, Scalar size) {
  const Vector3<Scalar> a = size * draw_vector<Scalar>(random);
  const Vector3<Scalar> b = size * draw_vector<Scalar>(random);
  return {point + a, point + b, point - (a + b)};
}

}  // namespace surehit::test
