#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "surehit/collider.hpp"

namespace surehit::detail {

/// A node of the tree, as `tree_walk.comp` reads it.
struct TreeNode {
  std::array<float, 3> low;
  std::uint32_t first;  ///< The first of its triangles, or the first of its two children.
  std::array<float, 3> high;
  std::uint32_t count;  ///< The number of its triangles. A node with children has 0.
};

/// A triangle of the tree, as `tree_walk.comp` reads it.
struct TreeTriangle {
  std::array<float, 9> corners;
  std::uint32_t id;
  std::uint32_t mask;
  std::uint32_t unused;
};

/// A binary tree of boxes around all triangles of a mesh. Each triangle is in one leaf. The box of a node is exactly
/// that of its triangles, so nothing has to be padded (G6).
struct TriangleTree {
  /// The maximum number of triangles in a leaf.
  static constexpr std::uint32_t leaf_size = 4;
  /// Below so many levels, nodes are cut into halves of equal size. So a tree has at most 64 levels.
  static constexpr std::uint32_t even_level = 24;
  /// A mesh with a larger coordinate is left to the host (G2).
  static constexpr float largest_coordinate = 0x1p33F;

  TriangleTree() = default;
  /// Builds the tree of a collider. It is empty if the mesh is, or if a coordinate is too large. May throw
  /// std::bad_alloc.
  explicit TriangleTree(const Colliderf& collider);

  std::vector<TreeNode> nodes;          ///< The root comes first.
  std::vector<TreeTriangle> triangles;  ///< Those of a leaf lie side by side.
};

}  // namespace surehit::detail
