// How much of a tree a path meets whose instances are of sizes from 1 to 2^20, and how much of it in vain. These are
// counts, so they are the same however busy the machine is.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include "collision/filter/on_every_instruction_set.hpp"
#include "scene/instance_tree.hpp"
#include "scene/placed_path.hpp"
#include "scene_of_sizes.hpp"
#include "support/random.hpp"
#include "tree_walk_on_targets.hpp"

namespace surehit::test::tree_of_sizes_test {
namespace {

using detail::InstanceBox;
using detail::InstanceTree;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Returns whether a segment meets a box that is larger by `more` on each side, in double.
bool meets(const Segmentd& path, const InstanceBox& box, double more = 0) {
  double first = 0;
  double last = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    const double way = path.end[axis] - path.start[axis];
    const double low = box.low[i] - more - path.start[axis];
    const double high = box.high[i] + more - path.start[axis];
    if (way == 0) {
      if (low > 0 || high < 0) return false;
      continue;
    }
    first = std::max(first, std::min(low / way, high / way));
    last = std::min(last, std::max(low / way, high / way));
  }
  return first <= last;
}

InstanceBox joined(const InstanceBox& x, const InstanceBox& y) {
  InstanceBox box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.low[axis] = std::min(x.low[axis], y.low[axis]);
    box.high[axis] = std::max(x.high[axis], y.high[axis]);
  }
  return box;
}

constexpr InstanceBox nothing = {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};

double half_surface(const InstanceBox& box) {
  std::array<double, 3> side;
  for (std::size_t axis = 0; axis < 3; ++axis) side[axis] = box.high[axis] - box.low[axis];
  return side[0] < 0 ? 0 : side[0] * side[1] + side[1] * side[2] + side[2] * side[0];
}

/// A tree of the test's own. It tries every split of every axis, by the surfaces of both parts, each times its
/// instances. Then each node opens its largest child until it has eight. It takes far longer than a commit may.
class SweepTree {
 public:
  explicit SweepTree(const std::vector<InstanceBox>& boxes) : boxes_(boxes), order_(boxes.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    add(0, boxes.size());
    std::vector<std::size_t> roots = {0};
    while (!roots.empty()) {
      const std::size_t root = roots.back();
      roots.pop_back();
      nodes_.push_back(parts_[root].box);
      // The largest child is opened, until there is no room for its halves.
      std::vector<std::size_t> children = {root};
      while (children.size() < InstanceTree::width) {
        const auto is_smaller = [&](std::size_t x, std::size_t y) { return weight(x) < weight(y); };
        const auto largest = std::max_element(children.begin(), children.end(), is_smaller);
        if (parts_[*largest].left == 0) break;
        const std::size_t left = parts_[*largest].left;
        *largest = left;
        children.push_back(parts_[left].right);
      }
      for (const std::size_t child : children) {
        if (parts_[child].left != 0) roots.push_back(child);
      }
    }
  }
  [[nodiscard]] const std::vector<InstanceBox>& nodes() const { return nodes_; }

 private:
  struct Part {
    InstanceBox box;
    std::size_t left = 0;
    std::size_t right = 0;  ///< Of a left half: its other half.
  };
  [[nodiscard]] double weight(std::size_t part) const {
    return parts_[part].left == 0 ? -1 : half_surface(parts_[part].box);
  }
  std::size_t add(std::size_t first, std::size_t last) {
    const std::size_t index = parts_.size();
    parts_.push_back({nothing});
    for (std::size_t i = first; i < last; ++i) parts_[index].box = joined(parts_[index].box, boxes_[order_[i]]);
    if (last - first == 1) return index;
    double best = infinity;
    std::size_t best_axis = 0;
    std::size_t best_at = first + 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      sort(first, last, axis);
      std::vector<double> after(last - first);
      InstanceBox box = nothing;
      for (std::size_t i = last; i-- > first + 1;) {
        box = joined(box, boxes_[order_[i]]);
        after[i - first] = half_surface(box) * static_cast<double>(last - i);
      }
      box = nothing;
      for (std::size_t i = first + 1; i < last; ++i) {
        box = joined(box, boxes_[order_[i - 1]]);
        const double cost = half_surface(box) * static_cast<double>(i - first) + after[i - first];
        if (cost < best) {
          best = cost;
          best_axis = axis;
          best_at = i;
        }
      }
    }
    sort(first, last, best_axis);
    const std::size_t left = add(first, best_at);
    const std::size_t right = add(best_at, last);
    parts_[index].left = left;
    parts_[left].right = right;
    return index;
  }
  void sort(std::size_t first, std::size_t last, std::size_t axis) {
    const auto middle = [&](std::uint32_t i) { return boxes_[i].low[axis] + boxes_[i].high[axis]; };
    std::sort(order_.begin() + static_cast<std::ptrdiff_t>(first), order_.begin() + static_cast<std::ptrdiff_t>(last),
              [&](std::uint32_t x, std::uint32_t y) { return middle(x) < middle(y); });
  }

  const std::vector<InstanceBox>& boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Part> parts_;
  std::vector<InstanceBox> nodes_;
};

