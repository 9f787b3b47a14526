// Searches a scene for the hits of single paths. Highway compiles this file for each instruction set.

#if defined(SUREHIT_SCENE_SEARCH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_SCENE_SEARCH_INL
#undef SUREHIT_SCENE_SEARCH_INL
#else
#define SUREHIT_SCENE_SEARCH_INL
#endif

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "query/query_walk-inl.hpp"
#include "scene/scene_narrowphase.hpp"
#include "scene/scene_state.hpp"
#include "scene/tree_walk-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// Keeps the first hit of a path in a scene.
template <typename Scalar>
class KeepFirst {
 public:
  static constexpr bool shortens = true;
  KeepFirst(const SceneQuery<Scalar>& query, const SceneNarrowphase<Scalar>& narrowphase)
      : query_(query), narrowphase_(narrowphase) {}

  /// Returns true if this triangle need not be decided, because it is the best one already.
  [[nodiscard]] bool has(std::uint32_t instance, std::uint32_t id) const {
    return is_found_ && best_.instance == instance && best_.id == id;
  }
  /// Takes a candidate that the path meets. Returns true if it is the first one now.
  bool take(const PlacedCandidate<Scalar>& candidate) {
    if (is_found_ && !narrowphase_.comes_before(candidate, best_)) return false;
    if (query_.filter != nullptr && !query_.accepts(hit_of(candidate))) return false;
    best_ = candidate;
    is_found_ = true;
    return true;
  }
  /// Returns the t at which the search may end.
  [[nodiscard]] double limit() const {
    return is_found_ ? best_.bounded.contact.t_upper : std::numeric_limits<double>::infinity();
  }
  [[nodiscard]] bool is_done() const { return false; }
  [[nodiscard]] std::optional<SceneHit<Scalar>> hit() const {
    return is_found_ ? std::optional(hit_of(best_)) : std::nullopt;
  }

 private:
  [[nodiscard]] SceneHit<Scalar> hit_of(const PlacedCandidate<Scalar>& candidate) const {
    return narrowphase_.hit(candidate, query_.instances[candidate.instance].generation);
  }

  const SceneQuery<Scalar>& query_;
  const SceneNarrowphase<Scalar>& narrowphase_;
  bool is_found_ = false;
  PlacedCandidate<Scalar> best_;  ///< The best hit. It is not set before there is one.
};

/// Notes whether a path has a hit in a scene.
template <typename Scalar>
class KeepAny {
 public:
  static constexpr bool shortens = false;
  KeepAny(const SceneQuery<Scalar>& query, const SceneNarrowphase<Scalar>& narrowphase)
      : query_(query), narrowphase_(narrowphase) {}

  [[nodiscard]] bool has(std::uint32_t, std::uint32_t) const { return false; }
  bool take(const PlacedCandidate<Scalar>& candidate) {
    const std::uint32_t generation = query_.instances[candidate.instance].generation;
    is_done_ = query_.filter == nullptr || query_.accepts(narrowphase_.hit(candidate, generation));
    return is_done_;
  }
  [[nodiscard]] double limit() const { return std::numeric_limits<double>::infinity(); }
  [[nodiscard]] bool is_done() const { return is_done_; }

 private:
  const SceneQuery<Scalar>& query_;
  const SceneNarrowphase<Scalar>& narrowphase_;
  bool is_done_ = false;
};

/// Keeps all hits of a path in a scene.
template <typename Scalar>
class KeepAll {
 public:
  static constexpr bool shortens = false;

  [[nodiscard]] bool has(std::uint32_t, std::uint32_t) const { return false; }
  bool take(const PlacedCandidate<Scalar>& candidate) {
    found_.push_back(candidate);
    return false;
  }
  [[nodiscard]] double limit() const { return std::numeric_limits<double>::infinity(); }
  [[nodiscard]] bool is_done() const { return false; }

  /// Appends the hits that the filter accepts, in order.
  void append_to(std::vector<SceneHit<Scalar>>& hits, const SceneQuery<Scalar>& query,
                 const SceneNarrowphase<Scalar>& narrowphase) {
    narrowphase.sort(found_);
    for (const PlacedCandidate<Scalar>& candidate : found_) {
      const SceneHit<Scalar> hit = narrowphase.hit(candidate, query.instances[candidate.instance].generation);
      if (query.accepts(hit)) hits.push_back(hit);
    }
  }

