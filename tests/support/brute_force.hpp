#pragma once

#include <gmpxx.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "support/exact_oracle.hpp"
#include "surehit/intersect.hpp"
#include "surehit/triangle_mesh_view.hpp"

namespace surehit::test {

/// Hits of equal rounded t, brought into the order of their exact t by rationals.
template <typename Scalar>
void order_exactly(const TriangleMeshView<Scalar>& mesh, const Path<Scalar>& path, const QueryOptions<Scalar>& options,
                   std::span<Hit<Scalar>> hits) {
  std::vector<std::pair<mpq_class, Hit<Scalar>>> ordered;
  for (const Hit<Scalar>& hit : hits) {
    ordered.emplace_back(exact_contact(path, mesh.triangle(hit.triangle), options).value().t, hit);
  }
  std::stable_sort(ordered.begin(), ordered.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
  std::transform(ordered.begin(), ordered.end(), hits.begin(), [](const auto& one) { return one.second; });
}

/// What `Collider::all_hits` has to find, by asking every triangle. No grid, and no order but that of rationals.
template <typename Scalar>
std::vector<Hit<Scalar>> brute_force_hits(const TriangleMeshView<Scalar>& mesh, const Path<Scalar>& path,
                                          const QueryOptions<Scalar>& options = {},
                                          std::span<const std::uint32_t> masks = {}) {
  std::vector<Hit<Scalar>> hits;
  for (std::uint32_t id = 0; id < mesh.triangle_count(); ++id) {
    const std::uint32_t mask = masks.empty() ? ~std::uint32_t{0} : masks[id];
    if (id == options.ignored_triangle || (mask & options.mask) == 0) continue;
    if (auto hit = intersect(path, mesh.triangle(id), options)) {
      hit->triangle = id;
      hits.push_back(*hit);
    }
  }
  std::stable_sort(hits.begin(), hits.end(), [](const auto& x, const auto& y) { return x.t < y.t; });
  for (auto group = hits.begin(); group != hits.end();) {
    const auto end = std::find_if(group, hits.end(), [&](const auto& hit) { return hit.t != group->t; });
    if (end - group > 1) order_exactly(mesh, path, options, std::span(group, end));
    group = end;
  }
  return hits;
}

}  // namespace surehit::test
