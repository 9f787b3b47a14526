#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "scene/instance_tree.hpp"
#include "scene/placed_path.hpp"

namespace surehit::test {

/// Returns a new tree of instances with these boxes.
[[nodiscard]] inline detail::InstanceTree tree_around(const std::vector<detail::InstanceBox>& boxes) {
  std::vector<std::uint32_t> all(boxes.size());
  std::iota(all.begin(), all.end(), 0U);
  detail::InstanceTree tree;
  tree.build(all, boxes);
  return tree;
}

/// Returns the instances to which `detail::TreeWalk` comes on the instruction set that is chosen at the moment. `sorts`
/// is as in `TreeWalk::visit`.
template <typename Scalar>
[[nodiscard]] std::vector<std::uint32_t> instances_on_way(const detail::InstanceTree& tree,
                                                          const detail::ScenePath<Scalar>& path, bool sorts);

/// When `detail::TreePath` crosses a plane, in its own parameter tau: t = moved_t + tau / inverse_unit.
struct TreeCrossing {
  float near;           ///< The tau if the path meets this plane of a box first.
  float far;            ///< The tau if the path meets this plane of a box last.
  float first, last;    ///< The tau at which the range begins and ends.
  bool falls;           ///< True if the path meets the high planes of a box first.
  double moved_t;       ///< The t of tau 0.
  double inverse_unit;  ///< The tau of a unit of t.
};

/// Returns when the path crosses a plane across an axis, on the same instruction set.
template <typename Scalar>
[[nodiscard]] TreeCrossing tree_crossing(const detail::InstanceTree& tree, const detail::ScenePath<Scalar>& path,
                                         std::size_t axis, float plane);

}  // namespace surehit::test
