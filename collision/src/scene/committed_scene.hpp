#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "collider_state.hpp"
#include "scene/instance_tree.hpp"
#include "scene/scene_narrowphase.hpp"
#include "surehit/instance.hpp"
#include "surehit/scene_queries.hpp"

namespace surehit::detail {

/// The mesh of an instance. A scene of doubles has meshes of doubles and of floats. One of the pointers is null.
template <typename Scalar>
struct InstanceMesh {
  const ColliderState<Scalar>* own = nullptr;    ///< A mesh of the scene's Scalar.
  const ColliderState<float>* floats = nullptr;  ///< A mesh of floats in a scene of doubles.
  std::uint64_t version = 0;                     ///< The version of the mesh, which only copies share.
};

/// An instance, as queries see it. What most paths need lies in the first `hot_lines` cache lines.
template <typename Scalar>
struct alignas(64) CommittedInstance {
  static constexpr std::size_t hot_lines = 5;

  std::uint32_t mask = 0;         ///< The mask. It is 0 if there is no instance at this index.
  std::uint32_t generation = 0;   ///< The generation of the id.
  InstanceMesh<Scalar> mesh;      ///< The mesh.
  PlacedInstance<Scalar> placed;  ///< Where it is.
  bool is_in_tree = false;        ///< True if there is an instance, and its mesh has triangles.

  /// Returns the box around the instance and its way.
  [[nodiscard]] InstanceBox box() const { return {placed.frame.low, placed.frame.high}; }
};

/// What keeps a committed instance alive, and what no query needs.
struct KeptInstance {
  std::shared_ptr<const void> collider;  ///< A share of the collider. It is null if there is no instance.
  std::uint64_t user_data = 0;           ///< The user's number.
};

template <typename Scalar>
struct SceneSearches;

/// Returns the searches for the best instruction set that the machine has.
template <typename Scalar>
[[nodiscard]] const SceneSearches<Scalar>* best_scene_searches();

/// What a commit leaves for queries. Nothing changes it while it is shared, except the number of shares.
template <FloatOrDouble Scalar>
struct CommittedScene {
  std::vector<CommittedInstance<Scalar>> instances;  ///< The instances by index.
  std::vector<KeptInstance> kept;                    ///< What else is known of them.
  InstanceTree tree;                                 ///< The tree of their boxes.
  std::size_t count = 0;                             ///< The number of instances.
  std::uint64_t commit = 0;                          ///< The number of the commit that made it. It is 0 before one.
  const SceneSearches<Scalar>* searches = best_scene_searches<Scalar>();
  std::atomic<std::size_t> shares = 1;

  /// Returns what a scene or a snapshot has committed.
  [[nodiscard]] static const CommittedScene& of(const SceneQueries<Scalar>& queries) noexcept {
    return queries.committed();
  }
  /// Returns true if anyone else has a share. What others have read before they gave theirs up comes before this.
  [[nodiscard]] bool is_shared() const noexcept { return shares.load(std::memory_order_acquire) > 1; }
  /// Returns the instance of an id, or null if the id is stale.
  [[nodiscard]] const CommittedInstance<Scalar>* find(InstanceId id) const noexcept {
    const bool is_known =
        id.index < instances.size() && kept[id.index].collider && instances[id.index].generation == id.generation;
    return is_known ? &instances[id.index] : nullptr;
  }
  /// Returns true if the tree has the instance at an index.
  [[nodiscard]] bool has_in_tree(std::uint32_t index) const noexcept {
    return index < instances.size() && instances[index].is_in_tree;
  }
  /// Makes room for as many instances, or throws std::bad_alloc.
  void reserve(std::size_t room) {
    instances.reserve(room);
    kept.reserve(room);
  }
  /// Returns the memory that it takes, in bytes.
  [[nodiscard]] std::size_t memory_bytes() const noexcept {
    return sizeof *this + instances.capacity() * sizeof(instances[0]) + kept.capacity() * sizeof(kept[0]) +
           tree.memory_bytes();
  }
};

}  // namespace surehit::detail
