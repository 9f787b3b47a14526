#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "surehit/executor.hpp"
#include "surehit/hit_filter.hpp"
#include "surehit/query_options.hpp"
#include "surehit/query_statistics.hpp"
#include "surehit/shape_hit.hpp"

namespace surehit {

/// What narrows a query of a moving shape. The defaults leave out only triangles whose mask is 0.
template <FloatOrDouble Scalar>
struct ShapeQueryOptions {
  /// The maximum t that counts, compared with the exact t. It never makes a step longer. With a NaN or a negative
  /// number, nothing is hit. With 0, only what the shape touches at its start is hit.
  Scalar max_t = detail::infinity<Scalar>;
  /// Leaves out triangles by the side from which the shape moves against them: the sign of the step times the normal.
  /// `Culling::back` and `Culling::front` also leave out triangles along which the shape moves, and those without area.
  Culling culling = Culling::none;
  std::uint32_t mask = ~std::uint32_t{0};        ///< Leaves out triangles whose mask shares no bit with this.
  std::uint32_t ignored_triangle = no_triangle;  ///< Leaves out this triangle.
  /// Leaves out triangles that the shape touches at its start. So a shape may leave the ground on which it rests.
  bool ignore_start_contact = false;
};

/// A filter of hits of moving shapes.
template <FloatOrDouble Scalar>
using ShapeHitFilter = HitFilter<Scalar, ShapeHit<Scalar>>;

/// How a batch of moving shapes is answered. The defaults keep all hits, and use the calling thread alone.
template <FloatOrDouble Scalar>
struct ShapeBatchOptions {
  /// The options of all shapes.
  ShapeQueryOptions<Scalar> options = {};
  /// The options of each shape, in place of `options`. Element i is for shape i. If it is empty, `options` are for all.
  std::span<const ShapeQueryOptions<Scalar>> path_options = {};
  /// Decides which hits count. None accepts all. The executor's threads may call it at the same time.
  std::optional<ShapeHitFilter<Scalar>> filter = {};
  /// Spreads the batch over threads, in tasks of some hundred shapes each.
  std::optional<Executor> executor = {};
  /// The batch adds its work to these, unless this is null. Nothing else may use them while the batch runs.
  QueryStatistics* statistics = nullptr;
};

using ShapeQueryOptionsf = ShapeQueryOptions<float>;   ///< Options of a moving shape in float.
using ShapeQueryOptionsd = ShapeQueryOptions<double>;  ///< Options of a moving shape in double.
using ShapeBatchOptionsf = ShapeBatchOptions<float>;   ///< Options of a batch of moving shapes in float.
using ShapeBatchOptionsd = ShapeBatchOptions<double>;  ///< Options of a batch of moving shapes in double.

}  // namespace surehit
