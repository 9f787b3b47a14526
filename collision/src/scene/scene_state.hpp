#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "collider_state.hpp"
#include "placement.hpp"
#include "scene/committed_scene.hpp"
#include "scene/instance_tree.hpp"
#include "surehit/executor.hpp"
#include "surehit/scene.hpp"

namespace surehit::detail {

/// An instance, as it was set last.
template <typename Scalar>
struct PendingInstance {
  const Collider<Scalar>* collider = nullptr;       ///< The collider, or null.
  const Collider<float>* float_collider = nullptr;  ///< The collider of floats in a scene of doubles, or null.
  std::shared_ptr<const void> share;                ///< A share of the collider until the commit, which takes it.
  Placement<Scalar> placement;                      ///< Where it is.
  InstanceOptions options;                          ///< The mask and the user's number.
  std::uint32_t generation = 0;                     ///< The generation of the id.
  bool is_there = false;                            ///< False for an index that is not in use.
  bool has_changed = false;                         ///< True if the index is among the changed ones.

  /// Gives it that one of the two colliders that is not null.
  void set_collider(std::shared_ptr<const Collider<Scalar>> own, std::shared_ptr<const Collider<float>> floats) {
    collider = own.get();
    float_collider = floats.get();
    if (own) {
      share = std::move(own);
    } else {
      share = std::move(floats);
    }
  }
  /// Returns true if it was removed since the last commit.
  [[nodiscard]] bool is_removed() const { return !is_there && (collider != nullptr || float_collider != nullptr); }
  /// Returns true if the index may be used again. An index whose generations are used up is not.
  [[nodiscard]] bool has_next_generation() const { return generation != std::numeric_limits<std::uint32_t>::max(); }
  /// Returns the mesh as it is now.
  [[nodiscard]] InstanceMesh<Scalar> mesh() const {
    if (collider != nullptr)
      return {&ColliderState<Scalar>::of(*collider), nullptr, ColliderState<Scalar>::of(*collider).version};
    return {nullptr, &ColliderState<float>::of(*float_collider), ColliderState<float>::of(*float_collider).version};
  }
};

/// The collider of a committed instance, and the version that the commit has seen. A commit looks at all of them, so
/// they lie side by side.
template <typename Scalar>
struct WatchedCollider {
  const Collider<Scalar>* collider = nullptr;       ///< The collider, or null.
  const Collider<float>* float_collider = nullptr;  ///< The collider of floats in a scene of doubles, or null.
  InstanceMesh<Scalar> mesh = {};                   ///< Its mesh.

  /// Returns true if the collider was rebuilt or assigned since then. A copy has the same version in another place.
  [[nodiscard]] bool has_other_mesh() const {
    if (collider != nullptr) {
      const ColliderState<Scalar>& now = ColliderState<Scalar>::of(*collider);
      return &now != mesh.own || now.version != mesh.version;
    }
    if (float_collider == nullptr) return false;
    const ColliderState<float>& now = ColliderState<float>::of(*float_collider);
    return &now != mesh.floats || now.version != mesh.version;
  }
};

/// The state of a scene. The scene has a pointer to it.
template <FloatOrDouble Scalar>
struct SceneState {
  // What was set last.
  std::vector<PendingInstance<Scalar>> pending;  ///< The instances by index.
  std::vector<std::uint32_t> changed;            ///< The indices that have changed since the last commit.
  std::vector<std::uint32_t> unused;             ///< The indices that may be used again. The last one comes first.
  std::size_t count = 0;                         ///< The number of instances.

  // What a commit needs.
  std::uint64_t commits = 0;                     ///< The number of commits.
  std::uint64_t set_up = 0;                      ///< The number of the commit that set up the nodes of the tree.
  std::vector<std::uint64_t> changed_in;         ///< The number of the commit that changed the instance last, by index.
  std::vector<InstanceBox> boxes;                ///< The boxes of the instances by index.
  std::vector<WatchedCollider<Scalar>> watched;  ///< The colliders of the instances by index.
  std::vector<CommittedShare<Scalar>> former;    ///< What was committed before, and may still be asked.

  /// Returns the instance of an id, or null if the id is stale.
  [[nodiscard]] const PendingInstance<Scalar>* find(InstanceId id) const {
    const bool is_known =
        id.index < pending.size() && pending[id.index].is_there && pending[id.index].generation == id.generation;
    return is_known ? &pending[id.index] : nullptr;
  }
  [[nodiscard]] PendingInstance<Scalar>* find(InstanceId id) {
    return const_cast<PendingInstance<Scalar>*>(std::as_const(*this).find(id));
  }
  /// Returns the same. The instance may also have been removed since the last commit: queries still hit it, and its
  /// index is not used again before the next one.
  [[nodiscard]] const PendingInstance<Scalar>* find_of_hit(InstanceId id) const {
    if (id.index >= pending.size()) return nullptr;
    const PendingInstance<Scalar>& instance = pending[id.index];
    const bool is_known = instance.is_removed() ? instance.generation == id.generation + 1
                                                : instance.is_there && instance.generation == id.generation;
    return is_known ? &instance : nullptr;
  }
  /// Notes that an instance has changed. There is room in `changed`.
  void note_change(std::uint32_t index) {
    if (!pending[index].has_changed) changed.push_back(index);
    pending[index].has_changed = true;
  }
  /// Lets all changes take effect in the committed scene. If anyone else shares it, another one takes its place. If it
  /// throws, queries answer as before.
  void commit(CommittedShare<Scalar>& current, const Executor* executor);
  /// Returns the memory that it takes, with that of former committed scenes, in bytes.
  [[nodiscard]] std::size_t memory_bytes() const noexcept;

 private:
  /// Notes the instances whose colliders were rebuilt since the last commit. There is room for all indices.
  void note_rebuilt_colliders();
  /// The instances that leave the tree and those that come into it.
  struct Exchange {
    std::vector<std::uint32_t> removed;
    std::vector<std::uint32_t> added;
    [[nodiscard]] std::size_t size() const { return removed.size() + added.size(); }
  };
  /// Returns what the changes exchange. `made` has an instance for each change.
  [[nodiscard]] Exchange exchange_of(const CommittedScene<Scalar>& before,
                                     const std::vector<CommittedInstance<Scalar>>& made) const;
  /// Returns the tree of all instances, as they are after the changes. If few come and go, they are exchanged.
  [[nodiscard]] InstanceTree next_tree(const CommittedScene<Scalar>& before,
                                       const std::vector<CommittedInstance<Scalar>>& made,
                                       const Exchange& exchange) const;
  /// Returns the changes, and the indices that have changed after a commit.
  [[nodiscard]] std::vector<std::uint32_t> changed_after(std::uint64_t commit) const;
  /// Returns a committed scene that no one else shares: the current one, a former one, or else a new one.
  [[nodiscard]] CommittedShare<Scalar> unshared(const CommittedShare<Scalar>& current) const;
  /// Sets all that has changed since a committed scene was the current one. There is room for all instances.
  void catch_up(CommittedScene<Scalar>& next, const CommittedScene<Scalar>& before) const noexcept;
  /// Sets an instance that has changed.
  void apply(CommittedScene<Scalar>& next, std::uint32_t index, const CommittedInstance<Scalar>& made) noexcept;
  /// Gives up the former scenes that no one else shares, and the one that is the current one again.
  void forget_unshared(const CommittedScene<Scalar>* current) noexcept;
  /// Forgets the changes, and what removed instances had.
  void end_changes() noexcept;
};

}  // namespace surehit::detail
