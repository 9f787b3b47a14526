#include "gpu/box_tree.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace surehit::detail {
namespace {

/// A box that grows.
struct GrowingBox {
  void grow(const std::array<float, 3>& low_of, const std::array<float, 3>& high_of) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], low_of[axis]);
      high[axis] = std::max(high[axis], high_of[axis]);
    }
  }
  void grow(const GrowingBox& other) { grow(other.low, other.high); }
  /// Returns half of the surface, or 0 if the box is empty.
  [[nodiscard]] double surface() const {
    if (low[0] > high[0]) return 0;
    const auto side = [&](std::size_t axis) { return double{high[axis]} - double{low[axis]}; };
    return side(0) * side(1) + side(1) * side(2) + side(2) * side(0);
  }

  static constexpr float infinity = std::numeric_limits<float>::infinity();
  std::array<float, 3> low = {infinity, infinity, infinity};
  std::array<float, 3> high = {-infinity, -infinity, -infinity};
};

/// An item while the tree is built.
struct TreeItem {
  GrowingBox box;
  std::array<float, 3> middle;
  std::uint32_t id;
};

/// Cuts nodes where the surfaces of both parts, times their items, are small: a path meets a box with a
/// probability in proportion to its surface.
class TreeBuild {
 public:
  TreeBuild(std::span<const ItemBox> boxes, std::uint32_t leaf_size, BoxTree& tree)
      : leaf_size_(leaf_size), tree_(tree) {
    for (const ItemBox& box : boxes) {
      TreeItem item;
      item.id = static_cast<std::uint32_t>(items_.size());
      item.box.grow(box.low, box.high);
      for (std::size_t axis = 0; axis < 3; ++axis) item.middle[axis] = box.low[axis] / 2 + box.high[axis] / 2;
      items_.push_back(item);
    }
  }

  void run() {
    tree_.nodes.reserve(items_.size());
    tree_.items.reserve(items_.size());
    tree_.nodes.emplace_back();
    // A node comes before its children, so the stack holds nodes that have their place.
    std::vector<Part> parts = {{0, 0, static_cast<std::uint32_t>(items_.size()), 0}};
    while (!parts.empty()) {
      const Part part = parts.back();
      parts.pop_back();
      set_box(part);
      if (part.count <= leaf_size_) {
        fill_leaf(part);
        continue;
      }
      const std::uint32_t left = cut(part);
      const auto child = static_cast<std::uint32_t>(tree_.nodes.size());
      tree_.nodes.resize(tree_.nodes.size() + 2);
      tree_.nodes[part.node].first = child;
      tree_.nodes[part.node].count = 0;
      parts.push_back({child, part.first, left, part.level + 1});
      parts.push_back({child + 1, part.first + left, part.count - left, part.level + 1});
    }
  }

 private:
  /// The items of a node.
  struct Part {
    std::uint32_t node, first, count, level;
  };
  static constexpr std::size_t bins = 16;

  [[nodiscard]] std::span<TreeItem> items_of(const Part& part) {
    return std::span(items_).subspan(part.first, part.count);
  }

  void set_box(const Part& part) {
    GrowingBox box;
    for (const TreeItem& item : items_of(part)) box.grow(item.box);
    tree_.nodes[part.node].low = box.low;
    tree_.nodes[part.node].high = box.high;
  }

  void fill_leaf(const Part& part) {
    tree_.nodes[part.node].first = static_cast<std::uint32_t>(tree_.items.size());
    tree_.nodes[part.node].count = part.count;
    for (const TreeItem& item : items_of(part)) tree_.items.push_back(item.id);
  }

  /// Puts the items of the left part first. Returns their number, which is neither 0 nor all.
  std::uint32_t cut(const Part& part) {
    const std::span<TreeItem> items = items_of(part);
    GrowingBox middles;
    for (const TreeItem& item : items) middles.grow(item.middle, item.middle);
    std::size_t axis = 0;
    for (std::size_t other = 1; other < 3; ++other) {
      if (middles.high[other] - middles.low[other] > middles.high[axis] - middles.low[axis]) axis = other;
    }
    if (part.level < BoxTree::even_level && middles.high[axis] > middles.low[axis]) {
      const std::uint32_t left = cut_at_bin(items, axis, middles.low[axis], middles.high[axis]);
      if (left != 0 && left != part.count) return left;
    }
    const std::uint32_t half = part.count / 2;
    std::nth_element(items.begin(), items.begin() + half, items.end(), [&](const TreeItem& x, const TreeItem& y) {
      return x.middle[axis] != y.middle[axis] ? x.middle[axis] < y.middle[axis] : x.id < y.id;
    });
    return half;
  }

  static std::uint32_t cut_at_bin(std::span<TreeItem> items, std::size_t axis, float low, float high) {
    const double scale = bins / (double{high} - double{low});
    const auto bin_of = [&](const TreeItem& item) {
      const double bin = (double{item.middle[axis]} - double{low}) * scale;
      return std::min(static_cast<std::size_t>(std::max(bin, 0.0)), bins - 1);
    };
    std::array<GrowingBox, bins> boxes;
    std::array<std::uint32_t, bins> counts = {};
    for (const TreeItem& item : items) {
      const std::size_t bin = bin_of(item);
      boxes[bin].grow(item.box);
      ++counts[bin];
    }
    std::array<double, bins> costs = {};  // They are those of a cut before each bin.
    GrowingBox box;
    std::uint32_t count = 0;
    for (std::size_t bin = 1; bin < bins; ++bin) {
      box.grow(boxes[bin - 1]);
      count += counts[bin - 1];
      costs[bin] = box.surface() * count;
    }
    box = GrowingBox();
    count = 0;
    for (std::size_t bin = bins; bin-- > 1;) {
      box.grow(boxes[bin]);
      count += counts[bin];
      costs[bin] += box.surface() * count;
    }
    const auto best = static_cast<std::size_t>(std::min_element(costs.begin() + 1, costs.end()) - costs.begin());
    const auto right =
        std::partition(items.begin(), items.end(), [&](const TreeItem& item) { return bin_of(item) < best; });
    return static_cast<std::uint32_t>(right - items.begin());
  }

  std::uint32_t leaf_size_;
  BoxTree& tree_;
  std::vector<TreeItem> items_;
};

}  // namespace

BoxTree::BoxTree(std::span<const ItemBox> boxes, std::uint32_t leaf_size) {
  if (!boxes.empty()) TreeBuild(boxes, leaf_size, *this).run();
}

}  // namespace surehit::detail
