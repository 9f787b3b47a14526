#include "tree_walk_on_targets.hpp"

// This file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "collision/scene/tree_walk_on_targets.cpp"
#include <hwy/foreach_target.h>
// This header must come after foreach_target.h.
#include "scene/tree_walk-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

template <typename Scalar>
void walk_through(const InstanceTree& tree, const ScenePath<Scalar>& path, bool sorts,
                  std::vector<std::uint32_t>& found) {
  TreeWalk<max_open_children> walk(tree, path);
  for (std::uint32_t child = walk.next(); child != InstanceTree::no_child; child = walk.next()) {
    if ((child & InstanceTree::instance_bit) != 0) {
      found.push_back(child & ~InstanceTree::instance_bit);
    } else if (sorts) {
      walk.template visit<true>(tree.nodes()[child]);
    } else {
      walk.template visit<false>(tree.nodes()[child]);
    }
  }
}
void walk_floats(const InstanceTree& tree, const ScenePath<float>& path, bool sorts,
                 std::vector<std::uint32_t>& found) {
  walk_through(tree, path, sorts, found);
}
void walk_doubles(const InstanceTree& tree, const ScenePath<double>& path, bool sorts,
                  std::vector<std::uint32_t>& found) {
  walk_through(tree, path, sorts, found);
}

template <typename Scalar>
test::TreeCrossing cross(const InstanceTree& tree, const ScenePath<Scalar>& path, std::size_t axis, float plane) {
  const TreePath in_tree(tree, path);
  const hn::CappedTag<float, 1> d;
  const auto tau = [&](const Float4& shift) {
    return hn::GetLane(hn::MulAdd(hn::Set(d, plane), hn::Set(d, in_tree.inverse[axis]), hn::Set(d, shift[axis])));
  };
  return {tau(in_tree.near_shift),        tau(in_tree.far_shift), in_tree.first,       in_tree.last,
          in_tree.near_planes[axis] >= 3, in_tree.moved_t,        in_tree.inverse_unit};
}
test::TreeCrossing cross_floats(const InstanceTree& tree, const ScenePath<float>& path, std::size_t axis, float plane) {
  return cross(tree, path, axis, plane);
}
test::TreeCrossing cross_doubles(const InstanceTree& tree, const ScenePath<double>& path, std::size_t axis,
                                 float plane) {
  return cross(tree, path, axis, plane);
}

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace surehit::detail {

HWY_EXPORT(walk_floats);
HWY_EXPORT(walk_doubles);
HWY_EXPORT(cross_floats);
HWY_EXPORT(cross_doubles);

}  // namespace surehit::detail

namespace surehit::test {

using namespace detail;

template <typename Scalar>
std::vector<std::uint32_t> instances_on_way(const InstanceTree& tree, const ScenePath<Scalar>& path, bool sorts) {
  std::vector<std::uint32_t> found;
  if constexpr (std::is_same_v<Scalar, float>) {
    HWY_DYNAMIC_DISPATCH(walk_floats)(tree, path, sorts, found);
  } else {
    HWY_DYNAMIC_DISPATCH(walk_doubles)(tree, path, sorts, found);
  }
  return found;
}

template <typename Scalar>
TreeCrossing tree_crossing(const InstanceTree& tree, const ScenePath<Scalar>& path, std::size_t axis, float plane) {
  if constexpr (std::is_same_v<Scalar, float>) {
    return HWY_DYNAMIC_DISPATCH(cross_floats)(tree, path, axis, plane);
  } else {
    return HWY_DYNAMIC_DISPATCH(cross_doubles)(tree, path, axis, plane);
  }
}

#define SUREHIT_INSTANTIATE(Scalar)                                                                          \
  template std::vector<std::uint32_t> instances_on_way(const InstanceTree&, const ScenePath<Scalar>&, bool); \
  template TreeCrossing tree_crossing(const InstanceTree&, const ScenePath<Scalar>&, std::size_t, float);
SUREHIT_INSTANTIATE(float)
SUREHIT_INSTANTIATE(double)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit::test
#endif
