#include "scene/scene_shape_query.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <tuple>

#include "scene/placed_shape.hpp"
#include "scene/swept_tree_walk.hpp"
#include "shape/box_contact.hpp"
#include "shape/capsule_contact.hpp"
#include "shape/kept_contacts.hpp"
#include "shape/placed_shape_candidate.hpp"
#include "shape/recent_triangles.hpp"
#include "shape/shape_contact.hpp"
#include "shape/shape_filter.hpp"
#include "shape/shape_narrowphase.hpp"
#include "support/rounding_flags.hpp"
#include "walk/swept_walk.hpp"

namespace surehit::detail {

template <typename Shape>
using PlacedCandidateOf = PlacedShapeCandidate<Shape>;
template <typename Shape>
using PlacedNarrowphase = ShapeNarrowphase<Shape, PlacedShapeCandidate<Shape>>;

/// Returns a hit as it is reported. `KeepFirst` would not find this in a namespace without a name.
template <typename Shape>
SceneShapeHit<ScalarOf<Shape>> hit_of(const SceneShapeQuery<ScalarOf<Shape>>& query,
                                      const PlacedNarrowphase<Shape>& narrowphase,
                                      const PlacedCandidateOf<Shape>& candidate) {
  return {narrowphase.hit(candidate), {candidate.instance, query.instances[candidate.instance].generation}};
}

namespace {

/// Returns a triangle of a mesh in the Scalar of a scene.
template <typename Scalar, typename MeshScalar>
Triangle<Scalar> converted(const Triangle<MeshScalar>& triangle) {
  return {triangle.a.template cast<Scalar>(), triangle.b.template cast<Scalar>(), triangle.c.template cast<Scalar>()};
}

/// Triangles of a list, placed. It has no meaning between two lists, and all instances of a query share it.
struct PlacedGroup {
  static constexpr std::size_t max_count = ShapeFilter<double>::max_count;  ///< The number of triangles in a call.

  typename ShapeFilter<double>::Times enters;
  /// The corners, in the layout of `MeshBlocks::corners`. A vector load may read beyond the last one.
  std::array<double, 9 * max_count + 16> corners = {};
};

/// Gives the triangles of one instance that a shape may touch to `Keep`.
template <typename Shape, typename MeshScalar, typename Keep>
class PlacedShapeVisitor final : public SweptVisitor {
  using Scalar = ScalarOf<Shape>;

 public:
  PlacedShapeVisitor(const SceneShapeQuery<Scalar>& query, const PlacedNarrowphase<Shape>& narrowphase,
                     std::uint32_t index, const ColliderState<MeshScalar>& mesh, const PlacedShape& placed,
                     const Shape& shape, PlacedGroup& group, Keep& keep)
      : query_(query),
        narrowphase_(narrowphase),
        index_(index),
        mesh_(mesh),
        is_ignored_(query.is_ignored(index)),
        placed_(placed),
        filter_(placed.near_anchor(shape)),
        group_(group),
        keep_(keep) {}

  double visit_list(CellWord word) override {
    const std::uint32_t count = mesh_.grid.entry_count(word);
    const std::size_t first = mesh_.grid.first_entry(word);
    const PackedIds::Range ids = mesh_.grid.entries().between(first, first + count);
    const std::size_t counting = keep_.count_that_counts(ids, [&](std::uint32_t id) { return std::tuple(index_, id); });
    const MeshScalar* const corners = MeshBlocks<MeshScalar>::corners(mesh_.mesh.block(word.list(), first));
    query_.statistics.candidates += counting;
    for (std::size_t from = 0; from < counting; from += PlacedGroup::max_count) {
      const std::size_t in_group = std::min(counting - from, PlacedGroup::max_count);
      placed_.place(corners + from, count, in_group, in_group, group_.corners.data());
      std::uint64_t found = filter_.find(group_.corners.data(), in_group, 0, keep_.limit, group_.enters);
      while (found != 0) {
        // The triangle that may be touched first comes first. Its hit may lower the limit below all others.
        const std::size_t lane = first_to_enter(found, group_.enters);
        if (group_.enters[lane] > keep_.limit) break;
        found &= ~(std::uint64_t{1} << lane);
        const std::uint32_t id = mesh_.grid.entries()[first + from + lane];
        if (recent_.has(id)) continue;
        take(id, MeshBlocks<MeshScalar>::triangle(corners, count, from + lane));
        if (is_done()) return -1;
      }
    }
    return keep_.limit;
  }
  void visit_all() {
    const auto count = static_cast<std::uint32_t>(mesh_.mesh.triangle_count());
    ++query_.statistics.unclipped;
    query_.statistics.candidates += count;
    for (std::uint32_t id = 0; id < count && !is_done(); ++id) take(id, mesh_.mesh.triangle(id));
  }

