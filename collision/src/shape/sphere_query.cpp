#include "shape/sphere_query.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "shape/sphere_filter.hpp"
#include "shape/sphere_narrowphase.hpp"
#include "support/rounding_flags.hpp"
#include "walk/swept_walk.hpp"

namespace surehit::detail {
namespace {

/// Remembers the last triangles that a ball was tested against, since most triangles are in the lists of several cells.
class Recent {
 public:
  Recent() { ids_.fill(no_triangle); }
  /// Returns true if the triangle is still remembered. Remembers it.
  [[nodiscard]] bool has(std::uint32_t id) {
    std::uint32_t& place = ids_[id % ids_.size()];
    const bool is_there = place == id;
    place = id;
    return is_there;
  }

 private:
  std::array<std::uint32_t, 64> ids_;
};

/// Gives the triangles of the lists that a walk visits to `Keep`. This keeps the hits that its query wants.
template <typename Scalar, typename Keep>
class SphereVisitor {
 public:
  SphereVisitor(const SphereQuery<Scalar>& query, const SweptSphere<Scalar>& sphere)
      : query_(query), filter_(sphere), narrowphase_(sphere, query.options, query.statistics) {}

  void count_cell() { ++query_.statistics.cells; }
  void visit_list(CellWord word) {
    const std::uint32_t count = query_.grid.entry_count(word);
    const std::size_t first = query_.grid.first_entry(word);
    const Scalar* const corners = MeshBlocks<Scalar>::corners(query_.mesh.block(word.list(), first));
    const std::size_t counting = keep_.count_that_counts(query_.grid.entries(), first, count);
    query_.statistics.candidates += counting;
    for (std::size_t from = 0; from < counting; from += SphereFilter<Scalar>::max_count) {
      std::uint64_t found = filter_.find(corners, count, from, keep_.limit, enters_);
      if (counting - from < 64) found &= (std::uint64_t{1} << (counting - from)) - 1;
      while (found != 0) {
        // The triangle that may be touched first comes first. Its hit may lower the limit below all others.
        const std::size_t lane = first_to_enter(found);
        if (enters_[lane] > keep_.limit) break;
        found &= ~(std::uint64_t{1} << lane);
        const std::uint32_t id = query_.grid.entries()[first + from + lane];
        if (recent_.has(id) || keep_.passes_over(id)) continue;
        take(id, MeshBlocks<Scalar>::triangle(corners, count, from + lane));
        if (is_done()) return;
      }
    }
  }
  void visit_all() {
    ++query_.statistics.unclipped;
    query_.statistics.candidates += query_.mesh.triangle_count();
    for (std::uint32_t id = 0; id < query_.mesh.triangle_count() && !is_done(); ++id)
      take(id, query_.mesh.triangle(id));
  }
  [[nodiscard]] double limit() const { return keep_.limit; }
  [[nodiscard]] bool is_done() const { return keep_.is_done; }
  [[nodiscard]] Keep& keep() { return keep_; }
  [[nodiscard]] const SphereNarrowphase<Scalar>& narrowphase() const { return narrowphase_; }

 private:
  /// Returns the lane that the ball may touch first, among the lanes of these bits. Of several, it is the lowest lane.
  [[nodiscard]] std::size_t first_to_enter(std::uint64_t lanes) const {
    auto first = static_cast<std::size_t>(std::countr_zero(lanes));
    for (lanes &= lanes - 1; lanes != 0; lanes &= lanes - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
      if (enters_[lane] < enters_[first]) first = lane;
    }
    return first;
  }
  void take(std::uint32_t id, const Triangle<Scalar>& triangle) {
    if (!query_.takes_part(id)) return;
    SphereCandidate<Scalar> candidate{id, triangle, {}};
    ++query_.statistics.undecided;
    if (narrowphase_.find_contact(triangle, keep_.limit, candidate.contact))
      keep_.take(query_, narrowphase_, candidate);
  }

