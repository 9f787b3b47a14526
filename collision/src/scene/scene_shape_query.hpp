#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "scene/committed_scene.hpp"
#include "shape/shape_contact.hpp"
#include "surehit/query_statistics.hpp"
#include "surehit/scene_shape_hit.hpp"
#include "surehit/scene_shape_options.hpp"

namespace surehit::detail {

/// A query of a scene about a moving shape.
template <typename Scalar>
struct SceneShapeQuery {
  const std::vector<CommittedInstance<Scalar>>& instances;  ///< The instances, by index.
  const InstanceTree& tree;                                 ///< The tree of their boxes.
  const SceneShapeQueryOptions<Scalar>& options;            ///< The options of the query.
  const SceneShapeHitFilter<Scalar>* filter;                ///< The filter, or null.
  QueryStatistics& statistics;                              ///< The query counts here.
  std::size_t path;                                         ///< The index of the shape in its batch.
  Scalar share = 1;                                         ///< The share of each motion that the shape sees.

  /// Returns true if the filter accepts a hit, or if there is no filter.
  [[nodiscard]] bool accepts(const SceneShapeHit<Scalar>& hit) const {
    return filter == nullptr || (*filter)(path, hit);
  }
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

/// Returns the first hit of a shape.
template <typename Shape>
[[nodiscard]] std::optional<SceneShapeHit<ScalarOf<Shape>>> search_first(const SceneShapeQuery<ScalarOf<Shape>>& query,
                                                                         const Shape& shape) noexcept;
/// Returns true if a shape has a hit.
template <typename Shape>
[[nodiscard]] bool search_any(const SceneShapeQuery<ScalarOf<Shape>>& query, const Shape& shape) noexcept;
/// Appends all hits of a shape in order. Each triangle of an instance has at most one hit. It may throw std::bad_alloc.
template <typename Shape>
void search_all(const SceneShapeQuery<ScalarOf<Shape>>& query, const Shape& shape,
                std::vector<SceneShapeHit<ScalarOf<Shape>>>& hits);

/// Returns true if a shape touches a triangle of an instance before or at t = `max_t`.
template <typename Shape>
[[nodiscard]] bool touches(const CommittedInstance<ScalarOf<Shape>>& instance, std::uint32_t triangle,
                           const Shape& shape, ScalarOf<Shape> max_t) noexcept;

}  // namespace surehit::detail
