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
std::size_t SceneState<Scalar>::memory_bytes() const noexcept {
  std::size_t bytes = sizeof *this + pending.capacity() * sizeof(pending[0]) +
                      (changed.capacity() + unused.capacity()) * sizeof(std::uint32_t) +
                      changed_in.capacity() * sizeof(changed_in[0]) + boxes.capacity() * sizeof(boxes[0]) +
                      watched.capacity() * sizeof(watched[0]) + former.capacity() * sizeof(former[0]);
  for (const CommittedShare<Scalar>& scene : former) bytes += scene.get()->memory_bytes();
  return bytes;
}

template <FloatOrDouble Scalar>
void SceneState<Scalar>::note_rebuilt_colliders() {
  for (std::uint32_t index = 0; index < watched.size(); ++index) {
    if (watched[index].has_other_mesh()) note_change(index);
  }
}

template <FloatOrDouble Scalar>
typename SceneState<Scalar>::Exchange SceneState<Scalar>::exchange_of(
    const CommittedScene<Scalar>& before, const std::vector<CommittedInstance<Scalar>>& made) const {
  Exchange exchange;
  for (std::size_t i = 0; i < changed.size(); ++i) {
    const bool was_in_tree = before.has_in_tree(changed[i]);
    if (was_in_tree && !made[i].is_in_tree) exchange.removed.push_back(changed[i]);
    if (!was_in_tree && made[i].is_in_tree) exchange.added.push_back(changed[i]);
  }
  return exchange;
}

template <FloatOrDouble Scalar>
InstanceTree SceneState<Scalar>::next_tree(const CommittedScene<Scalar>& before,
                                           const std::vector<CommittedInstance<Scalar>>& made,
                                           const Exchange& exchange) const {
  std::vector<InstanceBox> all_boxes = boxes;
  all_boxes.resize(pending.size());
  std::vector<std::uint8_t> is_in_tree(pending.size(), 0);
  for (std::size_t i = 0; i < before.instances.size(); ++i) is_in_tree[i] = before.instances[i].is_in_tree ? 1 : 0;
  for (std::size_t i = 0; i < changed.size(); ++i) {
    all_boxes[changed[i]] = made[i].box();
    is_in_tree[changed[i]] = made[i].is_in_tree ? 1 : 0;
  }
  if (before.tree.has_room_for(exchange.size())) {
    InstanceTree tree = before.tree;
    if (tree.exchange(is_in_tree, exchange.added, all_boxes)) return tree;
  }
  std::vector<std::uint32_t> indices;
  for (std::uint32_t i = 0; i < is_in_tree.size(); ++i) {
    if (is_in_tree[i] != 0) indices.push_back(i);
  }
  InstanceTree built_tree;
  built_tree.build(indices, all_boxes);
  return built_tree;
}

template <FloatOrDouble Scalar>
std::vector<std::uint32_t> SceneState<Scalar>::changed_after(std::uint64_t commit) const {
  std::vector<std::uint32_t> indices = changed;
  for (std::uint32_t i = 0; i < changed_in.size() && commit < commits; ++i) {
    if (changed_in[i] > commit) indices.push_back(i);
  }
  return indices;
}

template <FloatOrDouble Scalar>
CommittedShare<Scalar> SceneState<Scalar>::unshared(const CommittedShare<Scalar>& current) const {
  if (!current.get()->is_shared()) return current;
  // The last one has to catch up least.
  for (auto scene = former.rbegin(); scene != former.rend(); ++scene) {
    if (!scene->get()->is_shared()) return *scene;
  }
  return CommittedShare<Scalar>(new CommittedScene<Scalar>);
}

template <FloatOrDouble Scalar>
void SceneState<Scalar>::catch_up(CommittedScene<Scalar>& next, const CommittedScene<Scalar>& before) const noexcept {
  next.instances.resize(pending.size());
  next.kept.resize(pending.size());
  if (&next == &before) return;
  for (std::size_t i = 0; i < before.instances.size(); ++i) {
    if (changed_in[i] <= next.commit) continue;
    next.instances[i] = before.instances[i];
    next.kept[i] = before.kept[i];
  }
}

