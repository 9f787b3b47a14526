#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "support/grid_breaking_meshes.hpp"

namespace surehit::test {

/// Where a deformation takes each vertex. All of them keep meshes in [-4, 4]³ finite.
template <typename Scalar>
struct Deformation {
  const char* name;
  Vector3<Scalar> (*move)(const Vector3<Scalar>&);
};

template <typename Scalar>
const std::array<Deformation<Scalar>, 14>& deformations() {
  using Point = Vector3<Scalar>;
  static constexpr Scalar huge = std::numeric_limits<Scalar>::max() / 8;
  static constexpr Scalar tiny = 40 * std::numeric_limits<Scalar>::denorm_min();
  static const std::array<Deformation<Scalar>, 14> all = {{
      {"as it was", [](const Point& x) -> Point { return x; }},
      {"smaller", [](const Point& x) -> Point { return x * Scalar{0x1p-20}; }},
      {"larger", [](const Point& x) -> Point { return x * 1000; }},
      {"far away", [](const Point& x) -> Point { return x * Scalar{0.125} + Point(1000, -2000, 500); }},
      {"flat in x",
       [](const Point& x) -> Point {
         return {Scalar{0.25}, x[1], x[2]};
       }},
      {"flat in z",
       [](const Point& x) -> Point {
         return {x[0], x[1], 0};
       }},
      {"a line",
       [](const Point& x) -> Point {
         return {3, x[1], -7};
       }},
      {"a point",
       [](const Point&) -> Point {
         return {3, 5, -7};
       }},
      {"huge", [](const Point& x) -> Point { return x * huge; }},
      {"tiny", [](const Point& x) -> Point { return x * tiny; }},
      {"crowded", [](const Point& x) -> Point { return x.cwiseProduct(x).cwiseProduct(x.cwiseProduct(x)); }},
      {"long",
       [](const Point& x) -> Point {
         return {x[0] * 4096, x[1], x[2] * Scalar{0x1p-12}};
       }},
      {"mirrored",
       [](const Point& x) -> Point {
         return {-x[0], x[2], x[1]};
       }},
      {"sheared",
       [](const Point& x) -> Point {
         return {x[0] + 3 * x[2], x[1] - x[0], x[2]};
       }},
  }};
  return all;
}

template <typename Scalar>
GeneratedMesh<Scalar> deformed(GeneratedMesh<Scalar> mesh, const Deformation<Scalar>& deformation) {
  std::transform(mesh.vertices.begin(), mesh.vertices.end(), mesh.vertices.begin(), deformation.move);
  return mesh;
}

}  // namespace surehit::test
