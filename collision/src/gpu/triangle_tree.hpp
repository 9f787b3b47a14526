#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gpu/box_tree.hpp"
#include "surehit/collider.hpp"

namespace surehit::detail {

/// A triangle of the tree, as `tree_walk.comp` reads it.
struct TreeTriangle {
  std::array<float, 9> corners;
  std::uint32_t id;
  std::uint32_t mask;
  std::uint32_t plane;  ///< A number of the plane across an axis in which it lies, or 0 if there is none.
};

/// A tree of boxes around all triangles of a mesh.
struct TriangleTree {
  /// The maximum number of triangles in a leaf.
  static constexpr std::uint32_t leaf_size = 4;

  TriangleTree() = default;
  /// Builds the tree of a collider. It is empty if the mesh is, or if a coordinate is too large. May throw
  /// std::bad_alloc.
  explicit TriangleTree(const Colliderf& collider);

  std::vector<TreeNode> nodes;          ///< The root comes first.
  std::vector<TreeTriangle> triangles;  ///< Those of a leaf lie side by side.
};

}  // namespace surehit::detail