template <FloatOrDouble Scalar>
void SceneState<Scalar>::apply(CommittedScene<Scalar>& next, std::uint32_t index,
                               const CommittedInstance<Scalar>& made) noexcept {
  PendingInstance<Scalar>& instance = pending[index];
  KeptInstance& kept = next.kept[index];
  next.instances[index] = made;
  boxes[index] = made.box();
  changed_in[index] = commits;
  if (!instance.is_there) {
    kept = {};
    watched[index] = {};
    return;
  }
  watched[index] = {instance.collider, instance.float_collider, made.mesh};
  if (instance.share) kept.collider = std::move(instance.share);
  kept.user_data = instance.options.user_data;
}

template <FloatOrDouble Scalar>
void SceneState<Scalar>::forget_unshared(const CommittedScene<Scalar>* current) noexcept {
  std::erase_if(
      former, [&](const CommittedShare<Scalar>& scene) { return scene.get() == current || !scene.get()->is_shared(); });
}

template <FloatOrDouble Scalar>
void SceneState<Scalar>::end_changes() noexcept {
  for (const std::uint32_t index : changed) {
    PendingInstance<Scalar>& instance = pending[index];
    instance.has_changed = false;
    if (!instance.is_removed()) continue;
    instance.collider = nullptr;
    instance.float_collider = nullptr;
    instance.share.reset();
    if (instance.has_next_generation()) unused.push_back(index);
  }
  changed.clear();
}

template <FloatOrDouble Scalar>
void SceneState<Scalar>::commit(CommittedShare<Scalar>& current, const Executor* executor) {
  const CommittedScene<Scalar>& before = *current.get();
  note_rebuilt_colliders();
  if (changed.empty()) {
    forget_unshared(nullptr);
    return;
  }
  // All that may throw comes first.
  std::vector<CommittedInstance<Scalar>> made(changed.size());
  in_parts(executor, changed.size(), instances_in_a_task, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) made[i] = made_of(pending[changed[i]]);
  });
  const CommittedShare<Scalar> share = unshared(current);
  CommittedScene<Scalar>& next = *share.get();
  const Exchange exchange = exchange_of(before, made);
  const bool has_this_tree = set_up <= next.commit;
  const bool updates =
      exchange.size() > 0 && &next == &before && before.tree.can_update(exchange.removed.size(), exchange.added.size());
  const bool keeps = updates || (exchange.size() == 0 && !before.tree.is_worn());
  InstanceTree other_tree;
  std::vector<std::uint32_t> moved;  // What the tree does not know yet.
  if (!keeps) {
    other_tree = next_tree(before, made, exchange);
  } else if (has_this_tree) {
    moved = changed_after(next.commit);
  } else {
    other_tree = before.tree.with_room();
    moved = changed;
  }
  if (updates) next.tree.make_room(exchange.added.size(), pending.size());
  next.reserve(pending.capacity());
  boxes.reserve(pending.capacity());
  changed_in.reserve(pending.capacity());
  watched.reserve(pending.capacity());
  former.reserve(former.size() + 1);

  // Nothing below throws.
  ++commits;
  catch_up(next, before);
  boxes.resize(pending.size());
  changed_in.resize(pending.size());
  watched.resize(pending.size());
  for (std::size_t i = 0; i < changed.size(); ++i) apply(next, changed[i], made[i]);
  if (!keeps || !has_this_tree) next.tree = std::move(other_tree);
  if (updates) {
    next.tree.update(exchange.removed, exchange.added, moved, boxes);
  } else if (keeps) {
    next.tree.refit(moved, boxes);
  }
  if (!keeps || updates) set_up = commits;
  next.count = count;
  next.commit = commits;
  if (&next != &before) {
    former.push_back(std::move(current));
    current = share;
  }
  forget_unshared(&next);
  end_changes();
}

template struct SceneState<float>;
template struct SceneState<double>;

}  // namespace surehit::detail
