// Searches a scene for the hits of single paths. Highway compiles this file for each instruction set.

#if defined(SUREHIT_SCENE_SEARCH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_SCENE_SEARCH_INL
#undef SUREHIT_SCENE_SEARCH_INL
#else
#define SUREHIT_SCENE_SEARCH_INL
#endif

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "query/query_walk-inl.hpp"
#include "scene/placed_rounding-inl.hpp"
#include "scene/scene_narrowphase.hpp"
#include "scene/scene_query.hpp"
#include "scene/tree_walk-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// The t of a hit, which the kernel has found in the mesh of an instance.
struct HitInterval {
  double lower;  ///< The exact t is at least this.
  double upper;  ///< The exact t is at most this.

  /// Takes an interval of the kernel's t. A product with a power of two and a sum are rounded.
  template <typename Scalar>
  HitInterval(const PlacedPath<Scalar>& path, double kernel_lower, double kernel_upper) {
    const double scale = path.kernel_scale();
    const auto moved = [&](double t, double sign) {
      const double sum = path.moved.moved_t + t * scale;
      return sum + sign * (std::fabs(sum) * 0x1p-51 + std::numeric_limits<double>::min());
    };
    lower = moved(kernel_lower, -1);
    upper = moved(kernel_upper, 1);
  }
};

/// Sets a hit from a lane of rounded ones. Returns false if its numbers are not right.
template <typename Rounded>
HWY_INLINE bool set_rounded(const Rounded& rounded, std::size_t lane, const PlacedCandidate<float>& of,
                            std::uint32_t generation, SceneHit<float>& hit) {
  hit.t = rounded.t[lane];
  hit.u = rounded.u[lane];
  hit.v = rounded.v[lane];
  hit.triangle = of.id;
  const bool is_positive = (rounded.positive >> lane & 1) != 0;
  hit.side = is_positive != of.placed->frame.is_mirrored ? Side::front : Side::back;
  hit.instance = {of.instance, generation};
  return (rounded.rounded >> lane & 1) != 0;
}

/// Keeps the first hit of a path in a scene. If the kernel is certain of a hit and of its order, the narrowphase
/// decides it when the path ends. The narrowphase decides all others at once.
template <typename Scalar>
class KeepFirst {
 public:
  static constexpr bool shortens = true;
  static constexpr bool wants_order = true;
  KeepFirst(const SceneQuery<Scalar>& query, const SceneNarrowphase<Scalar>& narrowphase)
      : query_(query), narrowphase_(narrowphase) {}

  /// Takes a hit that the kernel is certain of, if it certainly comes before the best one. Returns whether it does.
  template <typename MeshScalar>
  HWY_INLINE bool take_certain(const CandidateBlock<MeshScalar, PlacedPath<Scalar>>& block, std::size_t lane,
                               std::uint32_t instance, const HitInterval& t) {
    if (!(t.upper < t_lower_)) return false;
    state_ = State::certain;
    t_lower_ = t.lower;
    t_upper_ = t.upper;
    grid_ = &block.query.grid;
    entry_ = block.entry(lane);
    path_ = block.path.certain();
    const auto& [a, b, c] = block.triangle(lane);
    best_.instance = instance;
    best_.local = {a.template cast<Scalar>(), b.template cast<Scalar>(), c.template cast<Scalar>()};
    best_.placed = &query_.instances[instance].placed;
    return true;
  }
  /// Returns true if this triangle need not be decided, because it is the best one already.
  [[nodiscard]] bool has(std::uint32_t instance, std::uint32_t id) const {
    return is_found() && best_.instance == instance && best_id() == id;
  }
  /// Takes a candidate that the path meets. Returns true if it is the first one now.
  bool take(const PlacedCandidate<Scalar>& candidate) {
    if (is_found() && !narrowphase_.comes_before(candidate, decided())) return false;
    if (query_.filter != nullptr && !query_.accepts(hit_of(candidate))) return false;
    best_ = candidate;
    state_ = State::decided;
    t_lower_ = best_.bounded.contact.t_lower;
    t_upper_ = best_.bounded.contact.t_upper;
    return true;
  }
  /// Returns the t at which the search may end.
  [[nodiscard]] double limit() const { return t_upper_; }
  [[nodiscard]] bool is_done() const { return false; }
  [[nodiscard]] bool is_found() const { return state_ != State::none; }
  /// Returns true if only the kernel has decided the best hit.
  [[nodiscard]] bool is_certain() const { return state_ == State::certain; }
  /// Returns the path of a certain hit.
  [[nodiscard]] const CertainPath& path() const { return path_; }
  /// Returns the best hit. Its contact is only set if it is not certain.
  [[nodiscard]] const PlacedCandidate<Scalar>& best() {
    best_.id = best_id();
    return best_;
  }
  [[nodiscard]] std::optional<SceneHit<Scalar>> hit() {
    if (!is_found()) return std::nullopt;
    if constexpr (std::is_same_v<Scalar, float>) {
      SceneHit<Scalar> hit;
      if (is_certain() && try_round_certain(hit)) return hit;
    }
    return hit_of(decided());
  }