  const SphereQuery<Scalar>& query_;
  SphereFilter<Scalar> filter_;
  typename SphereFilter<Scalar>::Times enters_;
  SphereNarrowphase<Scalar> narrowphase_;
  Recent recent_;
  Keep keep_;
};

/// Keeps the first hit.
template <typename Scalar>
struct KeepFirst {
  void take(const SphereQuery<Scalar>& query, const SphereNarrowphase<Scalar>& narrowphase,
            const SphereCandidate<Scalar>& candidate) {
    if (first && !narrowphase.comes_before(candidate, *first)) return;
    if (query.filter != nullptr && !query.accepts(narrowphase.hit(candidate))) return;
    first = candidate;
    limit = candidate.contact.t_upper;
  }
  /// Returns true if a triangle cannot be the first one, whatever its contact is.
  [[nodiscard]] bool passes_over(std::uint32_t id) const {
    return first && (id == first->id || (first->contact.at_start && id > first->id));
  }
  /// Returns how many triangles of a list may be the first one. If the ball begins with a contact, they are those with
  /// lower ids. Ids ascend in a list.
  [[nodiscard]] std::size_t count_that_counts(const PackedIds& ids, std::size_t from, std::size_t count) const {
    if (!first || !first->contact.at_start) return count;
    std::size_t low = 0;
    while (low < count) {
      const std::size_t middle = low + (count - low) / 2;
      if (ids[from + middle] < first->id) {
        low = middle + 1;
      } else {
        count = middle;
      }
    }
    return low;
  }
  std::optional<SphereCandidate<Scalar>> first;
  double limit = 1;
  static constexpr bool is_done = false;
};

/// Notes whether there is a hit.
template <typename Scalar>
struct KeepAny {
  void take(const SphereQuery<Scalar>& query, const SphereNarrowphase<Scalar>& narrowphase,
            const SphereCandidate<Scalar>& candidate) {
    is_done = query.filter == nullptr || query.accepts(narrowphase.hit(candidate));
  }
  [[nodiscard]] static bool passes_over(std::uint32_t) { return false; }
  [[nodiscard]] static std::size_t count_that_counts(const PackedIds&, std::size_t, std::size_t count) { return count; }
  static constexpr double limit = 1;
  bool is_done = false;
};

/// Keeps all hits.
template <typename Scalar>
struct KeepAll {
  void take(const SphereQuery<Scalar>&, const SphereNarrowphase<Scalar>&, const SphereCandidate<Scalar>& candidate) {
    all.push_back(candidate);
  }
  [[nodiscard]] static bool passes_over(std::uint32_t) { return false; }
  [[nodiscard]] static std::size_t count_that_counts(const PackedIds&, std::size_t, std::size_t count) { return count; }
  std::vector<SphereCandidate<Scalar>> all;
  static constexpr double limit = 1;
  static constexpr bool is_done = false;
};

/// Gives the visitor all triangles that the ball may touch.
template <typename Scalar, typename Visitor>
void walk(const SphereQuery<Scalar>& query, const SweptSphere<Scalar>& sphere, Visitor& visitor) {
  ++query.statistics.paths;
  if (query.grid.is_empty() || !is_valid(sphere) || !(query.options.max_t >= 0)) return;
  SweptExtents swept;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    swept.start[axis] = sphere.start[static_cast<Eigen::Index>(axis)];
    swept.end[axis] = sphere.end[static_cast<Eigen::Index>(axis)];
    swept.half_extents[axis] = sphere.radius;
  }
  if (!SweptWalk(query.grid, swept, visitor).walk()) visitor.visit_all();
}

}  // namespace

template <typename Scalar>
std::optional<ShapeHit<Scalar>> search_first(const SphereQuery<Scalar>& query,
                                             const SweptSphere<Scalar>& sphere) noexcept {
  SphereVisitor<Scalar, KeepFirst<Scalar>> visitor(query, sphere);
  walk(query, sphere, visitor);
  const auto& first = visitor.keep().first;
  if (!first) return std::nullopt;
  return visitor.narrowphase().hit(*first);
}

template <typename Scalar>
bool search_any(const SphereQuery<Scalar>& query, const SweptSphere<Scalar>& sphere) noexcept {
  SphereVisitor<Scalar, KeepAny<Scalar>> visitor(query, sphere);
  walk(query, sphere, visitor);
  return visitor.is_done();
}

template <typename Scalar>
void search_all(const SphereQuery<Scalar>& query, const SweptSphere<Scalar>& sphere,
                std::vector<ShapeHit<Scalar>>& hits) {
  SphereVisitor<Scalar, KeepAll<Scalar>> visitor(query, sphere);
  walk(query, sphere, visitor);
  visitor.narrowphase().sort(visitor.keep().all);
  for (const SphereCandidate<Scalar>& candidate : visitor.keep().all) {
    const ShapeHit<Scalar> hit = visitor.narrowphase().hit(candidate);
    if (query.accepts(hit)) hits.push_back(hit);
  }
}

#define SUREHIT_INSTANTIATE(Scalar)                                                           \
  template std::optional<ShapeHit<Scalar>> search_first(const SphereQuery<Scalar>&,           \
                                                        const SweptSphere<Scalar>&) noexcept; \
  template bool search_any(const SphereQuery<Scalar>&, const SweptSphere<Scalar>&) noexcept;  \
  template void search_all(const SphereQuery<Scalar>&, const SweptSphere<Scalar>&, std::vector<ShapeHit<Scalar>>&);
SUREHIT_INSTANTIATE(float)
SUREHIT_INSTANTIATE(double)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit::detail
