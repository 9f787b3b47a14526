#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include "scene/instance_splitter.hpp"
#include "scene/instance_tree.hpp"

namespace surehit::detail {

/// A binary tree of instances, and how it is collapsed into nodes of up to `InstanceTree::width` children. A path meets
/// a box with a probability in proportion to its surface, so a node costs this surface. The sum of all costs is the
/// minimum for this binary tree.
///
/// Source: Ylitie, Karras and Laine, Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs, 2017,
/// section 3.1.
class TreeCollapse {
 public:
  /// The parts below a node that become its children.
  struct Children {
    std::array<std::uint32_t, InstanceTree::width> part;  ///< Their indices.
    std::size_t count = 0;
  };
  static constexpr std::uint32_t root = 0;

  /// Splits these instances, of which there must be at least one. `boxes` has the box of each index. May throw
  /// std::bad_alloc.
  TreeCollapse(std::span<const std::uint32_t> instances, std::span<const InstanceBox> boxes)
      : order_(instances.begin(), instances.end()) {
    InstanceSplitter splitter(order_, boxes);
    const InstanceGroup all = splitter.group(0, static_cast<std::uint32_t>(order_.size()));
    const double whole = surface(all.box);
    parts_.reserve(2 * order_.size() - 1);
    const auto add = [&](const InstanceGroup& group, std::uint32_t depth) {
      parts_.push_back({group.first, group.last, 0, depth, weight(surface(group.box) / whole), {}, {}});
    };
    add(all, 0);
    for (std::uint32_t i = 0; i < parts_.size(); ++i) {
      const Part part = parts_[i];
      const std::uint32_t size = part.last - part.first;
      if (size == 1) continue;
      // Halves of n instances have at most (n + 1) / 2, so bit_width(n - 1) more levels hold all of them.
      const bool evenly = part.depth + static_cast<std::uint32_t>(std::bit_width(size - 1)) >= InstanceTree::max_depth;
      const auto [left, right] = splitter.split({part.first, part.last, no_box}, evenly);
      parts_[i].left = static_cast<std::uint32_t>(parts_.size());
      add(left, part.depth + 1);
      add(right, part.depth + 1);
    }
    for (std::size_t i = parts_.size(); i-- > 0;) weigh(parts_[i]);  // A part comes before its halves.
  }

  /// Returns true if a part is a single instance.
  [[nodiscard]] bool is_instance(std::uint32_t part) const { return parts_[part].left == 0; }
  /// Returns the instance that a part is.
  [[nodiscard]] std::uint32_t instance(std::uint32_t part) const { return order_[parts_[part].first]; }
  /// Returns the left half of a part that is no instance. The right one follows it.
  [[nodiscard]] std::uint32_t left(std::uint32_t part) const { return parts_[part].left; }
  /// Returns the children of a part that is a node. A root that is a single instance is its own child.
  [[nodiscard]] Children children_of(std::uint32_t part) const {
    Children children;
    if (is_instance(part)) {
      children.part[children.count++] = part;
    } else {
      add_halves(part, InstanceTree::width, children);
    }
    return children;
  }

 private:
  static constexpr std::size_t width = InstanceTree::width;

  /// Some instances that may become a node, or be shared out among several children of a node above.
  struct Part {
    std::uint32_t first, last;  ///< Where its instances are in the order.
    std::uint32_t left;         ///< The index of its left half, before that of the right one. 0 for a single instance.
    std::uint32_t depth;        ///< The number of parts around it.
    float weight;               ///< What it costs as a node.
    /// The least cost of its nodes if it takes up to so many children of a node above. `costs[0]` is not used.
    std::array<float, width> costs;
    /// How many of so many children the left half takes, or 0 if it is better to take one less. That of `width` is for
    /// the part's own node.
    std::array<std::uint8_t, width + 1> of_left;
  };

  /// Returns what a node costs whose surface is this share of all. Where surfaces tell nothing, few nodes are best.
  static float weight(double share) {
    constexpr double min_weight = 0x1p-40;
    return share < 1 ? static_cast<float>(std::max(share, min_weight)) : 1.0F;  // NaN is not below 1.
  }

  struct Cut {
    float cost;
    std::uint8_t of_left;
  };
  /// Returns how so many children are best shared out among the halves of a part.
  [[nodiscard]] Cut best_cut(const Part& part, std::size_t children) const {
    const Part& left = parts_[part.left];
    const Part& right = parts_[part.left + 1];
    Cut best = {std::numeric_limits<float>::infinity(), 1};
    for (std::size_t of_left = 1; of_left < children; ++of_left) {
      const float cost = left.costs[of_left] + right.costs[children - of_left];
      if (cost < best.cost) best = {cost, static_cast<std::uint8_t>(of_left)};
    }
    return best;
  }

  /// Sets the costs of a part. Those of its halves must be set.
  void weigh(Part& part) const {
    part.costs.fill(0);
    part.of_left.fill(0);
    if (part.left == 0) return;
    const Cut own = best_cut(part, width);
    part.of_left[width] = own.of_left;
    part.costs[1] = part.weight + own.cost;
    for (std::size_t children = 2; children < width; ++children) {
      const Cut cut = best_cut(part, children);
      const bool is_better = cut.cost < part.costs[children - 1];
      part.costs[children] = is_better ? cut.cost : part.costs[children - 1];
      if (is_better) part.of_left[children] = cut.of_left;
    }
  }

  /// Adds a part that takes up to `count` children.
  void add(std::uint32_t part, std::size_t count, Children& children) const {
    while (count > 1 && parts_[part].of_left[count] == 0) --count;
    if (count == 1) {
      children.part[children.count++] = part;
    } else {
      add_halves(part, count, children);
    }
  }
  /// Adds the halves of a part, which take up to `count` children together.
  void add_halves(std::uint32_t part, std::size_t count, Children& children) const {
    const Part& whole = parts_[part];
    const std::size_t of_left = whole.of_left[count];
    add(whole.left, of_left, children);
    add(whole.left + 1, count - of_left, children);
  }

  std::vector<std::uint32_t> order_;  ///< The instances. Those of a part lie side by side.
  std::vector<Part> parts_;           ///< The root comes first.
};

}  // namespace surehit::detail
