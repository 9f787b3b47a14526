#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "scene/committed_scene.hpp"
#include "scene/instance_tree.hpp"
#include "surehit/path_span.hpp"
#include "surehit/query_statistics.hpp"
#include "surehit/scene_hit.hpp"
#include "surehit/scene_query_options.hpp"

namespace surehit::detail {

/// A query of a scene. The options and the answers are those of paths, or those of moving shapes.
template <typename Scalar, typename Options, typename Answer>
struct AnySceneQuery {
  const std::vector<CommittedInstance<Scalar>>& instances;  ///< The instances, by index.
  const InstanceTree& tree;                                 ///< The tree of their boxes.
  const Options& options;                                   ///< The options of the query.
  const HitFilter<Scalar, Answer>* filter;                  ///< The filter, or null.
  QueryStatistics& statistics;                              ///< The query counts here.
  std::size_t path;  ///< The index of the path in its batch. For a part of a batch, it is that of the first path.
  Scalar share = 1;  ///< The share of each motion that a segment or a shape sees.

  /// Returns true if the filter accepts a hit, or if there is no filter.
  [[nodiscard]] bool accepts(const Answer& hit) const { return filter == nullptr || (*filter)(path, hit); }
  /// Returns true if no mask and no option leaves the instance out.
  [[nodiscard]] bool takes_part(std::uint32_t index) const {
    return (instances[index].mask & options.instance_mask) != 0 &&
           !(options.ignored_triangle == no_triangle && is_ignored(index));
  }
  /// Returns true if the instance is the one that the options name.
  [[nodiscard]] bool is_ignored(std::uint32_t index) const {
    return options.ignored_instance == InstanceId{index, instances[index].generation};
  }
};

/// A query of a scene about a path.
template <typename Scalar>
using SceneQuery = AnySceneQuery<Scalar, SceneQueryOptions<Scalar>, SceneHit<Scalar>>;

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

}  // namespace surehit::detail
