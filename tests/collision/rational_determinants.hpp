#pragma once

#include <gmpxx.h>

#include <array>

#include "surehit/path.hpp"
#include "surehit/triangle.hpp"

namespace surehit::test {

using RationalVector = std::array<mpq_class, 3>;

template <typename Scalar>
RationalVector rational(const Vector3<Scalar>& x) {
  return {mpq_class(double{x[0]}), mpq_class(double{x[1]}), mpq_class(double{x[2]})};
}

inline RationalVector difference(const RationalVector& x, const RationalVector& y) {
  return {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
}

inline RationalVector cross(const RationalVector& x, const RationalVector& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}

inline mpq_class dot(const RationalVector& x, const RationalVector& y) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

/// What Möller and Trumbore compute, without rounding.
struct RationalDeterminants {
  mpq_class det;
  mpq_class height;
  mpq_class u;
  mpq_class v;
  mpq_class w;
};

/// Returns those of any start and direction.
template <typename Scalar>
RationalDeterminants rational_determinants(const RationalVector& start, const RationalVector& d,
                                           const Triangle<Scalar>& triangle) {
  const RationalVector a = rational(triangle.a);
  const RationalVector e1 = difference(rational(triangle.b), a);
  const RationalVector e2 = difference(rational(triangle.c), a);
  const RationalVector s = difference(start, a);
  const RationalVector p = cross(d, e2);
  const RationalVector q = cross(s, e1);
  RationalDeterminants result{dot(e1, p), dot(e2, q), dot(s, p), dot(d, q), {}};
  result.w = result.det - result.u - result.v;
  return result;
}

template <typename Scalar>
RationalDeterminants rational_determinants(const Path<Scalar>& path, const Triangle<Scalar>& triangle) {
  const RationalVector start = rational(path.start);
  const RationalVector toward = rational(path.toward);
  return rational_determinants(start, path.kind == PathKind::segment ? difference(toward, start) : toward, triangle);
}

}  // namespace surehit::test
