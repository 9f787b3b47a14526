#include "scene/instance_tree.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "support/random.hpp"

namespace surehit::test::instance_tree_test {
namespace {

using detail::InstanceBox;
using detail::InstanceTree;
using Node = InstanceTree::Node;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Draws a box of about this size around a point.
InstanceBox draw_box(Random& random, const std::array<double, 3>& place, double size) {
  InstanceBox box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double one = place[axis] + size * random.symmetric<double>();
    const double other = random.one_in(4) ? one : place[axis] + size * random.symmetric<double>();
    std::tie(box.low[axis], box.high[axis]) = std::minmax(one, other);
  }
  return box;
}

/// Draws boxes in one place or in many, whose sizes differ by up to 2^200. Some have no bounds, or are huge.
std::vector<InstanceBox> draw_boxes(Random& random, std::size_t count) {
  const double width = std::ldexp(1.0, static_cast<int>(random.between(-60, 60)));
  const double far = random.one_in(2) ? 0 : width * std::ldexp(1.0, static_cast<int>(random.below(30)));
  const bool has_unbounded = random.one_in(3);
  const int finest = random.one_in(2) ? 0 : 200;
  std::vector<InstanceBox> boxes;
  while (boxes.size() < count) {
    const auto coordinate = [&] { return far + width * random.symmetric<double>(); };
    const std::array<double, 3> place = {coordinate(), coordinate(), coordinate()};
    const double size = std::ldexp(width, -static_cast<int>(random.below(static_cast<std::uint64_t>(finest) + 1)));
    boxes.push_back(draw_box(random, random.one_in(8) ? std::array{far, far, far} : place, size));
    if (!has_unbounded) continue;
    if (random.one_in(10)) boxes.back() = draw_box(random, {0, 0, 0}, 0x1p1015);
    if (random.one_in(10)) boxes.back().low[random.below(3)] = -infinity;
    if (random.one_in(10)) boxes.back().high[random.below(3)] = infinity;
  }
  return boxes;
}

std::vector<std::uint32_t> all_of(const std::vector<InstanceBox>& boxes) {
  std::vector<std::uint32_t> all(boxes.size());
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

/// Whether a box counts for the frame of a tree.
bool is_bounded(const InstanceBox& box) {
  const auto is_small = [](double x) { return std::fabs(x) <= 0x1p1000; };
  return std::all_of(box.low.begin(), box.low.end(), is_small) &&
         std::all_of(box.high.begin(), box.high.end(), is_small);
}

/// Expects that a plane is not above a side of a box with bounds, and not below it by much more than a rounding to
/// float.
void expect_at_most(float plane, double side, const mpq_class& origin, const mpq_class& scale) {
  if (plane == -infinity) {
    EXPECT_GE(std::fabs(side) * scale.get_d(), 0x1p127);
    return;
  }
  ASSERT_TRUE(std::isfinite(plane));
  const mpq_class exact = (mpq_class(side) - origin) * scale;
  EXPECT_LE(mpq_class(double{plane}), exact);
  if (plane == std::numeric_limits<float>::max()) return;
  const mpq_class room = abs(exact) * 0x1p-20 + (abs(mpq_class(side)) + abs(origin)) * scale * 0x1p-50 + 0x1p-140;
  EXPECT_GE(mpq_class(double{plane}), mpq_class(exact - room));
}

/// Expects that the tree has each instance once, and that each box is around what is below it.
void expect_tree_of(const InstanceTree& tree, const std::vector<InstanceBox>& boxes) {
  const std::vector<Node>& nodes = tree.nodes();
  std::vector<std::uint32_t> instances;
  std::vector<std::size_t> depths(nodes.size(), 0);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    Node node = nodes[i];
    // Nodes whose last child has gone elsewhere are not in the tree.
    if (i > 0 && depths[i] == 0 && node.child[0] == InstanceTree::no_child) continue;
    ASSERT_NE(node.child[0], InstanceTree::no_child);
    EXPECT_EQ(depths[i] == 0, i == 0) << "node " << i << " has no parent before it";
    EXPECT_LT(depths[i], InstanceTree::max_depth);
    for (std::size_t lane = 0; lane < InstanceTree::width; ++lane) {
      const std::uint32_t child = node.child[lane];
      if (child == InstanceTree::no_child) continue;
      const std::uint32_t instance = child & ~InstanceTree::instance_bit;
      const bool is_instance = child != instance;
      if (is_instance) {
        ASSERT_LT(instance, boxes.size());
        instances.push_back(instance);
      } else {
        ASSERT_LT(child, nodes.size());
        ASSERT_GT(child, i);
        EXPECT_EQ(depths[child], 0U) << "node " << child << " has two parents";
        depths[child] = depths[i] + 1;
      }
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const float low = node.low(axis)[lane];
        const float high = node.high(axis)[lane];
        if (is_instance && !is_bounded(boxes[instance])) {
          EXPECT_EQ(low, -std::numeric_limits<float>::infinity());
          EXPECT_EQ(high, std::numeric_limits<float>::infinity());
        } else if (is_instance) {
          const mpq_class origin(tree.origin()[axis]);
          const mpq_class scale(tree.scale());
          expect_at_most(low, boxes[instance].low[axis], origin, scale);
          expect_at_most(-high, -boxes[instance].high[axis], -origin, scale);
        } else {
          Node below = nodes[child];
          EXPECT_EQ(low, *std::min_element(below.low(axis).begin(), below.low(axis).end()));
          EXPECT_EQ(high, *std::max_element(below.high(axis).begin(), below.high(axis).end()));
        }
      }
    }
  }
  std::sort(instances.begin(), instances.end());
  EXPECT_EQ(instances, all_of(boxes));
}

