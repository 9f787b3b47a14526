#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "grid/grid.hpp"
#include "mesh/mesh_blocks.hpp"
#include "shape/shape_contact.hpp"
#include "surehit/query_statistics.hpp"
#include "surehit/shape_hit.hpp"
#include "surehit/shape_options.hpp"

namespace surehit::detail {

/// A query of one collider about a moving shape.
template <typename Scalar>
struct ShapeQuery {
  const Grid& grid;                          ///< The grid of the collider.
  const MeshBlocks<Scalar>& mesh;            ///< The mesh of the collider.
  const std::vector<std::uint32_t>& masks;   ///< The mask of each triangle. It is empty if all masks have all bits.
  const ShapeQueryOptions<Scalar>& options;  ///< The options of the query.
  const ShapeHitFilter<Scalar>* filter;      ///< The filter, or null.
  QueryStatistics& statistics;               ///< The query counts here.
  std::size_t path;                          ///< The index of the shape in its batch.

  /// Returns true if the filter accepts a hit, or if there is no filter.
  [[nodiscard]] bool accepts(const ShapeHit<Scalar>& hit) const { return filter == nullptr || (*filter)(path, hit); }
  /// Returns true if no mask and no option leaves the triangle out.
  [[nodiscard]] bool takes_part(std::uint32_t id) const {
    const std::uint32_t mask = masks.empty() ? ~std::uint32_t{0} : masks[id];
    return (mask & options.mask) != 0 && id != options.ignored_triangle;
  }
};

/// Returns the first hit of a shape.
template <typename Shape>
[[nodiscard]] std::optional<ShapeHit<ScalarOf<Shape>>> search_first(const ShapeQuery<ScalarOf<Shape>>& query,
                                                                    const Shape& shape) noexcept;
/// Returns true if a shape has a hit.
template <typename Shape>
[[nodiscard]] bool search_any(const ShapeQuery<ScalarOf<Shape>>& query, const Shape& shape) noexcept;
/// Appends all hits of a shape in order. Each triangle has at most one hit. It may throw std::bad_alloc.
template <typename Shape>
void search_all(const ShapeQuery<ScalarOf<Shape>>& query, const Shape& shape,
                std::vector<ShapeHit<ScalarOf<Shape>>>& hits);

}  // namespace surehit::detail
