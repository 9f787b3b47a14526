#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "grid/grid.hpp"
#include "mesh/mesh_blocks.hpp"
#include "surehit/query_statistics.hpp"
#include "surehit/shape_hit.hpp"
#include "surehit/shape_options.hpp"
#include "surehit/swept_sphere.hpp"

namespace surehit::detail {

/// A query of one collider about a moving ball.
template <typename Scalar>
struct SphereQuery {
  const Grid& grid;                          ///< The grid of the collider.
  const MeshBlocks<Scalar>& mesh;            ///< The mesh of the collider.
  const std::vector<std::uint32_t>& masks;   ///< The mask of each triangle. It is empty if all masks have all bits.
  const ShapeQueryOptions<Scalar>& options;  ///< The options of the query.
  const ShapeHitFilter<Scalar>* filter;      ///< The filter, or null.
  QueryStatistics& statistics;               ///< The query counts here.
  std::size_t path;                          ///< The index of the ball in its batch.

  /// Returns true if the filter accepts a hit, or if there is no filter.
  [[nodiscard]] bool accepts(const ShapeHit<Scalar>& hit) const { return filter == nullptr || (*filter)(path, hit); }
  /// Returns true if no mask and no option leaves the triangle out.
  [[nodiscard]] bool takes_part(std::uint32_t id) const {
    const std::uint32_t mask = masks.empty() ? ~std::uint32_t{0} : masks[id];
    return (mask & options.mask) != 0 && id != options.ignored_triangle;
  }
};

/// Returns the first hit of a ball.
template <typename Scalar>
[[nodiscard]] std::optional<ShapeHit<Scalar>> search_first(const SphereQuery<Scalar>& query,
                                                           const SweptSphere<Scalar>& sphere) noexcept;
/// Returns true if a ball has a hit.
template <typename Scalar>
[[nodiscard]] bool search_any(const SphereQuery<Scalar>& query, const SweptSphere<Scalar>& sphere) noexcept;
/// Appends all hits of a ball in order. Each triangle has at most one hit. It may throw std::bad_alloc.
template <typename Scalar>
void search_all(const SphereQuery<Scalar>& query, const SweptSphere<Scalar>& sphere,
                std::vector<ShapeHit<Scalar>>& hits);

}  // namespace surehit::detail
