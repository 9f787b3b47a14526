#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "surehit/executor.hpp"
#include "surehit/instance.hpp"
#include "surehit/query_options.hpp"
#include "surehit/query_statistics.hpp"
#include "surehit/scene_hit.hpp"

namespace surehit {

/// What narrows a query of a scene. The members with the names of `QueryOptions` mean the same.
template <FloatOrDouble Scalar>
struct SceneQueryOptions {
  Scalar min_t = -detail::infinity<Scalar>;         ///< The minimum t that counts.
  Scalar max_t = detail::infinity<Scalar>;          ///< The maximum t that counts.
  Culling culling = Culling::none;                  ///< Leaves out hits by the side of the placed triangle.
  std::uint32_t mask = ~std::uint32_t{0};           ///< Leaves out triangles whose mask shares no bit with this.
  std::uint32_t instance_mask = ~std::uint32_t{0};  ///< Leaves out instances whose mask shares no bit with this.
  InstanceId ignored_instance = {};  ///< Leaves out this instance, or one triangle of it. A stale id means nothing.
  /// Leaves out this triangle of `ignored_instance`, and keeps its others. Without an ignored instance it means
  /// nothing.
  std::uint32_t ignored_triangle = no_triangle;
  bool ignore_start_contact = false;  ///< Leaves out triangles that exactly contain the start.
  bool ignore_end_contact = false;    ///< Leaves out triangles that exactly contain the end.
};

/// How a batch of paths is answered by a scene. The members mean the same as in `BatchOptions`.
template <FloatOrDouble Scalar>
struct SceneBatchOptions {
  SceneQueryOptions<Scalar> options = {};                        ///< The options of all paths.
  std::span<const SceneQueryOptions<Scalar>> path_options = {};  ///< The options of each path, in place of `options`.
  std::optional<SceneHitFilter<Scalar>> filter = {};             ///< Decides which hits count.
  std::optional<Executor> executor = {};                         ///< Spreads the batch over threads.
  QueryStatistics* statistics = nullptr;                         ///< The batch adds its work to these.
};

using SceneQueryOptionsf = SceneQueryOptions<float>;   ///< Options of a query of a scene in float.
using SceneQueryOptionsd = SceneQueryOptions<double>;  ///< Options of a query of a scene in double.
using SceneBatchOptionsf = SceneBatchOptions<float>;   ///< Options of a batch in float.
using SceneBatchOptionsd = SceneBatchOptions<double>;  ///< Options of a batch in double.

}  // namespace surehit