 private:
  enum class State : std::uint8_t {
    none,     ///< There is no hit yet.
    certain,  ///< The kernel is certain of the best hit.
    decided,  ///< The narrowphase has decided the best hit.
  };

  [[nodiscard]] std::uint32_t best_id() const { return state_ == State::certain ? grid_->entries()[entry_] : best_.id; }
  [[nodiscard]] SceneHit<Scalar> hit_of(const PlacedCandidate<Scalar>& candidate) const {
    return narrowphase_.hit(candidate, query_.instances[candidate.instance].generation);
  }
  /// Rounds a certain hit with the path as it was placed. Returns false if its errors are too large for that.
  bool try_round_certain(SceneHit<Scalar>& hit) {
    PlacedHits<hn::CappedTag<double, 1>> one;
    one.set(0, path_, best_.local);
    return set_rounded(one.round(), 0, best(), query_.instances[best_.instance].generation, hit);
  }
  /// Returns the best hit. If only the kernel has decided it, the narrowphase decides it first.
  const PlacedCandidate<Scalar>& decided() {
    if (state_ == State::certain) {
      best_.id = best_id();
      const bool is_hit = narrowphase_.find_certain(best_);
      assert(is_hit);
      (void)is_hit;
      state_ = State::decided;
    }
    return best_;
  }

  const SceneQuery<Scalar>& query_;
  const SceneNarrowphase<Scalar>& narrowphase_;
  State state_ = State::none;                                 ///< Who has decided the best hit.
  const Grid* grid_ = nullptr;                                ///< The grid of a certain hit.
  std::size_t entry_ = 0;                                     ///< The index of a certain hit among its entries.
  double t_lower_ = std::numeric_limits<double>::infinity();  ///< The exact t of the best hit is at least this.
  double t_upper_ = std::numeric_limits<double>::infinity();  ///< The exact t of the best hit is at most this.
  CertainPath path_;                                          ///< The path of a certain hit.
  PlacedCandidate<Scalar> best_;  ///< The best hit. It is not set before there is one. A certain hit has no id yet.
};

/// Notes whether a path has a hit in a scene.
template <typename Scalar>
class KeepAny {
 public:
  static constexpr bool shortens = false;
  static constexpr bool wants_order = false;
  KeepAny(const SceneQuery<Scalar>& query, const SceneNarrowphase<Scalar>& narrowphase)
      : query_(query), narrowphase_(narrowphase) {}

  /// Notes that the kernel is certain of a hit that counts.
  void take_certain() { is_done_ = true; }
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
  static constexpr bool wants_order = false;

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
  static constexpr bool wants_order = Keep::wants_order;
  static constexpr bool shortens = Keep::shortens;
  /// The candidates are decided by the narrowphase of the scene, for this path.
  struct Narrowphase {
    Narrowphase(const PlacedPath<Scalar>& placed, const QueryOptions<MeshScalar>&, const PathRange<MeshScalar>&,
                QueryStatistics&)
        : path(placed.refined()) {}
    const PlacedPath<Scalar> path;
  };

  /// If `trusts_kernel`, every hit of which the kernel is certain counts.
  InstanceVisitor(const SceneNarrowphase<Scalar>& narrowphase, std::uint32_t index,
                  const PlacedInstance<Scalar>& placed, bool trusts_kernel, Keep& keep)
      : narrowphase_(narrowphase), index_(index), placed_(placed), trusts_kernel_(trusts_kernel), keep_(keep) {}

