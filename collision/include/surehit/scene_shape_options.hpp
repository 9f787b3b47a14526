#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "surehit/executor.hpp"
#include "surehit/instance.hpp"
#include "surehit/query_options.hpp"
#include "surehit/query_statistics.hpp"
#include "surehit/scene_shape_hit.hpp"

namespace surehit {

/// What narrows a query of a moving shape in a scene. The members with the names of `ShapeQueryOptions` or of
/// `SceneQueryOptions` mean the same.
template <FloatOrDouble Scalar>
struct SceneShapeQueryOptions {
  Scalar max_t = detail::infinity<Scalar>;  ///< The maximum t that counts.
  /// Leaves out placed triangles by the side from which the shape moves against them. If an instance moves, this is the
  /// shape's step less the motion.
  Culling culling = Culling::none;
  std::uint32_t mask = ~std::uint32_t{0};           ///< Leaves out triangles whose mask shares no bit with this.
  std::uint32_t instance_mask = ~std::uint32_t{0};  ///< Leaves out instances whose mask shares no bit with this.
  InstanceId ignored_instance = {};                 ///< Leaves out this instance, or one triangle of it.
  /// Leaves out this triangle of `ignored_instance`, and keeps its others. Without an ignored instance it means
  /// nothing.
  std::uint32_t ignored_triangle = no_triangle;
  bool ignore_start_contact = false;  ///< Leaves out triangles that the shape touches at its start.
};

/// How a batch of moving shapes is answered by a scene. The members mean the same as in `ShapeBatchOptions`.
template <FloatOrDouble Scalar>
struct SceneShapeBatchOptions {
  SceneShapeQueryOptions<Scalar> options = {};                        ///< The options of all shapes.
  std::span<const SceneShapeQueryOptions<Scalar>> path_options = {};  ///< The options of each, in place of `options`.
  std::optional<SceneShapeHitFilter<Scalar>> filter = {};             ///< Decides which hits count.
  std::optional<Executor> executor = {};                              ///< Spreads the batch over threads.
  QueryStatistics* statistics = nullptr;                              ///< The batch adds its work to these.
};

using SceneShapeQueryOptionsf = SceneShapeQueryOptions<float>;   ///< Options of a moving shape in a scene in float.
using SceneShapeQueryOptionsd = SceneShapeQueryOptions<double>;  ///< Options of a moving shape in a scene in double.
using SceneShapeBatchOptionsf = SceneShapeBatchOptions<float>;   ///< Options of a batch of them in float.
using SceneShapeBatchOptionsd = SceneShapeBatchOptions<double>;  ///< Options of a batch of them in double.

}  // namespace surehit
