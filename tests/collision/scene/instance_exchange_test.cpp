#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "scene/instance_tree.hpp"
#include "support/random.hpp"

namespace surehit::detail::instance_exchange_test {
namespace {

using test::Random;

/// Boxes of instances, and those of them that a tree has.
class InstanceExchange : public testing::Test {
 protected:
  /// Adds an instance that is not in the tree yet.
  std::uint32_t add(const Doubles& low, const Doubles& high) {
    boxes.push_back({low, high});
    is_there.push_back(0);
    return static_cast<std::uint32_t>(boxes.size() - 1);
  }
  /// Adds small boxes at random places of a cube.
  void add_small(std::size_t count, double from, double size) {
    for (std::size_t i = 0; i < count; ++i) {
      Doubles low;
      for (double& x : low) x = from + size * random.unit<double>();
      add(low, {low[0] + 1, low[1] + 1, low[2] + 1});
    }
  }

  void build() {
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      is_there[i] = 1;
      indices.push_back(i);
    }
    tree.build(indices, boxes);
  }
  /// Takes some instances out of the tree, and puts others in.
  [[nodiscard]] bool exchange(const std::vector<std::uint32_t>& out, const std::vector<std::uint32_t>& in) {
    for (const std::uint32_t i : out) is_there[i] = 0;
    for (const std::uint32_t i : in) is_there[i] = 1;
    return tree.exchange(is_there, in, boxes);
  }

  /// Each instance has one place in the tree, and each box on the way to it is around its own.
  void expect_all_are_in_their_boxes() {
    std::vector<std::uint8_t> found(boxes.size(), 0);
    longest_way = 0;
    if (!tree.is_empty()) visit(0, 1, found);
    ASSERT_EQ(found, is_there);
    ASSERT_LE(longest_way, InstanceTree::max_depth);
  }

  /// The box of the tree is that of all instances.
  void expect_box_of_all() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    InstanceBox all = {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      for (std::size_t axis = 0; axis < 3 && is_there[i] != 0; ++axis) {
        all.low[axis] = std::min(all.low[axis], boxes[i].low[axis]);
        all.high[axis] = std::max(all.high[axis], boxes[i].high[axis]);
      }
    }
    EXPECT_EQ(tree.box().low, all.low);
    EXPECT_EQ(tree.box().high, all.high);
  }

  std::vector<InstanceBox> boxes;
  std::vector<std::uint8_t> is_there;
  InstanceTree tree;
  Random random{1};
  std::size_t longest_way = 0;  ///< The number of nodes of the longest way down.

 private:
  using Box = std::array<std::array<double, 3>, 2>;

  /// Returns the box around what a node holds.
  Box visit(std::uint32_t index, std::size_t nodes, std::vector<std::uint8_t>& found) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Box all = {{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}}};
    longest_way = std::max(longest_way, nodes);
    InstanceTree::Node node = tree.nodes()[index];
    EXPECT_NE(node.child[0], InstanceTree::no_child) << "a node without children is met";
    bool ended = false;
    for (std::size_t lane = 0; lane < InstanceTree::width; ++lane) {
      const std::uint32_t child = node.child[lane];
      ended |= child == InstanceTree::no_child;
      EXPECT_EQ(child == InstanceTree::no_child, ended) << "a child comes after a free place";
      if (ended) {
        for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_GT(node.low(axis)[lane], node.high(axis)[lane]);
        continue;
      }
      const Box box = (child & InstanceTree::instance_bit) != 0 ? box_of(child & ~InstanceTree::instance_bit, found)
                                                                : visit(child, nodes + 1, found);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_LE(node.low(axis)[lane], box[0][axis]);
        EXPECT_GE(node.high(axis)[lane], box[1][axis]);
        all[0][axis] = std::min(all[0][axis], box[0][axis]);
        all[1][axis] = std::max(all[1][axis], box[1][axis]);
      }
    }
    return all;
  }

  /// Returns the box of an instance in the frame of the tree.
  Box box_of(std::uint32_t instance, std::vector<std::uint8_t>& found) {
    EXPECT_EQ(found[instance], 0) << "an instance is met twice";
    found[instance] = 1;
    Box box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box[0][axis] = (boxes[instance].low[axis] - tree.origin()[axis]) * tree.scale();
      box[1][axis] = (boxes[instance].high[axis] - tree.origin()[axis]) * tree.scale();
    }
    return box;
  }
};