  /// Takes what the kernel is certain of. Returns the lanes that are still to be decided.
  HWY_INLINE std::uint64_t take_certain(const CandidateBlock<MeshScalar, PlacedPath<Scalar>>& block, bool& is_nearer) {
    const auto& [possible, certain] = block.verdicts;
    if constexpr (Keep::wants_order) {
      if (!trusts_kernel_ || certain == 0) return possible;
      const FirstLanes<MeshScalar>& first = block.first;
      const HitInterval t(block.path, first.t_lower, first.t_upper);
      const std::uint64_t undecided = possible & ~certain;
      const bool is_alone = std::has_single_bit(first.lanes);
      const auto lane = static_cast<std::size_t>(std::countr_zero(first.lanes));
      is_nearer = is_alone && keep_.take_certain(block, lane, index_, t);
      if (is_nearer || t.lower > keep_.limit()) return undecided;
      // Most triangles come again in the next cell.
      const bool is_best = is_alone && keep_.has(index_, block.query.grid.entries()[block.entry(lane)]);
      return is_best ? undecided : undecided | first.lanes;
    } else if constexpr (requires { keep_.take_certain(); }) {
      if (!trusts_kernel_ || certain == 0) return possible;
      keep_.take_certain();
      return 0;
    } else {
      return possible;
    }
  }
  /// Takes nothing: the narrowphase decides which of several hits at one t comes first.
  bool take_tie(const CandidateBlock<MeshScalar, PlacedPath<Scalar>>&, std::uint64_t, bool&) { return false; }
  /// Returns infinity. The kernel counts its t in another way.
  [[nodiscard]] MeshScalar t_upper() const { return std::numeric_limits<MeshScalar>::infinity(); }
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
  const bool trusts_kernel_;
  Keep& keep_;
};

/// Cuts a long path to the grid's cover, if this is useful. Sets the tau at which it enters the cover. Returns false if
/// it misses the cover.
HWY_INLINE bool enter_cover(const Grid& grid, ClippedPath& clipped, float& enters) {
  constexpr float few_cells = 4;
  const GridCover& cover = grid.cover();
  if (!cover.is_useful() || !is_long(few_cells, grid, clipped, 0)) return true;
  const GridCover::Part part = cover.part_of(clipped.start, clipped.inverse_rate, clipped.octant, clipped.end);
  enters = part.enters;
  clipped.end = part.leaves;
  return part.enters <= part.leaves;
}

/// Gives the visitor the triangles of an instance that the path may meet.
template <typename Scalar, typename MeshScalar, typename Visitor>
HWY_NOINLINE void walk_mesh(const Query<MeshScalar>& query, const PlacedPath<Scalar>& path, Visitor& visitor) {
  constexpr MeshScalar infinity = std::numeric_limits<MeshScalar>::infinity();
  const PathRange<MeshScalar> range(-infinity, infinity);  // The placed path has the range that counts.
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
    if (!enter_cover(grid, clipped, enters)) return;
  }
  OnDemand<MeshScalar> when(path, range, grid.frame());
  walk_frame(grid.frame(), enters, query, path, range, clipped, when, visitor);
}

/// The search of one path in the mesh of one instance.
template <typename MeshScalar, typename Scalar, typename Keep>
struct MeshSearch {
  HWY_INLINE MeshSearch(const SceneQuery<Scalar>& of_scene, const ColliderState<MeshScalar>& mesh, std::uint32_t index,
                        const SceneNarrowphase<Scalar>& narrowphase, Keep& keep)
      : options(options_of(of_scene, index)),
        query{mesh.grid, mesh.mesh, mesh.masks, options, nullptr, of_scene.statistics, 0},
        visitor(narrowphase, index, of_scene.instances[index].placed, trusts_kernel(of_scene, query), keep) {}
  MeshSearch(const MeshSearch&) = delete;
  MeshSearch& operator=(const MeshSearch&) = delete;

  const QueryOptions<MeshScalar> options;
  const Query<MeshScalar> query;  ///< It has the options above.
  InstanceVisitor<Scalar, MeshScalar, Keep> visitor;

