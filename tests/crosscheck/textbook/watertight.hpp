#pragma once

#include <array>
#include <cmath>
#include <utility>

#include "surehit/path.hpp"
#include "surehit/triangle.hpp"
#include "textbook_hit.hpp"
#include "vector_formulas.hpp"

namespace surehit::test {

/// Watertight Ray/Triangle Intersection (Woop, Benthin and Wald 2013). The corners are moved and sheared so that the
/// path goes along z from the origin. There the edges are functions in two dimensions. Where one of these is zero in
/// float, it is computed again in double. Double has no wider type, and goes on as it is.
template <typename Scalar>
[[nodiscard]] TextbookAnswer<Scalar> watertight(const Path<Scalar>& segment, const Triangle<Scalar>& triangle) {
  const Vector3<Scalar> d = direction_of(segment);
  int z = 0;
  if (std::abs(d[1]) > std::abs(d[z])) z = 1;
  if (std::abs(d[2]) > std::abs(d[z])) z = 2;
  int x = (z + 1) % 3;
  int y = (x + 1) % 3;
  if (d[z] < 0) std::swap(x, y);
  const Scalar shear_x = d[x] / d[z];
  const Scalar shear_y = d[y] / d[z];
  const Scalar shear_z = 1 / d[z];

  struct Sheared {
    Scalar x, y, z;
  };
  const auto sheared = [&](const Vector3<Scalar>& corner) {
    const Vector3<Scalar> moved = difference(corner, segment.start);
    return Sheared{moved[x] - shear_x * moved[z], moved[y] - shear_y * moved[z], shear_z * moved[z]};
  };
  const std::array<Sheared, 3> corners = {sheared(triangle.a), sheared(triangle.b), sheared(triangle.c)};
  const auto& [a, b, c] = corners;

  std::array<Scalar, 3> edges = {c.x * b.y - c.y * b.x, a.x * c.y - a.y * c.x, b.x * a.y - b.y * a.x};
  if (sizeof(Scalar) == sizeof(float) && (edges[0] == 0 || edges[1] == 0 || edges[2] == 0)) {
    const auto in_double = [](const Sheared& left, const Sheared& right) {
      return static_cast<Scalar>(double{left.x} * double{right.y} - double{left.y} * double{right.x});
    };
    edges = {in_double(c, b), in_double(a, c), in_double(b, a)};
  }
  const bool is_any_negative = edges[0] < 0 || edges[1] < 0 || edges[2] < 0;
  const bool is_any_positive = edges[0] > 0 || edges[1] > 0 || edges[2] > 0;
  if (is_any_negative && is_any_positive) return {};
  const Scalar det = edges[0] + edges[1] + edges[2];
  if (det == 0) return {};

  const Scalar t_det = edges[0] * a.z + edges[1] * b.z + edges[2] * c.z;
  const Scalar sign = det < 0 ? Scalar{-1} : Scalar{1};
  if (sign * t_det < 0 || sign * t_det > sign * det) return {};
  const Scalar inverse = 1 / det;
  return TextbookHit<Scalar>{t_det * inverse, edges[1] * inverse, edges[2] * inverse};
}

}  // namespace surehit::test
