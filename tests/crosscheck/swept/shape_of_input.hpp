#pragma once

#include <array>

#include "surehit/swept_shape.hpp"
#include "surehit/triangle.hpp"
#include "swept_input.hpp"

namespace surehit::test {

/// Returns numbers of a case. They are exactly of the type of the case, so nothing is rounded.
template <typename Scalar>
[[nodiscard]] Vector3<Scalar> vector_of(const std::array<double, 3>& x) {
  return {static_cast<Scalar>(x[0]), static_cast<Scalar>(x[1]), static_cast<Scalar>(x[2])};
}

template <typename Scalar>
[[nodiscard]] Triangle<Scalar> triangle_of(const swept::Input& input) {
  return {vector_of<Scalar>(input.corners[0]), vector_of<Scalar>(input.corners[1]),
          vector_of<Scalar>(input.corners[2])};
}

template <typename Scalar>
[[nodiscard]] SweptShape<Scalar> shape_of(const swept::Input& input) {
  const Vector3<Scalar> start = vector_of<Scalar>(input.start);
  const Vector3<Scalar> end = vector_of<Scalar>(input.end);
  if (input.shape == "sphere") return SweptSphere<Scalar>{start, end, static_cast<Scalar>(input.size[0])};
  const Vector3<Scalar> first = vector_of<Scalar>({input.size[0], input.size[1], input.size[2]});
  if (input.shape == "box") return SweptBox<Scalar>{start, end, first};
  return SweptCapsule<Scalar>{start, end, first, static_cast<Scalar>(input.size[3])};
}

}  // namespace surehit::test