 private:
  std::vector<PlacedCandidate<Scalar>> found_;  ///< A triangle may be there more than once.
};

/// Visits the triangles of one instance. `Keep` is one of the three above.
template <typename Scalar, typename MeshScalar, typename Keep>
class InstanceVisitor {
 public:
  using Kernel = BlockKernel<MeshScalar>;
  using AnyPath = PlacedPath<Scalar>;
  static constexpr bool wants_order = false;
  static constexpr bool shortens = Keep::shortens;
  /// The candidates are decided by the narrowphase of the scene, for this path.
  struct Narrowphase {
    Narrowphase(const PlacedPath<Scalar>& placed, const QueryOptions<MeshScalar>&, const PathRange<MeshScalar>&,
                QueryStatistics&)
        : path(placed) {}
    const PlacedPath<Scalar>& path;
  };

  InstanceVisitor(const SceneNarrowphase<Scalar>& narrowphase, std::uint32_t index,
                  const PlacedInstance<Scalar>& placed, Keep& keep)
      : narrowphase_(narrowphase), index_(index), placed_(placed), keep_(keep) {}

  template <typename Path>
  HWY_INLINE std::uint64_t take_certain(const CandidateBlock<MeshScalar, Path>& block, bool& /*is_nearer*/) {
    return block.verdicts.possible;
  }
  HWY_NOINLINE bool take(const Query<MeshScalar>& query, const Narrowphase& narrowphase,
                         const Candidate<MeshScalar>& candidate, Closeness) {
    if (!query.takes_part(candidate.id) || keep_.has(index_, candidate.id)) return false;
    const auto& [a, b, c] = candidate.triangle;
    PlacedCandidate<Scalar> found{index_,
                                  candidate.id,
                                  {a.template cast<Scalar>(), b.template cast<Scalar>(), c.template cast<Scalar>()},
                                  &placed_,
                                  {}};
    return narrowphase_.find_contact(narrowphase.path, found) && keep_.take(found);
  }
  [[nodiscard]] double limit() const { return keep_.limit(); }
  [[nodiscard]] bool is_done() const { return keep_.is_done(); }

 private:
  const SceneNarrowphase<Scalar>& narrowphase_;
  const std::uint32_t index_;
  const PlacedInstance<Scalar>& placed_;
  Keep& keep_;
};

/// Gives the visitor the triangles of an instance that the path may meet.
template <typename Scalar, typename MeshScalar, typename Visitor>
HWY_NOINLINE void walk_mesh(const Query<MeshScalar>& query, const PlacedPath<Scalar>& path, Visitor& visitor) {
  constexpr MeshScalar infinity = std::numeric_limits<MeshScalar>::infinity();
  const PathRange<MeshScalar> range(-infinity, infinity);  // The second stage knows the range.
  const Grid& grid = query.grid;
  if (path.status == PlacedPath<Scalar>::Status::rough) {
    visit_all(query, path, range, visitor);
    return;
  }
  if (grid.is_one_list()) {
    ++query.statistics.cells;
    const KernelInput<MeshScalar> input(path, range, grid.frame());
    visit_list(query, range, path, input, list_of(query, grid.top()[0]), visitor);
    return;
  }
  ClippedPath clipped = clipped_to(grid.frame(), path, range);
  if (clipped.status == ClippedPath::Status::miss) return;
  if (clipped.status == ClippedPath::Status::too_far) {
    visit_all(query, path, range, visitor);
    return;
  }
  if constexpr (Visitor::shortens) clipped.end = std::min(clipped.end, clipped.beyond(visitor.limit()));
  if (clipped.stays_in_empty_space(grid, grid.frame())) {
    ++query.statistics.cells;
    return;
  }
  float enters = 0;
  if constexpr (std::is_same_v<MeshScalar, float>) {
    constexpr float few_cells = 4;
    if (const GridCover& cover = grid.cover(); cover.is_useful() && is_long(few_cells, grid, clipped, 0)) {
      const GridCover::Part part = cover.part_of(clipped.start, clipped.inverse_rate, clipped.octant, clipped.end);
      if (part.enters > part.leaves) return;
      enters = part.enters;
      clipped.end = part.leaves;
    }
  }
  OnDemand<MeshScalar> when(path, range, grid.frame());
  walk_frame(grid.frame(), enters, query, path, range, clipped, when, visitor);
}