TEST(InstanceTree, HasBoxesAroundAllInstances) {
  Random random(20261127);
  for (std::size_t count = 1; count < 600; count = count * 3 / 2 + 1) {
    for (int round = 0; round < 8; ++round) {
      SCOPED_TRACE(count);
      const std::vector<InstanceBox> boxes = draw_boxes(random, count);
      InstanceTree tree;
      tree.build(all_of(boxes), boxes);
      expect_tree_of(tree, boxes);
      // The same instances elsewhere.
      const std::vector<InstanceBox> moved = draw_boxes(random, count);
      tree.refit(moved);
      expect_tree_of(tree, moved);
    }
  }
}

/// The box of all instances with bounds is at most 1 wide, as I9 says.
void expect_is_at_most_one_wide(const InstanceTree& tree, const std::vector<InstanceBox>& boxes) {
  EXPECT_EQ(std::exp2(std::ilogb(tree.scale())), tree.scale());
  for (const InstanceBox& box : boxes) {
    const auto is_bounded = [](double x) { return std::fabs(x) <= 0x1p1000; };
    if (!std::all_of(box.low.begin(), box.low.end(), is_bounded)) continue;
    if (!std::all_of(box.high.begin(), box.high.end(), is_bounded)) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_GE(box.low[axis], tree.origin()[axis]);
      EXPECT_LE((mpq_class(box.high[axis]) - mpq_class(tree.origin()[axis])) * mpq_class(tree.scale()), 1);
    }
  }
}

TEST(InstanceTree, IsAtMostOneWide) {
  Random random(3);
  for (int round = 0; round < 200; ++round) {
    const std::vector<InstanceBox> boxes = draw_boxes(random, 1 + random.below(20));
    InstanceTree tree;
    tree.build(all_of(boxes), boxes);
    expect_is_at_most_one_wide(tree, boxes);
  }
}

/// Returns the box around all boxes.
InstanceBox around(const std::vector<InstanceBox>& boxes) {
  InstanceBox all = boxes.front();
  for (const InstanceBox& box : boxes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      all.low[axis] = std::min(all.low[axis], box.low[axis]);
      all.high[axis] = std::max(all.high[axis], box.high[axis]);
    }
  }
  return all;
}

/// Some instances move at a time: a little, anywhere, far outside, or into one place.
TEST(InstanceTree, FollowsThoseThatMove) {
  Random random(20261128);
  for (std::size_t count = 1; count < 400; count = count * 2 + 1) {
    std::vector<InstanceBox> boxes = draw_boxes(random, count);
    InstanceTree tree;
    tree.build(all_of(boxes), boxes);
    InstanceTree refitted = tree;
    for (int commit = 0; commit < 40; ++commit) {
      SCOPED_TRACE(std::to_string(count) + " instances, commit " + std::to_string(commit));
      const std::vector<InstanceBox> elsewhere = draw_boxes(random, count);
      const double by = tree.scale() > 0 ? random.symmetric<double>() / tree.scale() : 0;
      const std::uint64_t way = random.below(4);
      std::vector<std::uint32_t> moved;
      for (std::size_t i = 1 + random.below(count); i-- > 0;) {
        const auto instance = static_cast<std::uint32_t>(random.below(count));
        moved.push_back(instance);
        InstanceBox& box = boxes[instance];
        if (way == 0) box = elsewhere[instance];
        if (way == 1) box = boxes.front();
        for (std::size_t axis = 0; axis < 3 && way > 1; ++axis) {
          const double step = way == 2 ? by * 0x1p-6 : 4 * by;
          box.low[axis] += step;
          box.high[axis] += step;
        }
      }
      moved.push_back(static_cast<std::uint32_t>(count) + 7);  // It is not in the tree.
      tree.refit(moved, boxes);
      expect_tree_of(tree, boxes);
      expect_is_at_most_one_wide(tree, boxes);
      EXPECT_EQ(tree.box().low, around(boxes).low);
      EXPECT_EQ(tree.box().high, around(boxes).high);
      refitted.refit(boxes);
      EXPECT_EQ(tree.is_worn(), refitted.is_worn());
    }
  }
}

