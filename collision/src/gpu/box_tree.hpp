#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace surehit::detail {

/// A node of a tree, as `tree_walk.comp` reads it.
struct TreeNode {
  std::array<float, 3> low;
  std::uint32_t first;  ///< The first of its items, or the first of its two children.
  std::array<float, 3> high;
  std::uint32_t count;  ///< The number of its items. A node with children has 0.
};

/// The box of an item.
struct ItemBox {
  std::array<float, 3> low, high;
};

/// A binary tree of boxes around items. Each item is in one leaf. The box of a node is exactly that of its items, so
/// nothing has to be padded (G6).
struct BoxTree {
  /// Below so many levels, nodes are cut into halves of equal size. So a tree has at most 64 levels.
  static constexpr std::uint32_t even_level = 24;
  /// What has a larger coordinate is left to the host (G2).
  static constexpr float largest_coordinate = 0x1p33F;

  BoxTree() = default;
  /// Builds a tree, which is empty if there are no items. May throw std::bad_alloc.
  BoxTree(std::span<const ItemBox> boxes, std::uint32_t leaf_size);

  std::vector<TreeNode> nodes;       ///< The root comes first.
  std::vector<std::uint32_t> items;  ///< The indices of the items. Those of a leaf lie side by side.
};

}  // namespace surehit::detail