/// Searches one instance.
template <typename MeshScalar, typename Scalar, typename Keep>
HWY_INLINE void search_mesh(const SceneQuery<Scalar>& query, const ColliderState<MeshScalar>& mesh,
                            const PlacedPath<Scalar>& path, std::uint32_t index,
                            const SceneNarrowphase<Scalar>& narrowphase, Keep& keep) {
  QueryOptions<MeshScalar> options;
  options.mask = query.options.mask;
  if (query.is_ignored(index)) options.ignored_triangle = query.options.ignored_triangle;
  const Query<MeshScalar> of_mesh{mesh.grid, mesh.mesh, mesh.masks, options, nullptr, query.statistics, 0};
  InstanceVisitor<Scalar, MeshScalar, Keep> visitor(narrowphase, index, query.instances[index].placed, keep);
  walk_mesh(of_mesh, path, visitor);
}

/// The search of one path in a scene.
template <typename Scalar>
class SceneSearch {
 public:
  SceneSearch(const SceneQuery<Scalar>& query, const Path<Scalar>& path)
      : query_(query), range_(path.kind, query.options), path_(path, range_, query.share) {}
  SceneSearch(const SceneSearch&) = delete;
  SceneSearch& operator=(const SceneSearch&) = delete;

  /// Returns what decides the path's candidates.
  [[nodiscard]] const SceneNarrowphase<Scalar>& narrowphase() const { return narrowphase_; }

  /// Gives `keep` the hits of the path, from one instance to the next.
  template <typename Keep>
  HWY_INLINE void run(Keep& keep) const {
    ++query_.statistics.paths;
    if (range_.is_empty() || query_.tree.is_empty() || !is_finite(path_.path)) return;
    const auto prefetch = [&](std::uint32_t index) { hwy::Prefetch(&query_.instances[index]); };
    walk_tree(query_.tree, path_, keep, prefetch, [&](std::uint32_t index) { search_instance(index, keep); });
  }

 private:
  template <typename Keep>
  HWY_INLINE void search_instance(std::uint32_t index, Keep& keep) const {
    if (!query_.takes_part(index)) return;
    const CommittedInstance<Scalar>& instance = query_.instances[index];
    const PlacedPath<Scalar> placed(path_, instance.placed.placement, instance.placed.frame);
    if (placed.status == PlacedPath<Scalar>::Status::beside) return;
    ++query_.statistics.instances;
    if constexpr (std::is_same_v<Scalar, double>) {
      if (instance.mesh.floats != nullptr) {
        search_mesh(query_, *instance.mesh.floats, placed, index, narrowphase_, keep);
        return;
      }
    }
    search_mesh(query_, *instance.mesh.own, placed, index, narrowphase_, keep);
  }

  const SceneQuery<Scalar>& query_;
  const PathRange<Scalar> range_;
  const ScenePath<Scalar> path_;
  const SceneNarrowphase<Scalar> narrowphase_{path_, query_.options, query_.statistics};
};

/// Returns the first hit of a path.
template <typename Scalar>
std::optional<SceneHit<Scalar>> search_scene_first(const SceneQuery<Scalar>& query, const Path<Scalar>& path) noexcept {
  const SceneSearch<Scalar> search(query, path);
  KeepFirst<Scalar> first(query, search.narrowphase());
  search.run(first);
  return first.hit();
}

/// Returns true if the path has a hit.
template <typename Scalar>
bool search_scene_any(const SceneQuery<Scalar>& query, const Path<Scalar>& path) noexcept {
  const SceneSearch<Scalar> search(query, path);
  KeepAny<Scalar> any(query, search.narrowphase());
  search.run(any);
  return any.is_done();
}

/// Appends all hits of a path in order.
template <typename Scalar>
void search_scene_all(const SceneQuery<Scalar>& query, const Path<Scalar>& path, std::vector<SceneHit<Scalar>>& hits) {
  const SceneSearch<Scalar> search(query, path);
  KeepAll<Scalar> all;
  search.run(all);
  all.append_to(hits, query, search.narrowphase());
}

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
