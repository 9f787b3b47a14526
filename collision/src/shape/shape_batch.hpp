#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "shape/shape_query.hpp"

namespace surehit::detail {

/// A part of a batch of moving shapes.
template <typename Shape>
struct ShapeBatch {
  using Scalar = ScalarOf<Shape>;

  const Grid& grid;                                        ///< The grid of the collider.
  const MeshBlocks<Scalar>& mesh;                          ///< The mesh of the collider.
  const std::vector<std::uint32_t>& masks;                 ///< The mask of each triangle, or nothing.
  const ShapeQueryOptions<Scalar>& options;                ///< The options of all shapes.
  std::span<const ShapeQueryOptions<Scalar>> own_options;  ///< The options of each shape, or nothing.
  const ShapeHitFilter<Scalar>* filter;                    ///< The filter, or null.
  QueryStatistics& statistics;                             ///< The queries count here.
  std::size_t first;                                       ///< The index of the first shape in the whole batch.
  std::span<const Shape> shapes;                           ///< The shapes.

  /// Returns the query of a shape of this part.
  [[nodiscard]] ShapeQuery<Scalar> query(std::size_t index) const {
    const ShapeQueryOptions<Scalar>& of_shape = own_options.empty() ? options : own_options[index];
    return {grid, mesh, masks, of_shape, filter, statistics, first + index};
  }
};

/// Finds the first hit of each shape.
template <typename Shape>
void search_first(const ShapeBatch<Shape>& batch, std::span<ShapeHit<ScalarOf<Shape>>> hits) noexcept;
/// Sets whether each shape has a hit: 1 or 0.
template <typename Shape>
void search_any(const ShapeBatch<Shape>& batch, std::span<std::uint8_t> blocked) noexcept;

}  // namespace surehit::detail