TEST_F(InstanceExchange, instances_come_and_go) {
  add_small(300, 0, 1000);
  add_small(300, 5000, 50);
  build();
  int exchanges = 0;
  for (int round = 0; round < 200; ++round) {
    std::vector<std::uint32_t> out;
    for (int i = 0; i < 12; ++i) {
      const auto index = static_cast<std::uint32_t>(random.below(boxes.size()));
      if (is_there[index] != 0 && std::find(out.begin(), out.end(), index) == out.end()) out.push_back(index);
    }
    std::vector<std::uint32_t> in;
    for (std::uint32_t index = 0; index < boxes.size() && in.size() < 6; ++index) {
      if (is_there[index] == 0 && random.one_in(4)) in.push_back(index);
    }
    const auto first_new = static_cast<std::uint32_t>(boxes.size());
    add_small(4, 6000.0 * random.unit<double>(), 10);
    for (std::uint32_t index = first_new; index < boxes.size(); ++index) in.push_back(index);
    if (tree.has_room_for(out.size() + in.size())) {
      ++exchanges;
      ASSERT_TRUE(exchange(out, in));
    } else {
      build();
    }
    expect_all_are_in_their_boxes();
    // Some of them move, and some that are not there.
    std::vector<std::uint32_t> moved;
    for (int i = 0; i < 5; ++i) {
      moved.push_back(static_cast<std::uint32_t>(random.below(boxes.size())));
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double step = 100 * random.symmetric<double>();
        boxes[moved.back()].low[axis] += step;
        boxes[moved.back()].high[axis] += step;
      }
    }
    tree.refit(moved, boxes);
    expect_all_are_in_their_boxes();
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(exchanges, 150);
}

/// The tree of a commit that nobody else has changes in place.
TEST_F(InstanceExchange, instances_come_and_go_in_place) {
  add_small(300, 0, 1000);
  add_small(300, 5000, 50);
  build();
  int updates = 0;
  for (int round = 0; round < 300; ++round) {
    SCOPED_TRACE(round);
    std::vector<std::uint32_t> out;
    std::vector<std::uint32_t> moved;
    for (int i = 0; i < 6; ++i) {
      const auto index = static_cast<std::uint32_t>(random.below(boxes.size()));
      if (is_there[index] != 0 && std::find(out.begin(), out.end(), index) == out.end()) out.push_back(index);
    }
    for (const std::uint32_t index : out) is_there[index] = 0;
    for (int i = 0; i < 4; ++i) {
      moved.push_back(static_cast<std::uint32_t>(random.below(boxes.size())));
      const double step = random.one_in(3) ? 4000 * random.symmetric<double>() : random.symmetric<double>();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        boxes[moved.back()].low[axis] += step;
        boxes[moved.back()].high[axis] += step;
      }
    }
    const auto first_new = static_cast<std::uint32_t>(boxes.size());
    add_small(1 + random.below(7), 6000.0 * random.unit<double>(), random.one_in(20) ? 9000 : 10);
    std::vector<std::uint32_t> in;
    for (std::uint32_t index = first_new; index < boxes.size(); ++index) in.push_back(index);
    if (tree.can_update(out.size(), in.size())) {
      ++updates;
      tree.make_room(in.size(), boxes.size());
      for (const std::uint32_t index : in) is_there[index] = 1;
      tree.update(out, in, moved, boxes);
    } else {
      for (const std::uint32_t index : in) is_there[index] = 1;
      build();
    }
    expect_all_are_in_their_boxes();
    expect_box_of_all();
    if (HasFailure()) return;
  }
  EXPECT_GT(updates, 200);
}

/// A tree may not become deeper than a walk can keep, and there must always be an instance.
TEST_F(InstanceExchange, few_instances_change_in_place) {
  add_small(15, 0, 1000);
  build();
  EXPECT_FALSE(tree.can_update(1, 0));
  add_small(985, 0, 1000);
  build();
  EXPECT_TRUE(tree.can_update(1, 1));
  EXPECT_TRUE(tree.can_update(500, 0));
  EXPECT_FALSE(tree.can_update(501, 0));
  EXPECT_TRUE(tree.can_update(0, 30));
  EXPECT_FALSE(tree.can_update(0, InstanceTree::max_depth));
  std::vector<std::uint32_t> out;
  for (std::uint32_t i = 0; i < 400; ++i) out.push_back(i);
  for (const std::uint32_t i : out) is_there[i] = 0;
  tree.update(out, {}, {}, boxes);
  expect_all_are_in_their_boxes();
  EXPECT_TRUE(tree.can_update(100, 0));
  EXPECT_FALSE(tree.can_update(101, 0));
}

