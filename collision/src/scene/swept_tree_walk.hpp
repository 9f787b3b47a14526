#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "scene/instance_tree.hpp"
#include "walk/swept_walk.hpp"

namespace surehit::detail {

/// Visits all instances of a tree whose boxes a moving box comes to, roughly in the order of its way.
///
/// `visitor.visit(index)` gets each of them, unless the box comes to it after `visitor.limit()`. `visitor.is_done()`
/// ends the walk.
template <typename Visitor>
class SweptTreeWalk {
 public:
  SweptTreeWalk(const InstanceTree& tree, const SweptExtents& swept, Visitor& visitor)
      : tree_(tree), visitor_(visitor) {
    for (std::size_t i = 0; i < 3; ++i) {
      Axis& axis = axes_[i];
      const double scale = tree.scale();
      axis.start = (swept.start[i] - tree.origin()[i]) * scale;
      const double end = (swept.end[i] - tree.origin()[i]) * scale;
      axis.way = end - axis.start;
      axis.inverse = 1 / axis.way;
      const double sizes = std::fabs(swept.start[i]) + std::fabs(swept.end[i]) + std::fabs(tree.origin()[i]);
      axis.reach = swept.half_extents[i] * scale;
      axis.reach += (sizes * scale + axis.reach + 1) * share;  // I14
      axis.is_known = axis.reach + std::fabs(axis.start) + std::fabs(end) < 0x1p500;
    }
  }

  void walk() {
    if (tree_.is_empty()) return;
    open_[count_++] = {0, 0};
    while (count_ > 0 && !visitor_.is_done()) {
      const auto [enters, child] = open_[--count_];
      if (enters > visitor_.limit()) continue;
      if ((child & InstanceTree::instance_bit) != 0) {
        visitor_.visit(child & ~InstanceTree::instance_bit);
      } else {
        visit_node(tree_.nodes()[child]);
      }
    }
  }

 private:
  static constexpr double share = 0x1p-46;  ///< The allowance for roundings, as a share of the sizes.

  /// The way of the box on one axis, in the frame of the tree.
  struct Axis {
    double start = 0;      ///< The centre at t = 0.
    double way = 0;        ///< The centre at t = 1 less that at t = 0.
    double inverse = 0;    ///< One over the way.
    double reach = 0;      ///< The half extent, and an allowance for all roundings (I14).
    bool is_known = true;  ///< False if the numbers are too large. Then the box is everywhere on this axis.
  };
  /// A child that is left for later.
  struct Open {
    double enters;        ///< The box does not come to it before this t.
    std::uint32_t child;  ///< A node, or an instance.
  };

  /// Leaves the children for later that the box may come to. The first one is taken first.
  void visit_node(const InstanceTree::Node& node) {
    const std::size_t before = count_;
    for (std::size_t lane = 0; lane < InstanceTree::width; ++lane) {
      if (node.child[lane] == InstanceTree::no_child) continue;
      double enters = 0;
      double leaves = std::min(1.0, visitor_.limit());
      for (std::size_t i = 0; i < 3; ++i) {
        const Axis& axis = axes_[i];
        if (!axis.is_known) continue;
        const double low = node.planes[i][lane];
        const double high = node.planes[3 + i][lane];
        const double first = ((low - std::fabs(low) * share) - axis.reach) - axis.start;
        const double last = ((high + std::fabs(high) * share) + axis.reach) - axis.start;
        if (std::fabs(axis.way) < 0x1p-300) {
          if (first > 0 || last < 0) leaves = -1;
          continue;
        }
        const double s = first * axis.inverse;
        const double t = last * axis.inverse;
        enters = std::max(enters, std::min(s, t));
        leaves = std::min(leaves, std::max(s, t));
      }
      if (enters > leaves) continue;
      std::size_t place = count_++;
      for (; place > before && open_[place - 1].enters < enters; --place) open_[place] = open_[place - 1];
      open_[place] = {enters, node.child[lane]};
    }
  }

  /// A node leaves at most seven of its children for later.
  static constexpr std::size_t max_open = (InstanceTree::width - 1) * InstanceTree::max_depth + 1;

  const InstanceTree& tree_;
  Visitor& visitor_;
  std::array<Axis, 3> axes_;
  std::size_t count_ = 0;  ///< The number of children in `open_`.
  std::array<Open, max_open> open_;
};

}  // namespace surehit::detail
