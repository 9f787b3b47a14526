#include "gpu/triangle_tree.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

namespace surehit::detail {
namespace {

/// Numbers the planes across axes in which triangles lie, from 1 on.
class FlatPlanes {
 public:
  /// Returns the number of the plane in which a triangle with this box lies, or 0 if it lies in none.
  std::uint32_t number_of(const ItemBox& box) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (box.low[axis] != box.high[axis]) continue;
      const auto next = static_cast<std::uint32_t>(numbers_.size() + 1);
      return numbers_.try_emplace(std::pair(axis, box.low[axis]), next).first->second;
    }
    return 0;
  }

 private:
  std::map<std::pair<std::size_t, float>, std::uint32_t> numbers_;
};

}  // namespace

TriangleTree::TriangleTree(const Colliderf& collider) {
  if (collider.triangle_count() == 0) return;
  const Box<float>& box = collider.box();
  if (!(box.low.cwiseAbs().maxCoeff() <= BoxTree::largest_coordinate &&
        box.high.cwiseAbs().maxCoeff() <= BoxTree::largest_coordinate)) {
    return;
  }
  std::vector<ItemBox> boxes(collider.triangle_count());
  for (std::uint32_t id = 0; id < boxes.size(); ++id) {
    const Triangle<float> triangle = collider.triangle(id);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const auto [low, high] = std::minmax({triangle.a[axis], triangle.b[axis], triangle.c[axis]});
      boxes[id].low[static_cast<std::size_t>(axis)] = low;
      boxes[id].high[static_cast<std::size_t>(axis)] = high;
    }
  }
  BoxTree tree(boxes, leaf_size);
  triangles.reserve(tree.items.size());
  FlatPlanes planes;
  for (const std::uint32_t id : tree.items) {
    const Triangle<float> triangle = collider.triangle(id);
    const auto& [a, b, c] = triangle;
    triangles.push_back(
        {{a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2]}, id, collider.mask(id), planes.number_of(boxes[id])});
  }
  nodes = std::move(tree.nodes);
}

}  // namespace surehit::detail
