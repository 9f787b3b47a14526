#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "collider_state.hpp"
#include "scene/instance_tree.hpp"
#include "scene/scene_narrowphase.hpp"
#include "surehit/path_span.hpp"
#include "surehit/scene.hpp"

namespace surehit::detail {

/// The mesh of an instance. A scene of doubles has meshes of doubles and of floats. One of the pointers is null.
template <typename Scalar>
struct InstanceMesh {
  const ColliderState<Scalar>* own = nullptr;    ///< A mesh of the scene's Scalar.
  const ColliderState<float>* floats = nullptr;  ///< A mesh of floats in a scene of doubles.
  std::uint64_t version = 0;                     ///< The version of the mesh. No two meshes have the same one.
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

/// A query of a scene.
template <typename Scalar>
struct SceneQuery {
  const std::vector<CommittedInstance<Scalar>>& instances;  ///< The instances, by index.
  const InstanceTree& tree;                                 ///< The tree of their boxes.
  const SceneQueryOptions<Scalar>& options;                 ///< The options of the query.
  const SceneHitFilter<Scalar>* filter;                     ///< The filter, or null.
  QueryStatistics& statistics;                              ///< The query counts here.
  std::size_t path;  ///< The index of the path in its batch. For a part of a batch, it is that of the first path.
  Scalar share = 1;  ///< The share of each motion that a segment sees.

  /// Returns true if the filter accepts a hit, or if there is no filter.
  [[nodiscard]] bool accepts(const SceneHit<Scalar>& hit) const { return filter == nullptr || (*filter)(path, hit); }
  /// Returns true if no mask and no option leaves the instance out.
  [[nodiscard]] bool takes_part(std::uint32_t index) const {
    const CommittedInstance<Scalar>& instance = instances[index];
    return (instance.mask & options.instance_mask) != 0 &&
           !(options.ignored_triangle == no_triangle && is_ignored(index));
  }
  /// Returns true if the instance is the one that the options name.
  [[nodiscard]] bool is_ignored(std::uint32_t index) const {
    return options.ignored_instance == InstanceId{index, instances[index].generation};
  }
};

/// The searches of scenes, compiled for one instruction set.
template <typename Scalar>
struct SceneSearches {
  /// Returns the first hit of a path.
  std::optional<SceneHit<Scalar>> (*first)(const SceneQuery<Scalar>& query, const Path<Scalar>& path) noexcept;
  /// Returns true if a path has a hit.
  bool (*any)(const SceneQuery<Scalar>& query, const Path<Scalar>& path) noexcept;
  /// Appends all hits of a path in order. It may throw std::bad_alloc.
  void (*all)(const SceneQuery<Scalar>& query, const Path<Scalar>& path, std::vector<SceneHit<Scalar>>& hits);

  // The searches for batches. There are as many answers as paths. `own_options` has one element for each path, or none
  // at all.

  /// Sets each answer to the first hit of the path. A miss is SceneHit{}.
  void (*each_first)(const SceneQuery<Scalar>& batch, const PathSpan<Scalar>& paths,
                     std::span<const SceneQueryOptions<Scalar>> own_options, std::span<SceneHit<Scalar>> hits) noexcept;
  /// Sets each answer to 1 if the path has a hit, else to 0.
  void (*each_any)(const SceneQuery<Scalar>& batch, const PathSpan<Scalar>& paths,
                   std::span<const SceneQueryOptions<Scalar>> own_options, std::span<std::uint8_t> blocked) noexcept;
};

/// Returns the searches for the best instruction set that the machine has.
template <typename Scalar>
[[nodiscard]] const SceneSearches<Scalar>* best_scene_searches();

/// An instance, as it was set last.
template <typename Scalar>
struct PendingInstance {
  std::shared_ptr<const Collider<Scalar>> collider;       ///< The collider, or null.
  std::shared_ptr<const Collider<float>> float_collider;  ///< The collider of floats in a scene of doubles, or null.
  Placement<Scalar> placement;                            ///< Where it is.
  InstanceOptions options;                                ///< The mask and the user's number.
  std::uint32_t generation = 0;                           ///< The generation of the id.
  bool is_there = false;                                  ///< False for an index that is not in use.
  bool has_changed = false;                               ///< True if the index is among the changed ones.

  /// Returns true if it was removed since the last commit.
  [[nodiscard]] bool is_removed() const { return !is_there && (collider || float_collider); }
  /// Returns true if the index may be used again. An index whose generations are used up is not.
  [[nodiscard]] bool has_next_generation() const { return generation != std::numeric_limits<std::uint32_t>::max(); }
  /// Returns the mesh as it is now.
  [[nodiscard]] InstanceMesh<Scalar> mesh() const {
    if (collider) return {&ColliderState<Scalar>::of(*collider), nullptr, ColliderState<Scalar>::of(*collider).version};
    return {nullptr, &ColliderState<float>::of(*float_collider), ColliderState<float>::of(*float_collider).version};
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

  // What queries see.
  std::vector<CommittedInstance<Scalar>> committed;  ///< The instances by index.
  std::vector<InstanceBox> boxes;                    ///< Their boxes.
  InstanceTree tree;                                 ///< The tree of the boxes.
  const SceneSearches<Scalar>* searches = best_scene_searches<Scalar>();

  /// Returns the instance of an id, or null if the id is stale.
  [[nodiscard]] const PendingInstance<Scalar>* find(InstanceId id) const {
    const bool is_known =
        id.index < pending.size() && pending[id.index].is_there && pending[id.index].generation == id.generation;
    return is_known ? &pending[id.index] : nullptr;
  }
  [[nodiscard]] PendingInstance<Scalar>* find(InstanceId id) {
    return const_cast<PendingInstance<Scalar>*>(std::as_const(*this).find(id));
  }
  /// Notes that an instance has changed. There is room in `changed`.
  void note_change(std::uint32_t index) {
    if (!pending[index].has_changed) changed.push_back(index);
    pending[index].has_changed = true;
  }
  /// Lets all changes take effect. If it throws, queries answer as before.
  void commit(const Executor* executor);

 private:
  /// Notes the instances whose colliders were rebuilt since the last commit. There is room for all indices.
  void note_rebuilt_colliders();
  /// Returns true if the same instances are in the tree, and it is not worn. `made` has an instance for each change.
  [[nodiscard]] bool keeps_tree(const std::vector<CommittedInstance<Scalar>>& made) const;
  /// Returns a tree of all instances, as they are after the changes.
  [[nodiscard]] InstanceTree new_tree(const std::vector<CommittedInstance<Scalar>>& made) const;
  /// Forgets the changes, and what removed instances had.
  void end_changes() noexcept;
};

}  // namespace surehit::detail
