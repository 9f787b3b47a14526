#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "narrowphase.hpp"
#include "surehit/grid.hpp"
#include "surehit/grid_traversal.hpp"
#include "surehit/hit_filter.hpp"

namespace surehit::detail {

/// One path against one collider: walks the grid and shows each listed triangle to the narrowphase.
template <typename Scalar>
class Query {
 public:
  using Candidate = typename Narrowphase<Scalar>::Candidate;

  Query(const Grid& grid, const std::vector<Triangle<Scalar>>& triangles, const std::vector<std::uint32_t>& masks,
        const Path<Scalar>& path, const QueryOptions<Scalar>& options, const HitFilter<Scalar>* filter,
        QueryStatistics& statistics)
      : grid_(grid),
        triangles_(triangles),
        masks_(masks),
        path_(path),
        options_(options),
        filter_(filter),
        statistics_(statistics),
        narrowphase_(path, options, statistics) {}

  [[gnu::noinline]] std::optional<Hit<Scalar>> first_hit() const {
    Candidate best;
    Hit<Scalar> best_hit;
    walk([&](std::uint32_t id, GridTraversal& traversal) {
      if (id == best.id) return true;
      const std::optional<Contact> contact = narrowphase_.contact(triangles_[id]);
      if (!contact) return true;
      const Candidate candidate{&triangles_[id], id, *contact};
      if (best.id != no_triangle && !narrowphase_.comes_before(candidate, best)) return true;
      if (!passes_filter(candidate, best_hit)) return true;
      best = candidate;
      traversal.shorten(contact->t_upper);
      return true;
    });
    if (best.id == no_triangle) return std::nullopt;
    return filter_ != nullptr ? best_hit : narrowphase_.hit(best);
  }

  [[gnu::noinline]] bool any_hit() const {
    bool blocked = false;
    walk([&](std::uint32_t id, GridTraversal&) {
      if (filter_ == nullptr) {
        blocked = narrowphase_.meets(triangles_[id]);
      } else if (const std::optional<Contact> contact = narrowphase_.contact(triangles_[id])) {
        Hit<Scalar> hit;
        blocked = passes_filter({&triangles_[id], id, *contact}, hit);
      }
      return !blocked;
    });
    return blocked;
  }

  [[gnu::noinline]] void all_hits(std::vector<Hit<Scalar>>& hits) const {
    std::vector<Candidate> found;
    walk([&](std::uint32_t id, GridTraversal&) {
      if (const std::optional<Contact> contact = narrowphase_.contact(triangles_[id])) {
        found.push_back({&triangles_[id], id, *contact});
      }
      return true;
    });
    // A triangle is found once in every cell that lists it.
    std::sort(found.begin(), found.end(), [](const Candidate& x, const Candidate& y) { return x.id < y.id; });
    found.erase(
        std::unique(found.begin(), found.end(), [](const Candidate& x, const Candidate& y) { return x.id == y.id; }),
        found.end());
    std::sort(found.begin(), found.end(),
              [&](const Candidate& x, const Candidate& y) { return narrowphase_.comes_before(x, y); });
    for (const Candidate& candidate : found) {
      Hit<Scalar> hit;
      if (!passes_filter(candidate, hit)) continue;
      hits.push_back(filter_ != nullptr ? hit : narrowphase_.hit(candidate));
    }
  }

 private:
  /// Shows `visit(id, traversal)` the triangles of the path's cells until it returns false or the walk ends.
  template <typename Visit>
  void walk(Visit&& visit) const {
    if (narrowphase_.admits_nothing() || triangles_.empty()) return;
    GridTraversal traversal(grid_, path_, narrowphase_.range().first, narrowphase_.range().last);
    if (traversal.is_unclipped()) {
      ++statistics_.unclipped;
      for (std::uint32_t id = 0; id < triangles_.size(); ++id) {
        if (takes_part(id) && !visit(id, traversal)) return;
      }
      return;
    }
    for (; !traversal.at_end(); traversal.advance()) {
      ++statistics_.cells;
      for (const std::uint32_t id : grid_.triangles(traversal.cell())) {
        if (takes_part(id) && !visit(id, traversal)) return;
      }
    }
  }

  [[nodiscard]] bool takes_part(std::uint32_t id) const {
    const std::uint32_t mask = masks_.empty() ? ~std::uint32_t{0} : masks_[id];
    return (mask & options_.mask) != 0 && id != options_.ignored_triangle;
  }

  /// Where there is a filter, `hit` becomes what it was shown.
  [[nodiscard]] bool passes_filter(const Candidate& candidate, Hit<Scalar>& hit) const {
    if (filter_ == nullptr) return true;
    const Hit<Scalar> shown = narrowphase_.hit(candidate);
    if (!(*filter_)(shown)) return false;
    hit = shown;
    return true;
  }

  const Grid& grid_;
  const std::vector<Triangle<Scalar>>& triangles_;
  const std::vector<std::uint32_t>& masks_;
  const Path<Scalar>& path_;
  const QueryOptions<Scalar>& options_;
  const HitFilter<Scalar>* filter_;
  QueryStatistics& statistics_;
  Narrowphase<Scalar> narrowphase_;
};

}  // namespace surehit::detail