/// Returns the boxes of a tree's nodes, in the scene's unit of length.
std::vector<InstanceBox> boxes_of_nodes(const InstanceTree& tree) {
  std::vector<InstanceBox> boxes;
  for (InstanceTree::Node node : tree.nodes()) {
    if (node.child[0] == InstanceTree::no_child) continue;  // Its last child has gone elsewhere.
    InstanceBox box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float low = *std::min_element(node.low(axis).begin(), node.low(axis).end());
      const float high = *std::max_element(node.high(axis).begin(), node.high(axis).end());
      box.low[axis] = double{low} / tree.scale() + tree.origin()[axis];
      box.high[axis] = double{high} / tree.scale() + tree.origin()[axis];
    }
    boxes.push_back(box);
  }
  return boxes;
}

std::size_t count_met(const std::vector<Segmentd>& paths, const std::vector<InstanceBox>& boxes, double more = 0) {
  std::size_t met = 0;
  for (const Segmentd& path : paths) {
    for (const InstanceBox& box : boxes) met += meets(path, box, more) ? 1 : 0;
  }
  return met;
}

struct TreeOfSizes : testing::Test {
  TreeOfSizes() {
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
      const Box<double> box = box_of_instance(scene, i);
      boxes.push_back({{box.low[0], box.low[1], box.low[2]}, {box.high[0], box.high[1], box.high[2]}});
    }
    for (const Segment<float>& path : drawn_paths)
      paths.push_back({path.start.cast<double>(), path.end.cast<double>()});
    tree = tree_around(boxes);
  }

  /// Takes the paths in float or in double.
  template <typename Scalar>
  void expect_few_in_vain() const {
    std::size_t found = 0;
    std::size_t in_vain = 0;
    for (const Segmentd& path : paths) {
      const Path<Scalar> of_scalars = Segment<Scalar>{path.start.cast<Scalar>(), path.end.cast<Scalar>()};
      const detail::ScenePath<Scalar> in_scene(of_scalars, detail::PathRange<Scalar>(0, 1));
      for (const std::uint32_t instance : instances_on_way(tree, in_scene, true)) {
        ++found;
        in_vain += meets(path, boxes[instance]) ? 0 : 1;
        // The slack of I9 moves planes by 3 * 2^-19 widths of the tree, and their errors are below that.
        EXPECT_TRUE(meets(path, boxes[instance], 0x1p-16 / tree.scale())) << "instance " << instance;
      }
    }
    EXPECT_GT(found, 10 * paths.size());
    // The slack is as long as some dozens of the smallest instances. So paths may come to some of these in vain.
    EXPECT_LE(in_vain, found / 8);
    RecordProperty("found", static_cast<int>(found));
    RecordProperty("in_vain", static_cast<int>(in_vain));
  }

  Random random{20261129};
  DrawnScene<float> scene = draw_scene_of_sizes<float>(5000, random);
  std::vector<Segment<float>> drawn_paths = draw_paths_of_sizes(scene, 1000, random);
  std::vector<Segmentd> paths;
  std::vector<InstanceBox> boxes;
  InstanceTree tree;
};

TEST_F(TreeOfSizes, LeadsToFewInstancesInVain) {
  on_every_instruction_set([&] {
    expect_few_in_vain<float>();
    expect_few_in_vain<double>();
  });
}

/// The library tries few splits of one axis, and shares children out with care. Neither may cost more nodes.
TEST_F(TreeOfSizes, HasAsFewNodesOnTheWayAsATreeThatTriesEverySplit) {
  const std::size_t met = count_met(paths, boxes_of_nodes(tree));
  const std::size_t met_of_sweep = count_met(paths, SweepTree(boxes).nodes());
  EXPECT_LE(met, met_of_sweep);
  // A node has room for eight instances, so a walk that comes to some instances needs fewer nodes.
  EXPECT_LE(met, count_met(paths, boxes));
  RecordProperty("met", static_cast<int>(met));
  RecordProperty("met_of_sweep", static_cast<int>(met_of_sweep));
}

/// In each commit, a tenth of the instances moves by up to its own size.
TEST_F(TreeOfSizes, StaysAsGoodWhileInstancesMove) {
  for (int commit = 0; commit < 40; ++commit) {
    std::vector<std::uint32_t> moved;
    while (moved.size() < boxes.size() / 10) {
      moved.push_back(static_cast<std::uint32_t>(random.below(boxes.size())));
      InstanceBox& box = boxes[moved.back()];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double step = (box.high[axis] - box.low[axis]) * random.symmetric<double>();
        box.low[axis] += step;
        box.high[axis] += step;
      }
    }
    tree.refit(moved, boxes);
    if (tree.is_worn()) tree = tree_around(boxes);
  }
  const std::size_t met = count_met(paths, boxes_of_nodes(tree));
  const std::size_t met_of_new = count_met(paths, boxes_of_nodes(tree_around(boxes)));
  // A tree is built anew at 1.5 times its cost. Its instances are a part of this and do not grow, so nodes may grow
  // more.
  EXPECT_LE(met, 2 * met_of_new);
  RecordProperty("met", static_cast<int>(met));
  RecordProperty("met_of_new", static_cast<int>(met_of_new));
}

}  // namespace
}  // namespace surehit::test::tree_of_sizes_test
