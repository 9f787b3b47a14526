#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "grid/grid.hpp"
#include "mesh/mesh_blocks.hpp"
#include "path_range.hpp"
#include "surehit/hit.hpp"
#include "surehit/hit_filter.hpp"
#include "surehit/path.hpp"
#include "surehit/path_span.hpp"
#include "surehit/query_options.hpp"
#include "surehit/query_statistics.hpp"

namespace surehit::detail {

/// A query of one collider.
template <typename Scalar>
struct Query {
  const Grid& grid;                         ///< The grid of the collider.
  const MeshBlocks<Scalar>& mesh;           ///< The mesh of the collider.
  const std::vector<std::uint32_t>& masks;  ///< The mask of each triangle. It is empty if all masks have all bits.
  const QueryOptions<Scalar>& options;      ///< The options of the query.
  const HitFilter<Scalar>* filter;          ///< The filter, or null.
  QueryStatistics& statistics;              ///< The query counts here.
  std::size_t path;  ///< The index of the path in its batch. For a part of a batch, it is that of the first path.

  /// Returns true if the filter accepts a hit, or if there is no filter.
  [[nodiscard]] bool accepts(const Hit<Scalar>& hit) const { return filter == nullptr || (*filter)(path, hit); }
  /// Returns true if no mask and no option leaves the triangle out.
  [[nodiscard]] bool takes_part(std::uint32_t id) const {
    const std::uint32_t mask = masks.empty() ? ~std::uint32_t{0} : masks[id];
    return (mask & options.mask) != 0 && id != options.ignored_triangle;
  }
};

/// The searches, compiled for one instruction set.
template <typename Scalar>
struct Searches {
  /// Returns the first hit of a path.
  std::optional<Hit<Scalar>> (*first)(const Query<Scalar>& query, const Path<Scalar>& path) noexcept;
  /// Returns true if a path has a hit.
  bool (*any)(const Query<Scalar>& query, const Path<Scalar>& path) noexcept;
  /// Appends all hits of a path in order. Each triangle has at most one hit. It may throw std::bad_alloc.
  void (*all)(const Query<Scalar>& query, const Path<Scalar>& path, std::vector<Hit<Scalar>>& hits);

  // The searches for batches. There are as many answers as paths. `own_options` has one element for each path, or none
  // at all.

  /// Sets each answer to the first hit of the path. A miss is Hit{}.
  void (*each_first)(const Query<Scalar>& query, const PathSpan<Scalar>& paths,
                     std::span<const QueryOptions<Scalar>> own_options, std::span<Hit<Scalar>> hits) noexcept;
  /// Sets each answer to 1 if the path has a hit, else to 0.
  void (*each_any)(const Query<Scalar>& query, const PathSpan<Scalar>& paths,
                   std::span<const QueryOptions<Scalar>> own_options, std::span<std::uint8_t> blocked) noexcept;
};

/// Returns the searches for the best instruction set that the machine has.
template <typename Scalar>
[[nodiscard]] const Searches<Scalar>* best_searches();

/// Returns the query of path `index` of a batch.
template <typename Scalar>
[[nodiscard]] Query<Scalar> query_of_path(const Query<Scalar>& batch, std::span<const QueryOptions<Scalar>> own_options,
                                          std::size_t index) {
  return {batch.grid,   batch.mesh,       batch.masks,       own_options.empty() ? batch.options : own_options[index],
          batch.filter, batch.statistics, batch.path + index};
}

}  // namespace surehit::detail
