#include "scene/tree_collapse.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "support/case_count.hpp"
#include "support/random.hpp"

namespace surehit::test::tree_collapse_test {
namespace {

using detail::InstanceBox;
using detail::InstanceTree;
using detail::TreeCollapse;

/// Instances with boxes, and how their tree is collapsed.
struct Collapsed {
  explicit Collapsed(std::vector<InstanceBox> some)
      : boxes(std::move(some)), all(boxes.size()), collapse(numbered(all), boxes) {}

  static std::vector<std::uint32_t>& numbered(std::vector<std::uint32_t>& numbers) {
    std::iota(numbers.begin(), numbers.end(), 0U);
    return numbers;
  }
  /// Returns the box around a part.
  [[nodiscard]] InstanceBox box_of(std::uint32_t part) const {
    if (collapse.is_instance(part)) return boxes[collapse.instance(part)];
    InstanceBox box = box_of(collapse.left(part));
    const InstanceBox right = box_of(collapse.left(part) + 1);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(box.low[axis], right.low[axis]);
      box.high[axis] = std::max(box.high[axis], right.high[axis]);
    }
    return box;
  }
  /// Returns half of the surface of the box around a part.
  [[nodiscard]] double cost(std::uint32_t part) const {
    const InstanceBox box = box_of(part);
    std::array<double, 3> sides;
    for (std::size_t axis = 0; axis < 3; ++axis) sides[axis] = box.high[axis] - box.low[axis];
    return sides[0] * sides[1] + sides[1] * sides[2] + sides[2] * sides[0];
  }

  std::vector<InstanceBox> boxes;
  std::vector<std::uint32_t> all;
  TreeCollapse collapse;
};

/// What the nodes of a tree are.
struct Nodes {
  double cost = 0;  ///< The sum of their surfaces.
  std::size_t count = 0;
  std::vector<std::uint32_t> instances;  ///< Those below them, as they come.
};

/// Adds the nodes from this one on.
void add_nodes(const Collapsed& collapsed, std::uint32_t part, Nodes& nodes) {
  nodes.cost += collapsed.cost(part);
  ++nodes.count;
  const TreeCollapse::Children children = collapsed.collapse.children_of(part);
  for (std::size_t i = 0; i < children.count; ++i) {
    if (collapsed.collapse.is_instance(children.part[i])) {
      nodes.instances.push_back(collapsed.collapse.instance(children.part[i]));
    } else {
      add_nodes(collapsed, children.part[i], nodes);
    }
  }
}

Nodes nodes_of(const Collapsed& collapsed) {
  Nodes nodes;
  add_nodes(collapsed, TreeCollapse::root, nodes);
  return nodes;
}

/// The least cost below a part, for each number of children that it takes of a node above.
using Costs = std::array<double, InstanceTree::width + 1>;

/// Tries all ways to part the halves of a part.
Costs least_costs(const Collapsed& collapsed, std::uint32_t part) {
  Costs costs;
  costs.fill(std::numeric_limits<double>::infinity());
  if (collapsed.collapse.is_instance(part)) {
    costs[1] = 0;
    return costs;
  }
  const Costs left = least_costs(collapsed, collapsed.collapse.left(part));
  const Costs right = least_costs(collapsed, collapsed.collapse.left(part) + 1);
  for (std::size_t x = 1; x < InstanceTree::width; ++x) {
    for (std::size_t y = 1; x + y <= InstanceTree::width; ++y)
      costs[x + y] = std::min(costs[x + y], left[x] + right[y]);
  }
  costs[1] = collapsed.cost(part) + *std::min_element(costs.begin(), costs.end());
  return costs;
}

std::vector<InstanceBox> draw_boxes(Random& random, std::size_t count) {
  const bool are_clustered = random.one_in(2);
  std::vector<InstanceBox> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    InstanceBox box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double place = are_clustered ? 100 * static_cast<double>(random.below(3)) : 0;
      box.low[axis] = place + random.symmetric<double>();
      box.high[axis] = box.low[axis] + (random.one_in(4) ? 3 : 0.1);
    }
    boxes.push_back(box);
  }
  return boxes;
}

TEST(TreeCollapse, CostsAsLittleAsTheBinaryTreeAllows) {
  Random random(41);
  for (std::size_t i = case_count(400); i > 0; --i) {
    const std::size_t count = 1 + random.below(200);
    SCOPED_TRACE(count);
    const Collapsed collapsed(draw_boxes(random, count));
    Nodes nodes = nodes_of(collapsed);
    std::sort(nodes.instances.begin(), nodes.instances.end());
    EXPECT_EQ(nodes.instances, collapsed.all);
    const double least = count == 1 ? collapsed.cost(0) : least_costs(collapsed, TreeCollapse::root)[1];
    EXPECT_NEAR(nodes.cost, least, 1e-5 * least);
  }
}

/// Where surfaces tell nothing, as few nodes as halves allow are best.
TEST(TreeCollapse, HasFewNodesWhereSurfacesTellNothing) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const InstanceBox point = {{1, 2, 3}, {1, 2, 3}};
  const InstanceBox cube = {{0, 0, 0}, {1, 1, 1}};
  const InstanceBox everywhere = {{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}};
  for (const InstanceBox& box : {point, cube, everywhere}) {
    EXPECT_EQ(nodes_of(Collapsed(std::vector<InstanceBox>(512, box))).count, 1U + 8 + 64);
  }
  std::vector<InstanceBox> with_far(512, point);
  with_far.push_back({{1e9, 1e9, 1e9}, {1e9 + 1, 1e9 + 1, 1e9 + 1}});
  EXPECT_LE(nodes_of(Collapsed(with_far)).count, 80U);
}

/// Returns the number of levels of the binary tree from a part on.
std::size_t levels_from(const TreeCollapse& collapse, std::uint32_t part) {
  if (collapse.is_instance(part)) return 0;
  const std::uint32_t left = collapse.left(part);
  return 1 + std::max(levels_from(collapse, left), levels_from(collapse, left + 1));
}

TEST(TreeCollapse, EndsInTimeWhereBinsPartOneInstanceEach) {
  // Each box is 17 times as far as the one before it, so a split by bins parts the last one from all others.
  std::vector<InstanceBox> boxes;
  double at = 1e-290;
  for (int i = 0; i < 470; ++i) {
    boxes.push_back({{at, 0, 0}, {at * 1.001, 1, 1}});
    at *= 17;
  }
  const std::size_t levels = levels_from(Collapsed(boxes).collapse, TreeCollapse::root);
  EXPECT_GT(levels, InstanceTree::max_depth / 2);
  EXPECT_LE(levels, InstanceTree::max_depth);
}

}  // namespace
}  // namespace surehit::test::tree_collapse_test
