#include "scene/scene_state.hpp"

#include <utility>

#include "support/in_parts.hpp"
#include "support/rounding_flags.hpp"

namespace surehit::detail {
namespace {

/// The number of instances in a task of a commit.
constexpr std::size_t instances_in_a_task = 1024;

/// Returns an instance as queries see it from now on.
template <typename Scalar>
CommittedInstance<Scalar> made_of(const PendingInstance<Scalar>& instance) {
  CommittedInstance<Scalar> made;
  made.generation = instance.generation;
  if (!instance.is_there) return made;
  made.mask = instance.options.mask;
  made.mesh = instance.mesh();
  made.placed.placement = instance.placement;
  const auto set_frame = [&](const auto& box) {
    made.is_in_tree = !box.is_empty();
    if (!made.is_in_tree) return;
    made.placed.frame =
        InstanceFrame::of(made.placed.placement, {box.low.template cast<double>(), box.high.template cast<double>()});
  };
  made.mesh.own != nullptr ? set_frame(made.mesh.own->box) : set_frame(made.mesh.floats->box);
  return made;
}

}  // namespace

template <FloatOrDouble Scalar>
void SceneState<Scalar>::note_rebuilt_colliders() {
  for (std::uint32_t index = 0; index < committed.size(); ++index) {
    if (!pending[index].is_there || pending[index].has_changed) continue;
    if (pending[index].mesh().version != committed[index].mesh.version) note_change(index);
  }
}

template <FloatOrDouble Scalar>
bool SceneState<Scalar>::keeps_tree(const std::vector<CommittedInstance<Scalar>>& made) const {
  if (tree.is_worn()) return false;
  for (std::size_t i = 0; i < changed.size(); ++i) {
    const bool was_in_tree = changed[i] < committed.size() && committed[changed[i]].is_in_tree;
    if (was_in_tree != made[i].is_in_tree) return false;
  }
  return true;
}

template <FloatOrDouble Scalar>
InstanceTree SceneState<Scalar>::new_tree(const std::vector<CommittedInstance<Scalar>>& made) const {
  std::vector<InstanceBox> all_boxes = boxes;
  all_boxes.resize(pending.size());
  std::vector<std::uint8_t> is_in_tree(pending.size(), 0);
  for (std::size_t i = 0; i < committed.size(); ++i) is_in_tree[i] = committed[i].is_in_tree ? 1 : 0;
  for (std::size_t i = 0; i < changed.size(); ++i) {
    all_boxes[changed[i]] = made[i].box();
    is_in_tree[changed[i]] = made[i].is_in_tree ? 1 : 0;
  }
  std::vector<std::uint32_t> indices;
  for (std::uint32_t i = 0; i < is_in_tree.size(); ++i) {
    if (is_in_tree[i] != 0) indices.push_back(i);
  }
  InstanceTree built;
  built.build(indices, all_boxes);
  return built;
}

template <FloatOrDouble Scalar>
void SceneState<Scalar>::end_changes() noexcept {
  for (const std::uint32_t index : changed) {
    PendingInstance<Scalar>& instance = pending[index];
    instance.has_changed = false;
    if (!instance.is_removed()) continue;
    instance.collider.reset();
    instance.float_collider.reset();
    if (instance.has_next_generation()) unused.push_back(index);
  }
  changed.clear();
}

template <FloatOrDouble Scalar>
void SceneState<Scalar>::commit(const Executor* executor) {
  note_rebuilt_colliders();
  if (changed.empty()) return;
  // All that may throw comes first.
  std::vector<CommittedInstance<Scalar>> made(changed.size());
  in_parts(executor, changed.size(), instances_in_a_task, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) made[i] = made_of(pending[changed[i]]);
  });
  const bool keeps = keeps_tree(made);
  InstanceTree built = keeps ? InstanceTree() : new_tree(made);
  committed.reserve(pending.capacity());
  boxes.reserve(pending.capacity());

  // Nothing below throws.
  committed.resize(pending.size());
  boxes.resize(pending.size());
  for (std::size_t i = 0; i < changed.size(); ++i) {
    committed[changed[i]] = made[i];
    boxes[changed[i]] = made[i].box();
  }
  if (keeps) {
    tree.refit(boxes);
  } else {
    tree = std::move(built);
  }
  end_changes();
}

template struct SceneState<float>;
template struct SceneState<double>;

}  // namespace surehit::detail
