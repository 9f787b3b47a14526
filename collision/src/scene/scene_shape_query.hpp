#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "scene/committed_scene.hpp"
#include "scene/scene_query.hpp"
#include "shape/shape_contact.hpp"
#include "surehit/scene_shape_hit.hpp"
#include "surehit/scene_shape_options.hpp"

namespace surehit::detail {

/// A query of a scene about a moving shape. It counts as the path.
template <typename Scalar>
using SceneShapeQuery = AnySceneQuery<Scalar, SceneShapeQueryOptions<Scalar>, SceneShapeHit<Scalar>>;

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
