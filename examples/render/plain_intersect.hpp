#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <surehit/path.hpp>
#include <surehit/triangle.hpp>

namespace surehit::example {

/// Where a ray meets a triangle by the plain test of Möller and Trumbore, as it is in textbooks: in float, with one
/// division up front, and without an epsilon. It is here for contrast.
struct PlainHit {
  float t, u, v;
  bool is_front;  ///< as the sign of the determinant says
};

[[nodiscard]] inline std::optional<PlainHit> plain_intersect(const Rayf& ray, const Trianglef& triangle) {
  const Vector3f edge1 = triangle.b - triangle.a;
  const Vector3f edge2 = triangle.c - triangle.a;
  const Vector3f p = ray.direction.cross(edge2);
  const float det = edge1.dot(p);
  if (det == 0) return std::nullopt;
  const float inverse = 1 / det;
  const Vector3f s = ray.origin - triangle.a;
  const float u = s.dot(p) * inverse;
  if (u < 0 || u > 1) return std::nullopt;
  const Vector3f q = s.cross(edge1);
  const float v = ray.direction.dot(q) * inverse;
  if (v < 0 || u + v > 1) return std::nullopt;
  const float t = edge2.dot(q) * inverse;
  if (t < 0) return std::nullopt;
  return PlainHit{t, u, v, det > 0};
}

}  // namespace surehit::example
