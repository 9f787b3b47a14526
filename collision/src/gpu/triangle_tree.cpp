#include "gpu/triangle_tree.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace surehit::detail {

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
  for (const std::uint32_t id : tree.items) {
    const Triangle<float> triangle = collider.triangle(id);
    const auto& [a, b, c] = triangle;
    triangles.push_back({{a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2]}, id, collider.mask(id), 0});
  }
  nodes = std::move(tree.nodes);
}

}  // namespace surehit::detail