 private:
  [[nodiscard]] bool is_done() const { return keep_.is_done; }
  [[nodiscard]] bool takes_part(std::uint32_t id) const {
    const std::uint32_t mask = mesh_.masks.empty() ? ~std::uint32_t{0} : mesh_.masks[id];
    return (mask & query_.options.mask) != 0 && !(is_ignored_ && id == query_.options.ignored_triangle);
  }
  void take(std::uint32_t id, const Triangle<MeshScalar>& triangle) {
    if (!takes_part(id) || keep_.passes_over(std::tuple(index_, id))) return;
    PlacedCandidateOf<Shape> candidate{
        index_, id, converted<Scalar>(triangle), &query_.instances[index_].placed.placement, {}, query_.share};
    ++query_.statistics.undecided;
    if (narrowphase_.find_contact(candidate.whole_triangle(), keep_.limit, candidate.contact))
      keep_.take(query_, narrowphase_, candidate);
  }

  const SceneShapeQuery<Scalar>& query_;
  const PlacedNarrowphase<Shape>& narrowphase_;
  const std::uint32_t index_;
  const ColliderState<MeshScalar>& mesh_;
  const bool is_ignored_;
  const PlacedShape& placed_;
  const ShapeFilter<double> filter_;
  PlacedGroup& group_;
  Keep& keep_;
  RecentTriangles recent_;
};

/// The search of one shape in a scene. It is the visitor of the walk through the tree.
template <typename Shape, typename Keep>
class SceneShapeSearch {
  using Scalar = ScalarOf<Shape>;

 public:
  SceneShapeSearch(const SceneShapeQuery<Scalar>& query, const Shape& shape)
      : keep(last_t(query.options)),
        narrowphase(shape, query.options, query.statistics),
        query_(query),
        shape_(shape) {}

  void run() {
    ++query_.statistics.paths;
    if (query_.tree.is_empty() || !is_valid(shape_) || !(query_.options.max_t >= 0)) return;
    const SweptExtents swept = swept_extents(shape_);
    SweptTreeWalk(query_.tree, swept, *this).walk();
  }

  void visit(std::uint32_t index) {
    if (!query_.takes_part(index) || keep.passes_over_from(std::tuple(index, std::uint32_t{0}))) return;
    ++query_.statistics.instances;
    const InstanceMesh<Scalar>& mesh = query_.instances[index].mesh;
    if constexpr (std::is_same_v<Scalar, double>) {
      if (mesh.floats != nullptr) {
        search_mesh(index, *mesh.floats);
        return;
      }
    }
    search_mesh(index, *mesh.own);
  }
  [[nodiscard]] double limit() const { return keep.limit; }
  [[nodiscard]] bool is_done() const { return keep.is_done; }

  Keep keep;
  const PlacedNarrowphase<Shape> narrowphase;

 private:
  template <typename MeshScalar>
  void search_mesh(std::uint32_t index, const ColliderState<MeshScalar>& mesh) {
    const PlacedInstance<Scalar>& placed = query_.instances[index].placed;
    const PlacedShape shape(shape_, placed.placement, placed.frame, query_.share);
    if (!group_) group_.emplace();
    PlacedShapeVisitor<Shape, MeshScalar, Keep> visitor(query_, narrowphase, index, mesh, shape, shape_, *group_, keep);
    const SweptWalk way = {mesh.grid, shape.in_mesh(), mesh.mesh.slabs(), keep.limit, visitor, query_.statistics.cells};
    if (!shape.is_usable() || !way.walk()) visitor.visit_all();
  }