/// A commit takes the time of what has moved. So nobody looks at the boxes of the others.
TEST(InstanceTree, ReadsTheBoxesOfThoseThatMoveAlone) {
  Random random(5);
  std::vector<InstanceBox> boxes = {{{-100, -100, -100}, {100, 100, 100}}};
  while (boxes.size() < 500) {
    const auto coordinate = [&] { return 90 * random.symmetric<double>(); };
    boxes.push_back(draw_box(random, {coordinate(), coordinate(), coordinate()}, 1));
  }
  InstanceTree tree;
  tree.build(all_of(boxes), boxes);
  const std::vector<std::uint32_t> moved = {3, 77, 78, 400};
  std::vector<InstanceBox> known(boxes.size(), InstanceBox{{infinity, infinity, infinity}, {0, 0, 0}});
  for (const std::uint32_t instance : moved) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      boxes[instance].low[axis] += 2;
      boxes[instance].high[axis] += 3;
    }
    known[instance] = boxes[instance];
  }
  tree.refit(moved, known);
  expect_tree_of(tree, boxes);
  EXPECT_EQ(tree.box().low, boxes.front().low);
  EXPECT_EQ(tree.box().high, boxes.front().high);
}

/// Those that appear elsewhere get a place there. So the tree needs no new sorting for long.
TEST(InstanceTree, PutsThoseThatHaveLeftElsewhere) {
  Random random(6);
  std::vector<InstanceBox> boxes;
  const auto draw = [&] {
    const auto coordinate = [&] { return 100 * random.symmetric<double>(); };
    return draw_box(random, {coordinate(), coordinate(), coordinate()}, 1);
  };
  while (boxes.size() < 2000) boxes.push_back(draw());
  InstanceTree tree;
  tree.build(all_of(boxes), boxes);
  const auto move_some = [&] {
    std::vector<std::uint32_t> moved;
    for (int i = 0; i < 20; ++i) {
      moved.push_back(static_cast<std::uint32_t>(random.below(boxes.size())));
      boxes[moved.back()] = draw();
    }
    tree.refit(moved, boxes);
  };
  for (int commit = 0; commit < 45; ++commit) {
    move_some();
    ASSERT_FALSE(tree.is_worn()) << "after " << commit << " commits";
  }
  expect_tree_of(tree, boxes);
  EXPECT_TRUE(tree.has_room_for(50));
  EXPECT_FALSE(tree.has_room_for(300)) << "those that were put elsewhere are not counted";
  // Then they stay in their nodes, whose boxes grow.
  for (int commit = 0; commit < 200 && !tree.is_worn(); ++commit) move_some();
  EXPECT_TRUE(tree.is_worn());
  expect_tree_of(tree, boxes);
}

/// Each instance is half as large as the one before it, and inside of it. A split leaves few of them behind.
TEST(InstanceTree, IsNotDeeperThanAWalkCanKeep) {
  std::vector<InstanceBox> boxes;
  for (int i = 0; i < 2000; ++i) {
    const double size = std::ldexp(1.0, 900 - i);
    boxes.push_back({{size, size, size}, {2 * size, 2 * size, 2 * size}});
  }
  InstanceTree tree;
  tree.build(all_of(boxes), boxes);
  expect_tree_of(tree, boxes);
  const std::vector<InstanceBox> in_one_place(10'000, boxes.front());
  tree.build(all_of(in_one_place), in_one_place);
  expect_tree_of(tree, in_one_place);
}

TEST(InstanceTree, KnowsItsOnlyInstance) {
  const std::vector<InstanceBox> boxes(3, InstanceBox{{0, 0, 0}, {1, 1, 1}});
  InstanceTree tree;
  tree.build({}, boxes);
  EXPECT_TRUE(tree.is_empty());
  EXPECT_EQ(tree.only_instance(), InstanceTree::no_child);
  tree.build(std::array{2U}, boxes);
  EXPECT_EQ(tree.only_instance(), 2U);
  tree.build(std::array{2U, 0U}, boxes);
  EXPECT_EQ(tree.only_instance(), InstanceTree::no_child);
}

/// Instances that lie in a row, and then in another order.
TEST(InstanceTree, IsWornOnceItsInstancesAreMixed) {
  Random random(4);
  std::vector<InstanceBox> boxes;
  for (int i = 0; i < 1000; ++i) boxes.push_back({{1.0 * i, 0, 0}, {i + 1.0, 1, 1}});
  InstanceTree tree;
  tree.build(all_of(boxes), boxes);
  EXPECT_FALSE(tree.is_worn());
  EXPECT_EQ(tree.box().low, boxes.front().low);
  EXPECT_EQ(tree.box().high, boxes.back().high);
  tree.refit(boxes);
  EXPECT_FALSE(tree.is_worn());
  for (std::size_t i = boxes.size(); i > 1; --i) std::swap(boxes[i - 1], boxes[random.below(i)]);
  tree.refit(boxes);
  EXPECT_TRUE(tree.is_worn());
}

}  // namespace
}  // namespace surehit::test::instance_tree_test