/// Each box is in the one before it, so it joins that one.
TEST_F(InstanceExchange, way_down_does_not_become_too_long_in_place) {
  add_small(1000, 0, 1000);
  build();
  double size = 1;
  std::size_t updates = 0;
  for (; updates < 500 && tree.can_update(0, 1); ++updates) {
    size *= 0.9;
    const std::uint32_t index = add({0, 0, 0}, {size, size, size});
    is_there[index] = 1;
    tree.make_room(1, boxes.size());
    tree.update({}, std::array{index}, {}, boxes);
    expect_all_are_in_their_boxes();
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(longest_way, InstanceTree::max_depth / 2);
  EXPECT_LT(updates, 500U);
}

TEST_F(InstanceExchange, crowd_that_leaves_leaves_no_node_behind) {
  add_small(400, 0, 1000);
  add_small(150, 5000, 10);
  build();
  std::vector<std::uint32_t> crowd;
  for (std::uint32_t index = 400; index < 550; ++index) crowd.push_back(index);
  ASSERT_TRUE(tree.has_room_for(crowd.size()));
  ASSERT_TRUE(exchange(crowd, {}));
  expect_all_are_in_their_boxes();
  EXPECT_LT(tree.box().high[0], 1002);
  ASSERT_TRUE(exchange({}, {crowd.begin(), crowd.begin() + 100}));
  expect_all_are_in_their_boxes();
}

TEST_F(InstanceExchange, half_of_the_instances_may_come_and_go_before_a_new_tree) {
  add_small(1000, 0, 1000);
  build();
  add_small(300, 0, 1000);
  EXPECT_TRUE(tree.has_room_for(500));
  EXPECT_FALSE(tree.has_room_for(501));
  std::vector<std::uint32_t> out;
  std::vector<std::uint32_t> in;
  for (std::uint32_t i = 0; i < 200; ++i) out.push_back(i);
  for (std::uint32_t i = 1000; i < 1250; ++i) in.push_back(i);
  ASSERT_TRUE(exchange(out, in));
  EXPECT_TRUE(tree.has_room_for(50));
  EXPECT_FALSE(tree.has_room_for(51));
  build();
  EXPECT_TRUE(tree.has_room_for(650));
}

TEST_F(InstanceExchange, exchanged_instances_wear_the_tree_where_their_boxes_do) {
  add_small(1000, 0, 1000);
  build();
  std::vector<std::uint32_t> in;
  for (int i = 0; i < 60; ++i) in.push_back(add({0, 0, 0}, {1001, 1001, 1001}));
  ASSERT_TRUE(exchange({}, in));
  expect_all_are_in_their_boxes();
  EXPECT_TRUE(tree.is_worn());
  EXPECT_FALSE(tree.has_room_for(1));
}

TEST_F(InstanceExchange, far_instance_does_not_hide_how_worn_the_others_are) {
  for (int i = 0; i < 1000; ++i) add({1.0 * i, 0, 0}, {i + 1.0, 1, 1});
  build();
  const std::vector<InstanceBox> in_order = boxes;
  for (std::size_t i = 1000; i > 1; --i) std::swap(boxes[i - 1], boxes[random.below(i)]);
  ASSERT_TRUE(exchange({}, {add({1e6, 0, 0}, {1e6 + 1, 1, 1})}));
  expect_all_are_in_their_boxes();
  EXPECT_TRUE(tree.is_worn());
  // Without it, the tree is as it was built.
  std::copy(in_order.begin(), in_order.end(), boxes.begin());
  ASSERT_TRUE(exchange({1000}, {}));
  EXPECT_FALSE(tree.is_worn());
}

TEST_F(InstanceExchange, way_down_that_becomes_too_long_is_told) {
  // Each box is in the one before it, so it joins that one.
  add_small(1000, 0, 1000);
  build();
  double size = 1000;
  bool has_room = true;
  std::size_t count = 0;
  for (; has_room && count < 500; ++count) {
    size *= 0.9;
    has_room = exchange({}, {add({0, 0, 0}, {size, size, size})});
    if (has_room) expect_all_are_in_their_boxes();
    if (HasFatalFailure()) return;
  }
  EXPECT_FALSE(has_room);
  EXPECT_EQ(longest_way, InstanceTree::max_depth);
  build();
  expect_all_are_in_their_boxes();
}

TEST_F(InstanceExchange, boxes_that_nothing_parts_share_the_ways_down) {
  for (int i = 0; i < 2000; ++i) add({0, 0, 0}, {1, 1, 1});
  build();
  std::vector<std::uint32_t> in;
  for (int i = 0; i < 1000; ++i) in.push_back(add({0, 0, 0}, {1, 1, 1}));
  ASSERT_TRUE(exchange({}, in));
  expect_all_are_in_their_boxes();
  EXPECT_LE(longest_way, 12U);
}

TEST_F(InstanceExchange, instances_without_bounds_come_and_go) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  add_small(100, 0, 1000);
  add({-infinity, -infinity, -infinity}, {infinity, infinity, infinity});
  build();
  std::vector<std::uint32_t> in;
  for (int i = 0; i < 20; ++i) in.push_back(add({-infinity, 0, 0}, {infinity, 1e300, 1}));
  ASSERT_TRUE(exchange({100}, in));
  expect_all_are_in_their_boxes();
}

TEST_F(InstanceExchange, ways_down_end_in_time_where_bins_part_one_instance_each) {
  // Each box is 17 times as far as the one before it, so a split by bins parts the last one from all others.
  double at = 1e-290;
  for (int i = 0; i < 470; ++i) {
    add({at, 0, 0}, {at * 1.001, 1, 1});
    at *= 17;
  }
  build();
  expect_all_are_in_their_boxes();
}

}  // namespace
}  // namespace surehit::detail::instance_exchange_test
