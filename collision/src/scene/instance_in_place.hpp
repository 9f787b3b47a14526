#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "collider_state.hpp"
#include "scene/committed_scene.hpp"
#include "scene/scene_query.hpp"

namespace surehit::detail {

/// The only instance of a scene, if it is where its mesh is. Its hits are those of its collider, which needs no pose.
template <typename Scalar>
class InstanceInPlace {
 public:
  /// Returns true if a query may ask the collider of such an instance. A filter wants to know the instance.
  [[nodiscard]] static bool answers(const SceneQuery<Scalar>& query) {
    const std::uint32_t index = query.tree.only_instance();
    if (index == InstanceTree::no_child || query.filter != nullptr) return false;
    const CommittedInstance<Scalar>& instance = query.instances[index];
    const auto& [frame, placement] = instance.placed;
    return instance.mesh.own != nullptr && !frame.is_turned && !frame.moves &&
           placement.pose.translation == Vector3<Scalar>::Zero() && query.takes_part(index);
  }

  explicit InstanceInPlace(const SceneQuery<Scalar>& query)
      : index_(query.tree.only_instance()),
        id_{index_, query.instances[index_].generation},
        mesh_(*query.instances[index_].mesh.own),
        options_(options_of(query, index_)),
        query_{mesh_.grid, mesh_.mesh, mesh_.masks, options_, nullptr, query.statistics, 0} {}
  InstanceInPlace(const InstanceInPlace&) = delete;
  InstanceInPlace& operator=(const InstanceInPlace&) = delete;

  [[nodiscard]] std::optional<SceneHit<Scalar>> first(const Path<Scalar>& path) const {
    ++query_.statistics.instances;
    const std::optional<Hit<Scalar>> hit = mesh_.searches->first(query_, path);
    if (!hit) return std::nullopt;
    return SceneHit<Scalar>{*hit, id_};
  }
  [[nodiscard]] bool any(const Path<Scalar>& path) const {
    ++query_.statistics.instances;
    return mesh_.searches->any(query_, path);
  }
  void each(const PathSpan<Scalar>& paths, std::span<SceneHit<Scalar>> hits) const {
    query_.statistics.instances += paths.size();
    std::array<Hit<Scalar>, paths_at_once> some;
    for (std::size_t from = 0; from < paths.size(); from += paths_at_once) {
      const std::size_t count = std::min(paths.size() - from, paths_at_once);
      mesh_.searches->each_first(query_, paths.subspan(from, count), {}, std::span(some).first(count));
      for (std::size_t i = 0; i < count; ++i) {
        const bool is_hit = some[i].triangle != no_triangle;
        hits[from + i] = is_hit ? SceneHit<Scalar>{some[i], id_} : SceneHit<Scalar>{};
      }
    }
  }
  void each(const PathSpan<Scalar>& paths, std::span<std::uint8_t> blocked) const {
    query_.statistics.instances += paths.size();
    mesh_.searches->each_any(query_, paths, {}, blocked);
  }

 private:
  /// So many hits lie on the stack. A batch needs some hundred paths to be fast.
  static constexpr std::size_t paths_at_once = 256;

  static QueryOptions<Scalar> options_of(const SceneQuery<Scalar>& query, std::uint32_t index) {
    const SceneQueryOptions<Scalar>& options = query.options;
    return {options.min_t,
            options.max_t,
            options.culling,
            options.mask,
            query.is_ignored(index) ? options.ignored_triangle : no_triangle,
            options.ignore_start_contact,
            options.ignore_end_contact};
  }

  const std::uint32_t index_;
  const InstanceId id_;
  const ColliderState<Scalar>& mesh_;
  const QueryOptions<Scalar> options_;
  const Query<Scalar> query_;  ///< The query of the collider.
};

}  // namespace surehit::detail
