#pragma once

#include "surehit/path.hpp"
#include "surehit/triangle.hpp"
#include "textbook_hit.hpp"
#include "vector_formulas.hpp"

namespace surehit::test {

/// The plane first, and then three crosses of edges. n = (b - a) × (c - a) and t = n·(a - p) / n·d give the point x = p
/// + t d. It is inside if the edges see it on the same side: if n·((b - a) × (x - a)), n·((c - b) × (x - b)) and n·((a
/// - c) × (x - c)) have no opposite signs.
template <typename Scalar>
[[nodiscard]] TextbookAnswer<Scalar> plane_first(const Path<Scalar>& segment, const Triangle<Scalar>& triangle) {
  const auto& [a, b, c] = triangle;
  const Vector3<Scalar> d = direction_of(segment);
  const Vector3<Scalar> n = cross(difference(b, a), difference(c, a));
  const Scalar slope = dot(n, d);
  if (slope == 0) return {};
  const Scalar t = dot(n, difference(a, segment.start)) / slope;
  if (t < 0 || t > 1) return {};
  const Vector3<Scalar> x = {segment.start[0] + t * d[0], segment.start[1] + t * d[1], segment.start[2] + t * d[2]};
  const Scalar along_ab = dot(n, cross(difference(b, a), difference(x, a)));
  const Scalar along_bc = dot(n, cross(difference(c, b), difference(x, b)));
  const Scalar along_ca = dot(n, cross(difference(a, c), difference(x, c)));
  const bool is_any_negative = along_ab < 0 || along_bc < 0 || along_ca < 0;
  const bool is_any_positive = along_ab > 0 || along_bc > 0 || along_ca > 0;
  if (is_any_negative && is_any_positive) return {};
  const Scalar area = dot(n, n);
  return TextbookHit<Scalar>{t, along_ca / area, along_ab / area};
}

}  // namespace surehit::test
