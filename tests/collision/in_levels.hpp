#pragma once

#include <algorithm>
#include <cstdint>

#include "support/grid_breaking_meshes.hpp"
#include "surehit/triangle.hpp"

namespace surehit::test {

/// A triangle twice, among small ones. Around them are so many levels, each much larger than what is in it. So each
/// level has an inner grid, whose crowded cells are divided. All but the triangle lies on the other side of `at` than
/// `from`.
template <typename Scalar>
[[nodiscard]] GeneratedMesh<Scalar> in_levels(const Triangle<Scalar>& triangle, const Vector3<Scalar>& at,
                                              const Vector3<Scalar>& from, std::uint32_t levels) {
  const auto size_toward = [&](const Vector3<Scalar>& corner) { return (corner / 2 - at / 2).cwiseAbs().maxCoeff(); };
  Scalar size = 4 * std::max({size_toward(triangle.a), size_toward(triangle.b), size_toward(triangle.c)});
  if (size == 0) size = at.cwiseAbs().maxCoeff() * Scalar(0x1p-20F);  // The triangle is a point.
  const Vector3<Scalar> away = (at.array() < from.array()).select(Vector3<Scalar>::Constant(-1), Scalar{1});
  GeneratedMesh<Scalar> mesh;
  mesh.add(triangle);
  mesh.add({triangle.b, triangle.c, triangle.a});  // A tie.
  for (int i = 0; i < 80; ++i) {
    const Vector3<Scalar> corner = at + away * (size * (1 + static_cast<Scalar>(i) / 80));
    const Scalar edge = size / 16;
    mesh.add({corner, corner + Vector3<Scalar>{away[0] * edge, 0, 0}, corner + Vector3<Scalar>{0, away[1] * edge, 0}});
  }
  for (std::uint32_t i = 0; i < levels; ++i) {
    size *= 400;
    const Vector3<Scalar> far = at + away * size;
    mesh.add({far, at + away * (size / 2), {far[0], at[1], at[2]}});
  }
  return mesh;
}

}  // namespace surehit::test
