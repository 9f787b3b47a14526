#pragma once

#include "surehit/path.hpp"

namespace surehit::test {

// The formulas as textbooks write them. Eigen sums in an order of its own, which is not the same everywhere.

template <typename Scalar>
[[nodiscard]] Vector3<Scalar> difference(const Vector3<Scalar>& x, const Vector3<Scalar>& y) {
  return {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
}

template <typename Scalar>
[[nodiscard]] Scalar dot(const Vector3<Scalar>& x, const Vector3<Scalar>& y) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

template <typename Scalar>
[[nodiscard]] Vector3<Scalar> cross(const Vector3<Scalar>& x, const Vector3<Scalar>& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}

/// Returns the way from t = 0 to t = 1. That of a segment is rounded.
template <typename Scalar>
[[nodiscard]] Vector3<Scalar> direction_of(const Path<Scalar>& path) {
  return path.kind == PathKind::segment ? difference(path.toward, path.start) : path.toward;
}

}  // namespace surehit::test
