#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "grid/grid.hpp"
#include "mesh/mesh_blocks.hpp"
#include "query/path_range.hpp"
#include "query/path_span.hpp"
#include "surehit/hit.hpp"
#include "surehit/hit_filter.hpp"
#include "surehit/path.hpp"
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

  [[nodiscard]] bool takes_part(std::uint32_t id) const {
    const std::uint32_t mask = masks.empty() ? ~std::uint32_t{0} : masks[id];
    return (mask & options.mask) != 0 && id != options.ignored_triangle;
  }
};

// These run on the best instruction set that the machine has; query.cpp compiles them for each.

template <typename Scalar>
[[nodiscard]] std::optional<Hit<Scalar>> first_hit(const Query<Scalar>& query, const Path<Scalar>& path) noexcept;
template <typename Scalar>
[[nodiscard]] bool any_hit(const Query<Scalar>& query, const Path<Scalar>& path) noexcept;
/// Appends to `hits`, sorted, each triangle once.
template <typename Scalar>
void all_hits(const Query<Scalar>& query, const Path<Scalar>& path, std::vector<Hit<Scalar>>& hits);

// Batches, as long as the paths are; a miss is Hit{}. Only float has lanes to walk in: in double it is one by one.

template <typename Scalar>
void first_hits(const Query<Scalar>& query, const PathSpan<Scalar>& paths, Hit<Scalar>* hits) noexcept;
template <typename Scalar>
void any_hits(const Query<Scalar>& query, const PathSpan<Scalar>& paths, std::uint8_t* blocked) noexcept;

}  // namespace surehit::detail
