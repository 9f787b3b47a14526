#pragma once

#include <cstdint>
#include <span>

#include "support/grid_breaking_meshes.hpp"
#include "surehit/collider.hpp"
#include "surehit/triangle.hpp"

namespace surehit::test {

/// Corners (0, 0, height), (1, 0, height), (0, 1, height): the normal points to +z.
template <typename Scalar>
Triangle<Scalar> unit_triangle(Scalar height = 0) {
  return {{0, 0, height}, {1, 0, height}, {0, 1, height}};
}

/// `count` unit triangles above each other, triangle i at height i.
template <typename Scalar>
GeneratedMesh<Scalar> stack_of_triangles(int count) {
  GeneratedMesh<Scalar> mesh;
  for (int i = 0; i < count; ++i) mesh.add(unit_triangle(static_cast<Scalar>(i)));
  return mesh;
}

/// From above or below through the middle of the stack.
template <typename Scalar>
Segment<Scalar> through_stack(Scalar from, Scalar to) {
  return {{Scalar{0.25}, Scalar{0.25}, from}, {Scalar{0.25}, Scalar{0.25}, to}};
}

/// A build that differs from the default in its masks alone.
inline BuildOptions with_masks(std::span<const std::uint32_t> masks) {
  BuildOptions options;
  options.masks = masks;
  return options;
}

}  // namespace surehit::test
