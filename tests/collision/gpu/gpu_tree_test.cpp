// What the trees of boxes on a device hold. No device is asked.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "gpu/box_tree.hpp"
#include "gpu/scene_tree.hpp"
#include "gpu/triangle_tree.hpp"
#include "support/grid_breaking_meshes.hpp"
#include "support/random.hpp"
#include "surehit/scene.hpp"

namespace surehit::test::gpu_tree_test {
namespace {

using detail::BoxTree;
using detail::ItemBox;
using detail::TreeNode;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr ItemBox no_box = {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};

void grow(ItemBox& box, const ItemBox& by) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.low[axis] = std::min(box.low[axis], by.low[axis]);
    box.high[axis] = std::max(box.high[axis], by.high[axis]);
  }
}

/// Walks through a tree, and expects that the box of each node is exactly that of its items.
class TreeJudge {
 public:
  /// `boxes` are those of the places in leaves.
  TreeJudge(std::span<const TreeNode> nodes, std::span<const ItemBox> boxes, std::uint32_t leaf_size)
      : nodes_(nodes), boxes_(boxes), leaf_size_(leaf_size), visits_(boxes.size()) {
    expect_exact(0, 1);
    for (const int visits : visits_) EXPECT_EQ(visits, 1);
  }
  [[nodiscard]] std::size_t levels() const { return levels_; }

 private:
  ItemBox expect_exact(std::uint32_t at, std::size_t level) {
    const TreeNode& node = nodes_[at];
    levels_ = std::max(levels_, level);
    ItemBox box = no_box;
    if (node.count == 0) {
      EXPECT_GT(node.first, at);
      for (const std::uint32_t child : {node.first, node.first + 1}) grow(box, expect_exact(child, level + 1));
    } else {
      EXPECT_LE(node.count, leaf_size_);
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        grow(box, boxes_[i]);
        ++visits_[i];
      }
    }
    EXPECT_EQ(node.low, box.low);
    EXPECT_EQ(node.high, box.high);
    return box;
  }

  std::span<const TreeNode> nodes_;
  std::span<const ItemBox> boxes_;
  std::uint32_t leaf_size_;
  std::vector<int> visits_;
  std::size_t levels_ = 0;
};

/// Builds a tree around boxes, judges it, and returns the number of its levels.
std::size_t levels_around(const std::vector<ItemBox>& boxes, std::uint32_t leaf_size) {
  const BoxTree tree(boxes, leaf_size);
  std::vector<ItemBox> placed;
  for (const std::uint32_t item : tree.items) placed.push_back(boxes[item]);
  EXPECT_EQ(placed.size(), boxes.size());
  return TreeJudge(tree.nodes, placed, leaf_size).levels();
}

TEST(GpuBoxTree, nodes_have_exactly_the_boxes_of_their_items) {
  Random random(1);
  for (const std::size_t count : {1U, 2U, 4U, 5U, 100U, 3000U}) {
    for (const std::uint32_t leaf_size : {1U, 4U}) {
      for (const float size : {0.0F, 0x1p-149F, 0.01F, 1.0F, 0x1p32F}) {  // Of boxes beside the distances between them.
        std::vector<ItemBox> boxes(count);
        for (ItemBox& box : boxes) {
          for (std::size_t axis = 0; axis < 3; ++axis) {
            box.low[axis] = random.one_in(8) ? 0 : random.symmetric<float>();
            box.high[axis] = box.low[axis] + size * random.unit<float>();
          }
        }
        levels_around(boxes, leaf_size);
        ASSERT_FALSE(testing::Test::HasFailure()) << count << " boxes of " << size;
      }
    }
  }
}

/// On each axis, each box is four octaves farther away than the last one. A cut at one of sixteen bins of equal width
/// cuts off one box.
TEST(GpuBoxTree, levels_are_few_whatever_the_boxes_are) {
  std::vector<ItemBox> boxes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (int exponent = 32; exponent > -140; exponent -= 4) {
      ItemBox box = {};
      box.low[axis] = std::ldexp(1.0F, exponent);
      box.high[axis] = box.low[axis];
      boxes.push_back(box);
    }
  }
  const std::size_t levels = levels_around(boxes, 1);
  EXPECT_GT(levels, BoxTree::even_level);
  EXPECT_LE(levels, BoxTree::even_level + 1 + std::bit_width(boxes.size()));
  EXPECT_LE(levels, 64U);  // A walk through a mesh has room for so many nodes.
}

TEST(GpuTriangleTree, leaves_have_exactly_the_boxes_of_their_triangles) {
  Random random(2);
  const Colliderf collider(rough_ground<float>(20, 0.3F, random).view());
  const detail::TriangleTree tree(collider);
  ASSERT_EQ(tree.triangles.size(), collider.triangle_count());
  std::vector<ItemBox> boxes;
  for (const detail::TreeTriangle& triangle : tree.triangles) {
    const auto [a, b, c] = collider.triangle(triangle.id);
    ItemBox box = no_box;
    for (const Vector3f& corner : {a, b, c}) {
      const std::array<float, 3> point = {corner[0], corner[1], corner[2]};
      grow(box, {point, point});
    }
    boxes.push_back(box);
  }
  TreeJudge(tree.nodes, boxes, detail::TriangleTree::leaf_size);
}

/// Instances that are far away have boxes of less than an ulp.
TEST(GpuSceneTree, boxes_of_instances_are_rounded_outward) {
  Random random(3);
  const auto ground = std::make_shared<Colliderf>(rough_ground<float>(4, 0.3F, random).view());
  for (const float distance : {0.0F, 1e3F, 1e8F}) {
    Scenef scene;
    for (int i = 0; i < 100; ++i) {
      const auto draw = [&] { return random.symmetric<float>(); };
      Posef pose = Posef::rigid({draw(), draw(), draw(), 1}, {distance + draw(), draw() - distance, distance * draw()});
      const InstanceId id = scene.add(ground, pose);
      if (i % 3 == 0) scene.set_motion(id, {draw(), draw(), draw()});
    }
    scene.commit();
    const SceneSnapshotf snapshot = scene.snapshot();
    const auto& committed = detail::CommittedScene<float>::of(snapshot);
    const auto& own = *committed.instances.front().mesh.own;
    const detail::SceneTree tree(committed, {{detail::versions_of(own), 0}});
    ASSERT_EQ(tree.instances.size(), 100U);
    std::vector<ItemBox> boxes;
    for (const detail::DeviceInstance& instance : tree.instances) {
      const auto box = committed.instances[instance.index].box();
      ItemBox rounded;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        rounded.low[axis] = static_cast<float>(box.low[axis]);
        if (double{rounded.low[axis]} > box.low[axis]) rounded.low[axis] = std::nextafter(rounded.low[axis], -infinity);
        rounded.high[axis] = static_cast<float>(box.high[axis]);
        if (double{rounded.high[axis]} < box.high[axis]) {
          rounded.high[axis] = std::nextafter(rounded.high[axis], infinity);
        }
      }
      boxes.push_back(rounded);
    }
    std::vector<TreeNode> nodes = tree.nodes;
    for (TreeNode& node : nodes) {
      if (node.count == 0) node.first &= ~detail::SceneTree::in_scene;
    }
    TreeJudge(nodes, boxes, 1);
  }
}

}  // namespace
}  // namespace surehit::test::gpu_tree_test