  const SceneShapeQuery<Scalar>& query_;
  const Shape& shape_;
  std::optional<PlacedGroup> group_;  ///< Many shapes come to no instance, and need none.
};

}  // namespace

template <typename Shape>
std::optional<SceneShapeHit<ScalarOf<Shape>>> search_first(const SceneShapeQuery<ScalarOf<Shape>>& query,
                                                           const Shape& shape) noexcept {
  SceneShapeSearch<Shape, KeepFirst<PlacedCandidateOf<Shape>>> search(query, shape);
  search.run();
  const auto& first = search.keep.first;
  if (!first) return std::nullopt;
  return hit_of(query, search.narrowphase, *first);
}

template <typename Shape>
bool search_any(const SceneShapeQuery<ScalarOf<Shape>>& query, const Shape& shape) noexcept {
  SceneShapeSearch<Shape, KeepAny<PlacedCandidateOf<Shape>>> search(query, shape);
  search.run();
  return search.is_done();
}

template <typename Shape>
void search_all(const SceneShapeQuery<ScalarOf<Shape>>& query, const Shape& shape,
                std::vector<SceneShapeHit<ScalarOf<Shape>>>& hits) {
  SceneShapeSearch<Shape, KeepAll<PlacedCandidateOf<Shape>>> search(query, shape);
  search.run();
  search.narrowphase.sort(search.keep.all);
  for (const PlacedCandidateOf<Shape>& candidate : search.keep.all) {
    const auto hit = hit_of(query, search.narrowphase, candidate);
    if (query.accepts(hit)) hits.push_back(hit);
  }
}

template <typename Shape>
bool touches(const CommittedInstance<ScalarOf<Shape>>& instance, std::uint32_t triangle, const Shape& shape,
             ScalarOf<Shape> max_t) noexcept {
  QueryStatistics statistics;
  SceneShapeQueryOptions<ScalarOf<Shape>> options;
  options.max_t = max_t;
  const PlacedNarrowphase<Shape> narrowphase(shape, options, statistics);
  const Triangle<ScalarOf<Shape>> local =
      instance.mesh.own != nullptr ? instance.mesh.own->mesh.triangle(triangle)
                                   : converted<ScalarOf<Shape>>(instance.mesh.floats->mesh.triangle(triangle));
  PlacedCandidateOf<Shape> candidate{0, triangle, local, &instance.placed.placement, {}};
  return narrowphase.find_contact(candidate.whole_triangle(), 1, candidate.contact);
}

#define SUREHIT_INSTANTIATE(Shape)                                                                             \
  template std::optional<SceneShapeHit<ScalarOf<Shape>>> search_first(const SceneShapeQuery<ScalarOf<Shape>>&, \
                                                                      const Shape&) noexcept;                  \
  template bool search_any(const SceneShapeQuery<ScalarOf<Shape>>&, const Shape&) noexcept;                    \
  template void search_all(const SceneShapeQuery<ScalarOf<Shape>>&, const Shape&,                              \
                           std::vector<SceneShapeHit<ScalarOf<Shape>>>&);                                      \
  template bool touches(const CommittedInstance<ScalarOf<Shape>>&, std::uint32_t, const Shape&,                \
                        ScalarOf<Shape>) noexcept;
SUREHIT_INSTANTIATE(SweptSphere<float>)
SUREHIT_INSTANTIATE(SweptSphere<double>)
SUREHIT_INSTANTIATE(SweptBox<float>)
SUREHIT_INSTANTIATE(SweptBox<double>)
SUREHIT_INSTANTIATE(SweptCapsule<float>)
SUREHIT_INSTANTIATE(SweptCapsule<double>)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit::detail