 private:
  static QueryOptions<MeshScalar> options_of(const SceneQuery<Scalar>& of_scene, std::uint32_t index) {
    QueryOptions<MeshScalar> options;
    options.mask = of_scene.options.mask;
    if (of_scene.is_ignored(index)) options.ignored_triangle = of_scene.options.ignored_triangle;
    return options;
  }
  static bool trusts_kernel(const SceneQuery<Scalar>& of_scene, const Query<MeshScalar>& query) {
    return of_scene.filter == nullptr && of_scene.options.culling == Culling::none && counts_every_hit(query);
  }
};

/// Searches one instance.
template <typename MeshScalar, typename Scalar, typename Keep>
HWY_INLINE void search_mesh(const SceneQuery<Scalar>& query, const ColliderState<MeshScalar>& mesh,
                            const PlacedPath<Scalar>& path, std::uint32_t index,
                            const SceneNarrowphase<Scalar>& narrowphase, Keep& keep) {
  MeshSearch<MeshScalar, Scalar, Keep> search(query, mesh, index, narrowphase, keep);
  walk_mesh(search.query, path, search.visitor);
}

/// The search of one path in a scene.
template <typename Scalar>
class SceneSearch {
 public:
  SceneSearch(const SceneQuery<Scalar>& query, const Path<Scalar>& path)
      : query_(query), range_(path.kind, query.options), path_(path, range_, query.share) {}
  SceneSearch(const SceneSearch&) = delete;
  SceneSearch& operator=(const SceneSearch&) = delete;

  [[nodiscard]] const ScenePath<Scalar>& path() const { return path_; }
  /// Returns what decides the path's candidates.
  [[nodiscard]] const SceneNarrowphase<Scalar>& narrowphase() const { return narrowphase_; }
  /// Returns true if the path can have no hit.
  [[nodiscard]] bool is_in_vain() const {
    return range_.is_empty() || query_.tree.is_empty() || !is_finite(path_.path);
  }

  /// Gives `keep` the hits of the path, from one instance to the next.
  template <typename Keep>
  HWY_INLINE void run(Keep& keep) const {
    ++query_.statistics.paths;
    if (is_in_vain()) return;
    TreeWalk<max_open_children> walk(query_.tree, path_);
    for (;;) {
      const std::uint32_t child = walk.next();
      if (child == InstanceTree::no_child) return;
      if ((child & InstanceTree::instance_bit) == 0) {
        walk.template visit<Keep::shortens>(query_.tree.nodes()[child]);
        continue;
      }
      const std::uint32_t index = child & ~InstanceTree::instance_bit;
      if (!query_.takes_part(index)) continue;
      search_instance(
          PlacedPath<Scalar>(path_, query_.instances[index].placed.placement, query_.instances[index].placed.frame),
          index, keep);
      if (keep.is_done()) return;
      if constexpr (Keep::shortens) walk.shorten(keep.limit());
    }
  }

  /// Gives `keep` the hits of the path in one instance. `placed` is the path as the instance sees it.
  template <typename Keep>
  HWY_INLINE void search_instance(const PlacedPath<Scalar>& placed, std::uint32_t index, Keep& keep) const {
    if (placed.status == PlacedPath<Scalar>::Status::beside) return;
    ++query_.statistics.instances;
    const InstanceMesh<Scalar>& mesh = query_.instances[index].mesh;
    if constexpr (std::is_same_v<Scalar, double>) {
      if (mesh.floats != nullptr) {
        search_mesh(query_, *mesh.floats, placed, index, narrowphase_, keep);
        return;
      }
    }
    search_mesh(query_, *mesh.own, placed, index, narrowphase_, keep);
  }

 private:
  const SceneQuery<Scalar>& query_;
  const PathRange<Scalar> range_;
  const ScenePath<Scalar> path_;
  const SceneNarrowphase<Scalar> narrowphase_{path_, query_.options, query_.statistics};
};

/// Lets the narrowphase decide and round a hit of which the kernel is certain.
template <typename Scalar>
HWY_NOINLINE void round_alone(const SceneQuery<Scalar>& query, const Path<Scalar>& path, PlacedCandidate<Scalar>& best,
                              SceneHit<Scalar>& hit) {
  const SceneSearch<Scalar> search(query, path);
  [[maybe_unused]] const bool is_hit = search.narrowphase().find_certain(best);
  assert(is_hit);
  hit = search.narrowphase().hit(best, query.instances[best.instance].generation);
}

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
