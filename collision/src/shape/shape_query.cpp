#include "shape/shape_query.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "shape/box_contact.hpp"
#include "shape/capsule_contact.hpp"
#include "shape/recent_triangles.hpp"
#include "shape/shape_filter.hpp"
#include "shape/shape_narrowphase.hpp"
#include "shape/sphere_contact.hpp"
#include "support/rounding_flags.hpp"
#include "walk/swept_walk.hpp"

namespace surehit::detail {
namespace {

/// Gives the triangles of the lists that a walk visits to `Keep`. This keeps the hits that its query wants.
template <typename Shape, typename Keep>
class ShapeVisitor {
  using Scalar = ScalarOf<Shape>;

 public:
  ShapeVisitor(const ShapeQuery<Scalar>& query, const Shape& shape)
      : query_(query), filter_(shape), narrowphase_(shape, query.options, query.statistics), keep_(query) {}

  void count_cell() { ++query_.statistics.cells; }
  void visit_list(CellWord word) {
    const std::uint32_t count = query_.grid.entry_count(word);
    const std::size_t first = query_.grid.first_entry(word);
    const Scalar* const corners = MeshBlocks<Scalar>::corners(query_.mesh.block(word.list(), first));
    const std::size_t counting = keep_.count_that_counts(query_.grid.entries(), first, count);
    query_.statistics.candidates += counting;
    for (std::size_t from = 0; from < counting; from += ShapeFilter<Scalar>::max_count) {
      std::uint64_t found = filter_.find(corners, count, from, keep_.limit, enters_);
      if (counting - from < 64) found &= (std::uint64_t{1} << (counting - from)) - 1;
      while (found != 0) {
        // The triangle that may be touched first comes first. Its hit may lower the limit below all others.
        const std::size_t lane = first_to_enter(found, enters_);
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
  [[nodiscard]] const ShapeNarrowphase<Shape>& narrowphase() const { return narrowphase_; }

 private:
  void take(std::uint32_t id, const Triangle<Scalar>& triangle) {
    if (!query_.takes_part(id)) return;
    ShapeCandidate<Shape> candidate{id, triangle, {}};
    ++query_.statistics.undecided;
    if (narrowphase_.find_contact(triangle, keep_.limit, candidate.contact))
      keep_.take(query_, narrowphase_, candidate);
  }

  const ShapeQuery<Scalar>& query_;
  ShapeFilter<Scalar> filter_;
  typename ShapeFilter<Scalar>::Times enters_;
  ShapeNarrowphase<Shape> narrowphase_;
  RecentTriangles recent_;
  Keep keep_;
};

/// Returns the last t that counts.
template <typename Scalar>
double last_t(const ShapeQuery<Scalar>& query) {
  return std::min(1.0, double{query.options.max_t});
}

/// Keeps the first hit.
template <typename Shape>
struct KeepFirst {
  using Scalar = ScalarOf<Shape>;

  explicit KeepFirst(const ShapeQuery<Scalar>& query) : limit(last_t(query)) {}
  void take(const ShapeQuery<Scalar>& query, const ShapeNarrowphase<Shape>& narrowphase,
            const ShapeCandidate<Shape>& candidate) {
    if (first && !narrowphase.comes_before(candidate, *first)) return;
    if (query.filter != nullptr && !query.accepts(narrowphase.hit(candidate))) return;
    first = candidate;
    limit = candidate.contact.t_upper;
  }
  /// Returns true if a triangle cannot be the first one, whatever its contact is.
  [[nodiscard]] bool passes_over(std::uint32_t id) const {
    return first && (id == first->id || (first->contact.at_start && id > first->id));
  }
  /// Returns how many triangles of a list may be the first one. If the shape begins with a contact, they are those with
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
  std::optional<ShapeCandidate<Shape>> first;
  double limit;
  static constexpr bool is_done = false;
};

/// Notes whether there is a hit.
template <typename Shape>
struct KeepAny {
  using Scalar = ScalarOf<Shape>;

  explicit KeepAny(const ShapeQuery<Scalar>& query) : limit(last_t(query)) {}
  void take(const ShapeQuery<Scalar>& query, const ShapeNarrowphase<Shape>& narrowphase,
            const ShapeCandidate<Shape>& candidate) {
    is_done = query.filter == nullptr || query.accepts(narrowphase.hit(candidate));
  }
  [[nodiscard]] static bool passes_over(std::uint32_t) { return false; }
  [[nodiscard]] static std::size_t count_that_counts(const PackedIds&, std::size_t, std::size_t count) { return count; }
  double limit;
  bool is_done = false;
};

/// Keeps all hits.
template <typename Shape>
struct KeepAll {
  using Scalar = ScalarOf<Shape>;

  explicit KeepAll(const ShapeQuery<Scalar>& query) : limit(last_t(query)) {}
  void take(const ShapeQuery<Scalar>&, const ShapeNarrowphase<Shape>&, const ShapeCandidate<Shape>& candidate) {
    all.push_back(candidate);
  }
  [[nodiscard]] static bool passes_over(std::uint32_t) { return false; }
  [[nodiscard]] static std::size_t count_that_counts(const PackedIds&, std::size_t, std::size_t count) { return count; }
  std::vector<ShapeCandidate<Shape>> all;
  double limit;
  static constexpr bool is_done = false;
};

/// Gives the visitor all triangles that the shape may touch.
template <typename Shape, typename Visitor>
void walk(const ShapeQuery<ScalarOf<Shape>>& query, const Shape& shape, Visitor& visitor) {
  ++query.statistics.paths;
  if (query.grid.is_empty() || !is_valid(shape) || !(query.options.max_t >= 0)) return;
  if (!SweptWalk(query.grid, swept_extents(shape), visitor, query.mesh.slabs()).walk()) visitor.visit_all();
}

}  // namespace

template <typename Shape>
std::optional<ShapeHit<ScalarOf<Shape>>> search_first(const ShapeQuery<ScalarOf<Shape>>& query,
                                                      const Shape& shape) noexcept {
  ShapeVisitor<Shape, KeepFirst<Shape>> visitor(query, shape);
  walk(query, shape, visitor);
  const auto& first = visitor.keep().first;
  if (!first) return std::nullopt;
  return visitor.narrowphase().hit(*first);
}

template <typename Shape>
bool search_any(const ShapeQuery<ScalarOf<Shape>>& query, const Shape& shape) noexcept {
  ShapeVisitor<Shape, KeepAny<Shape>> visitor(query, shape);
  walk(query, shape, visitor);
  return visitor.is_done();
}

template <typename Shape>
void search_all(const ShapeQuery<ScalarOf<Shape>>& query, const Shape& shape,
                std::vector<ShapeHit<ScalarOf<Shape>>>& hits) {
  ShapeVisitor<Shape, KeepAll<Shape>> visitor(query, shape);
  walk(query, shape, visitor);
  visitor.narrowphase().sort(visitor.keep().all);
  for (const ShapeCandidate<Shape>& candidate : visitor.keep().all) {
    const ShapeHit<ScalarOf<Shape>> hit = visitor.narrowphase().hit(candidate);
    if (query.accepts(hit)) hits.push_back(hit);
  }
}

#define SUREHIT_INSTANTIATE(Shape)                                                                   \
  template std::optional<ShapeHit<ScalarOf<Shape>>> search_first(const ShapeQuery<ScalarOf<Shape>>&, \
                                                                 const Shape&) noexcept;             \
  template bool search_any(const ShapeQuery<ScalarOf<Shape>>&, const Shape&) noexcept;               \
  template void search_all(const ShapeQuery<ScalarOf<Shape>>&, const Shape&, std::vector<ShapeHit<ScalarOf<Shape>>>&);
SUREHIT_INSTANTIATE(SweptBox<float>)
SUREHIT_INSTANTIATE(SweptBox<double>)
SUREHIT_INSTANTIATE(SweptSphere<float>)
SUREHIT_INSTANTIATE(SweptSphere<double>)
SUREHIT_INSTANTIATE(SweptCapsule<float>)
SUREHIT_INSTANTIATE(SweptCapsule<double>)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit::detail
