#pragma once

#include <cmath>

#include "surehit/path.hpp"
#include "surehit/triangle.hpp"
#include "textbook_hit.hpp"
#include "vector_formulas.hpp"

namespace surehit::test {

/// The numbers of Möller and Trumbore: det = E1·(D × E2), T = E2·(S × E1), U = S·(D × E2) and V = D·(S × E1).
template <typename Scalar>
struct Determinants {
  Determinants(const Path<Scalar>& path, const Triangle<Scalar>& triangle) {
    const Vector3<Scalar> d = direction_of(path);
    const Vector3<Scalar> e1 = difference(triangle.b, triangle.a);
    const Vector3<Scalar> e2 = difference(triangle.c, triangle.a);
    const Vector3<Scalar> s = difference(path.start, triangle.a);
    const Vector3<Scalar> p = cross(d, e2);
    const Vector3<Scalar> q = cross(s, e1);
    det = dot(e1, p);
    t_det = dot(e2, q);
    u_det = dot(s, p);
    v_det = dot(d, q);
  }

  Scalar det;
  Scalar t_det;
  Scalar u_det;
  Scalar v_det;
};

/// One division up front, which three products share. The comparisons refuse, so NaN passes them.
template <typename Scalar>
[[nodiscard]] TextbookAnswer<Scalar> divided(const Determinants<Scalar>& determinants) {
  const Scalar inverse = 1 / determinants.det;
  const Scalar u = determinants.u_det * inverse;
  if (u < 0 || u > 1) return {};
  const Scalar v = determinants.v_det * inverse;
  if (v < 0 || u + v > 1) return {};
  const Scalar t = determinants.t_det * inverse;
  if (t < 0 || t > 1) return {};
  return TextbookHit<Scalar>{t, u, v};
}

/// det == 0 is refused.
template <typename Scalar>
[[nodiscard]] TextbookAnswer<Scalar> moeller_trumbore(const Path<Scalar>& segment, const Triangle<Scalar>& triangle) {
  const Determinants<Scalar> determinants(segment, triangle);
  if (determinants.det == 0) return {};
  return divided(determinants);
}

/// Nothing is asked of det. What a division by zero gives, goes on.
template <typename Scalar>
[[nodiscard]] TextbookAnswer<Scalar> without_test_of_det(const Path<Scalar>& segment,
                                                         const Triangle<Scalar>& triangle) {
  return divided(Determinants<Scalar>(segment, triangle));
}

/// |det| below 10^-digits is refused.
template <typename Scalar, int digits>
[[nodiscard]] TextbookAnswer<Scalar> with_epsilon(const Path<Scalar>& segment, const Triangle<Scalar>& triangle) {
  static_assert(digits == 3 || digits == 6 || digits == 8);
  constexpr double epsilon = digits == 3 ? 1e-3 : digits == 6 ? 1e-6 : 1e-8;
  const Determinants<Scalar> determinants(segment, triangle);
  if (std::abs(determinants.det) < static_cast<Scalar>(epsilon)) return {};
  return divided(determinants);
}

/// 1 - u - v ≥ 0 takes the place of u + v ≤ 1.
template <typename Scalar>
[[nodiscard]] TextbookAnswer<Scalar> with_rest_of_one(const Path<Scalar>& segment, const Triangle<Scalar>& triangle) {
  const Determinants<Scalar> determinants(segment, triangle);
  if (determinants.det == 0) return {};
  const Scalar inverse = 1 / determinants.det;
  const Scalar u = determinants.u_det * inverse;
  if (u < 0) return {};
  const Scalar v = determinants.v_det * inverse;
  if (v < 0 || 1 - u - v < 0) return {};
  const Scalar t = determinants.t_det * inverse;
  if (t < 0 || t > 1) return {};
  return TextbookHit<Scalar>{t, u, v};
}

/// t has no limits.
template <typename Scalar>
[[nodiscard]] TextbookAnswer<Scalar> of_line(const Path<Scalar>& line, const Triangle<Scalar>& triangle) {
  const Determinants<Scalar> determinants(line, triangle);
  if (determinants.det == 0) return {};
  const Scalar inverse = 1 / determinants.det;
  const Scalar u = determinants.u_det * inverse;
  if (u < 0 || u > 1) return {};
  const Scalar v = determinants.v_det * inverse;
  if (v < 0 || u + v > 1) return {};
  return TextbookHit<Scalar>{determinants.t_det * inverse, u, v};
}

/// Only a path against the normal (b - a) × (c - a) counts.
template <typename Scalar>
[[nodiscard]] TextbookAnswer<Scalar> culled_by_normal(const Path<Scalar>& segment, const Triangle<Scalar>& triangle) {
  const Vector3<Scalar> n = cross(difference(triangle.b, triangle.a), difference(triangle.c, triangle.a));
  if (dot(n, direction_of(segment)) >= 0) return {};
  return moeller_trumbore(segment, triangle);
}

/// Only a positive det counts.
template <typename Scalar>
[[nodiscard]] TextbookAnswer<Scalar> culled_by_det(const Path<Scalar>& segment, const Triangle<Scalar>& triangle) {
  const Determinants<Scalar> determinants(segment, triangle);
  if (determinants.det <= 0) return {};
  return divided(determinants);
}

}  // namespace surehit::test
