#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "grid/grid.hpp"
#include "mesh/mesh_blocks.hpp"
#include "query/path_range.hpp"
#include "surehit/hit.hpp"
#include "surehit/hit_filter.hpp"
#include "surehit/path.hpp"
#include "surehit/path_span.hpp"
#include "surehit/query_options.hpp"
#include "surehit/query_statistics.hpp"

namespace surehit::detail {

/// What is asked of one collider, whatever the paths are.
template <typename Scalar>
struct Query {
  const Grid& grid;
  const MeshBlocks<Scalar>& mesh;
  const std::vector<std::uint32_t>& masks;  ///< one a triangle, or none
  const QueryOptions<Scalar>& options;
  const HitFilter<Scalar>* filter;  ///< none if null
  QueryStatistics& statistics;
  std::size_t path;  ///< the index of the path in its batch, or of the batch's first path

  /// Whether the filter accepts a hit.
  [[nodiscard]] bool accepts(const Hit<Scalar>& hit) const { return filter == nullptr || (*filter)(path, hit); }
  [[nodiscard]] bool takes_part(std::uint32_t id) const {
    const std::uint32_t mask = masks.empty() ? ~std::uint32_t{0} : masks[id];
    return (mask & options.mask) != 0 && id != options.ignored_triangle;
  }
};

// These run on the best instruction set that the machine has; query.cpp compiles them for each.

template <typename Scalar>
[[nodiscard]] std::optional<Hit<Scalar>> dispatch_first_hit(const Query<Scalar>& query,
                                                            const Path<Scalar>& path) noexcept;
template <typename Scalar>
[[nodiscard]] bool dispatch_any_hit(const Query<Scalar>& query, const Path<Scalar>& path) noexcept;
/// Appends to `hits`, sorted, each triangle once.
template <typename Scalar>
void dispatch_all_hits(const Query<Scalar>& query, const Path<Scalar>& path, std::vector<Hit<Scalar>>& hits);

// These answer batches. There are as many answers as paths, and a miss is Hit{}. `own_options` has one element for each
// path, or none.

template <typename Scalar>
void dispatch_first_hits(const Query<Scalar>& query, const PathSpan<Scalar>& paths,
                         std::span<const QueryOptions<Scalar>> own_options, Hit<Scalar>* hits) noexcept;
template <typename Scalar>
void dispatch_any_hits(const Query<Scalar>& query, const PathSpan<Scalar>& paths,
                       std::span<const QueryOptions<Scalar>> own_options, std::uint8_t* blocked) noexcept;

/// What a batch's query asks of its path `index`.
template <typename Scalar>
[[nodiscard]] Query<Scalar> query_of_path(const Query<Scalar>& batch, std::span<const QueryOptions<Scalar>> own_options,
                                          std::size_t index) {
  return {batch.grid,   batch.mesh,       batch.masks,       own_options.empty() ? batch.options : own_options[index],
          batch.filter, batch.statistics, batch.path + index};
}

}  // namespace surehit::detail
