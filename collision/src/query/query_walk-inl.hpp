// Walks single paths. Highway compiles this file for each instruction set.

#if defined(SUREHIT_QUERY_WALK_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_QUERY_WALK_INL
#undef SUREHIT_QUERY_WALK_INL
#else
#define SUREHIT_QUERY_WALK_INL
#endif

#include <algorithm>
#include <bit>
#include <cstddef>
#include <optional>
#include <type_traits>
#include <vector>

#include "filter/block_kernel-inl.hpp"
#include "filter/double_hit_rounding-inl.hpp"
#include "filter/hit_rounding-inl.hpp"
#include "filter/kernel_path.hpp"
#include "query/clipped_to-inl.hpp"
#include "query/hit_visitors-inl.hpp"
#include "query/octet_boxes-inl.hpp"
#if HWY_TARGET != HWY_SCALAR  // This target has no lanes.
#include "walk/lane_walk-inl.hpp"
#endif
#include "grid/list_cells.hpp"
#include "misses_box.hpp"
#include "narrowphase.hpp"
#include "query/far_path.hpp"
#include "query/query.hpp"
#include "scene/placed_path.hpp"
#include "walk/far_clip.hpp"
#include "walk/grid_traversal.hpp"
#include "walk/main_grid_path.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// Returns the list of a cell. The cell must have one.
template <typename Scalar>
HWY_INLINE TriangleList<Scalar> list_of(const Query<Scalar>& query, CellWord word) {
  const std::size_t first = query.grid.first_entry(word);
  const Scalar* block = query.mesh.block(word.list(), first);
  const std::size_t count = query.grid.entry_count(word);
  return {MeshBlocks<Scalar>::corners(block), count, first, MeshBlocks<Scalar>::edge_size(block),
          boxes_of(query.mesh, first, count)};
}

/// The path and its range, as the kernel needs them.
template <typename Scalar>
struct KernelInput {
  KernelInput(const Path<Scalar>& any_path, const PathRange<Scalar>& range, const GridFrame& frame)
      : path(any_path, frame), weights(range) {}
  KernelInput(const KernelPath<Scalar>& any_path, const PathRange<Scalar>& range) : path(any_path), weights(range) {}
  /// A placed path has the same form in all frames of a mesh, and a range of its own.
  template <typename SceneScalar>
  KernelInput(const PlacedPath<SceneScalar>& any_path, const PathRange<Scalar>&, const GridFrame&)
      : path(any_path.template kernel_path<Scalar>()), weights(any_path.template kernel_weights<Scalar>()) {}
  KernelInput(const FarPath& any_path, const PathRange<Scalar>&, const GridFrame& frame)
      : path(any_path.kernel_path(frame)), weights(any_path.kernel_range()) {}
  KernelPath<Scalar> path;       ///< The path.
  RangeWeights<Scalar> weights;  ///< The weights of its range.
};

/// Gives the hits that may be first the parameter of the path. Most paths have the kernel's own.
template <typename Scalar, typename AnyPath>
HWY_INLINE void set_parameter(const AnyPath&, FirstLanes<Scalar>&) {}
/// A path whose start was moved has its own parameter.
HWY_INLINE void set_parameter(const FarPath& path, FirstLanes<float>& first) { path.set_parameter(first); }

/// Returns the reach (P1) of the path from its own start, which may be farther away than that of the kernel.
template <typename Scalar, typename AnyPath>
HWY_INLINE Scalar reach_from_start(const AnyPath&, const KernelPath<Scalar>& kernel_path) {
  return kernel_path.reach;
}
/// A path whose start was moved adds the way to it.
HWY_INLINE float reach_from_start(const FarPath& far_path, const KernelPath<float>& kernel_path) {
  return far_path.reach_from_start(kernel_path);
}

/// Returns the last t of the range that a hit may have and still count.
template <typename Scalar, typename Visitor>
HWY_INLINE Scalar last_that_counts(const PathRange<Scalar>& range, const Visitor& visitor) {
  if constexpr (Visitor::shortens) return std::min(range.last, visitor.t_upper());
  return range.last;
}

/// Gives the visitor the triangles of a list that the path may meet. Returns true if the path is shorter now, or if the
/// visitor is done. Here and below, `AnyPath` is a `Path`, a `FarPath` or a `PlacedPath`.
template <typename Scalar, typename AnyPath, typename Visitor>
HWY_INLINE bool visit_list(const Query<Scalar>& query, const PathRange<Scalar>& range, const AnyPath& path,
                           const KernelInput<Scalar>& input, const TriangleList<Scalar>& list, Visitor& visitor) {
  using Kernel = typename Visitor::Kernel;
  const std::size_t lanes = hn::Lanes(hn::ScalableTag<Scalar>());
  query.statistics.candidates += list.count;
  bool shorter = false;
  const auto bounds = Kernel::bounds(input.path, input.weights, list);
  [[maybe_unused]] std::uint64_t octets = ~std::uint64_t{0};
  for (std::size_t from = 0; from < list.count; from += lanes) {
    // A path that was moved or placed is not exactly the kernel's.
    if constexpr (std::is_same_v<AnyPath, Path<float>> && requires { Visitor::passes_over_octets; }) {
      constexpr std::size_t octet = MeshBlocks<float>::octet;
      const std::size_t place = from % (octet * max_octets);
      if (place == 0 && list.boxes != nullptr) {
        octets = octets_met(input.path, list, from, range.first, last_that_counts(range, visitor));
      }
      if ((octets >> place / octet & octets_of_lanes(lanes)) == 0) continue;
    }
    FirstLanes<Scalar> first = {};
    Verdicts verdicts;
    if constexpr (Visitor::wants_order) {
      const Scalar limit = kernel_limit(path, visitor.t_upper());
      verdicts = classify<Kernel>(input.path, input.weights, list, bounds, from, limit, first);
      if (verdicts.certain != 0) set_parameter(path, first);
    } else {
      verdicts = classify<Kernel>(input.path, input.weights, list, bounds, from);
    }
    if (verdicts.possible == 0) continue;
    query.statistics.undecided += static_cast<std::uint64_t>(std::popcount(verdicts.possible & ~verdicts.certain));
    const Scalar reach = reach_from_start(path, input.path);
    shorter |= visit(CandidateBlock<Scalar, AnyPath>{query, range, path, list, reach, from, verdicts, first}, visitor);
    if (visitor.is_done()) return true;
  }
  return shorter;
}

/// Makes the input of the kernel at once. A long path of floats does this while it waits for the first cells.
template <typename Scalar>
class AtOnce {
 public:
  template <typename AnyPath>
  AtOnce(const AnyPath& path, const PathRange<Scalar>& range, const GridFrame& frame) : input_(path, range, frame) {}
  /// Returns the input that the constructor made.
  template <typename AnyPath>
  const KernelInput<Scalar>& get(const AnyPath&, const PathRange<Scalar>&, const GridFrame&) const {
    return input_;
  }

 private:
  KernelInput<Scalar> input_;
};

/// Makes the input of the kernel for the first list that the path comes to. Most short paths come to none.
template <typename Scalar>
class OnDemand {
 public:
  template <typename AnyPath>
  OnDemand(const AnyPath&, const PathRange<Scalar>&, const GridFrame&) {}
  /// Makes the input if there is none, and returns it.
  template <typename AnyPath>
  const KernelInput<Scalar>& get(const AnyPath& path, const PathRange<Scalar>& range, const GridFrame& frame) {
    if (!input_) input_.emplace(path, range, frame);
    return *input_;
  }

 private:
  std::optional<KernelInput<Scalar>> input_;
};

/// Returns true if the path is at least `min_cells` top cells long from tau `enters` on. The lengths on all axes are
/// added.
HWY_INLINE bool is_long(float min_cells, const Grid& grid, const ClippedPath& clipped, float enters) {
  const float rate = clipped.rate[0] + clipped.rate[1] + clipped.rate[2];
  const float way = (std::min(clipped.end, clipped.exit) - enters) * rate;
  return way >= min_cells * static_cast<float>(grid.frame().division) && way < 0x1p20F;
}

template <typename Scalar, typename AnyPath, typename Visitor>
void walk_inner(const Query<Scalar>& query, const AnyPath& path, const PathRange<Scalar>& range,
                const KernelInput<Scalar>& input, CellWord word, Visitor& visitor);

/// Gives the visitor the triangles that the path may meet in a cell with a list. Returns true if the path is shorter
/// now, or if the visitor is done.
template <typename Scalar, typename AnyPath, typename Visitor>
HWY_INLINE bool visit_cell(const Query<Scalar>& query, const PathRange<Scalar>& range, const AnyPath& path,
                           const KernelInput<Scalar>& input, CellWord word, Visitor& visitor) {
  const bool shorter = visit_list(query, range, path, input, list_of(query, word), visitor);
  if (!word.has_inner_grid() || visitor.is_done()) return shorter;
  walk_inner(query, path, range, input, word, visitor);
  return true;
}

#if HWY_TARGET != HWY_SCALAR
// The next functions walk one path in many lanes, for a visitor that is done with any hit. All lanes load their cells
// at the same time, so the path waits less. For a first hit, most of what the later lanes find would not be needed.

/// Gives the visitor the triangles that the path may meet in the cells of these lanes, until the visitor is done.
template <typename AnyPath, typename Visitor>
HWY_INLINE void visit_cells(const Query<float>& query, const PathRange<float>& range, const AnyPath& path,
                            const KernelInput<float>& input, const LaneWalk& walk, const LaneWalk::Cells& cells,
                            std::uint32_t walking, const WalkingPaths& lanes, Visitor& visitor) {
  query.statistics.cells += static_cast<std::uint64_t>(std::popcount(walking));
  std::uint32_t arriving = LaneWalk::in_lists(cells, walking);
  if (arriving != 0) arriving = walk.meet_lists(cells, arriving, lanes);
  if (arriving == 0) return;
  alignas(max_lanes * sizeof(float)) std::array<std::uint32_t, max_lanes> words;
  hn::Store(cells.word, BitsTag(), words.data());
  for (; arriving != 0 && !visitor.is_done(); arriving &= arriving - 1) {
    const CellWord word(words[static_cast<std::size_t>(std::countr_zero(arriving))]);
    visit_cell(query, range, path, input, word, visitor);
  }
}

/// Cuts a path into pieces, and walks one piece in each lane. It begins at tau `enters`. The grid must have no levels.
template <typename AnyPath, typename Visitor>
HWY_NOINLINE void walk_in_pieces(float enters, const Query<float>& query, const AnyPath& path,
                                 const PathRange<float>& range, const ClippedPath& clipped, Visitor& visitor) {
  const LaneWalk walk(query.grid, query.mesh.slabs());
  WalkingPaths pieces;
  walk.cut(clipped, enters, pieces);
  const KernelInput<float> input(path, range, query.grid.frame());
  auto walking = static_cast<std::uint32_t>((std::uint64_t{1} << hn::Lanes(BitsTag())) - 1);
  while (walking != 0) {
    const LaneWalk::Cells cells = walk.look_in<false>(pieces, walking);
    visit_cells(query, range, path, input, walk, cells, walking, pieces, visitor);
    if (visitor.is_done()) return;
    walking = walk.advance(cells, walking, pieces);
  }
}

/// Visits all cells of a path from tau `enters` on, one cell in each lane. The grid must have no levels. No cell waits
/// for another one, but the walk cannot leap.
template <typename AnyPath, typename Visitor>
HWY_NOINLINE void walk_all_cells(float enters, const Query<float>& query, const AnyPath& path,
                                 const PathRange<float>& range, const ClippedPath& clipped, Visitor& visitor) {
  const LaneWalk walk(query.grid, query.mesh.slabs());
  const LaneWalk::Crossings crossings(clipped, enters);
  WalkingPaths lanes;
  walk.begin_crossings(clipped, lanes);
  const KernelInput<float> input(path, range, query.grid.frame());
  float from = 0;
  do {
    const std::uint32_t walking = walk.enter_crossings(crossings, from, lanes);
    const LaneWalk::Cells cells = walk.look_in<false>(lanes, walking);
    visit_cells(query, range, path, input, walk, cells, walking, lanes, visitor);
    from += static_cast<float>(hn::Lanes(FloatTag()));
  } while (from <= crossings.last && !visitor.is_done());
}

/// Walks the path in lanes if it is long enough for this to be faster. Returns true if it walked. If many cells have
/// lists, it is faster to visit all cells. If few cells have lists, it is faster to leap over the others. If nearly all
/// lists are in inner grids, a single walk is faster, because lanes would wait for the one that enters an inner grid.
/// Measurements chose a single walk for grids with levels too.
template <typename AnyPath, typename Visitor>
HWY_INLINE bool walk_in_lanes(float enters, const Query<float>& query, const AnyPath& path,
                              const PathRange<float>& range, const ClippedPath& clipped, Visitor& visitor) {
  constexpr float min_cells_in_pieces = 12;
  constexpr float min_cells_at_once = 4;
  constexpr std::size_t full_share = 4;  // More than one top cell in this many must have a list.
  const Grid& grid = query.grid;
  if (grid.is_mostly_inner() || grid.levels() > 0) return false;
  const bool takes_all = LaneWalk::can_enter_crossings && grid.lists().size() * full_share > grid.top().size();
  if (!is_long(takes_all ? min_cells_at_once : min_cells_in_pieces, grid, clipped, enters)) return false;
  if (takes_all) {
    walk_all_cells(enters, query, path, range, clipped, visitor);
  } else {
    walk_in_pieces(enters, query, path, range, clipped, visitor);
  }
  return true;
}
#endif

/// Gives the visitor all triangles of the mesh, until the visitor is done.
template <typename Scalar, typename AnyPath, typename Visitor>
HWY_NOINLINE void visit_all(const Query<Scalar>& query, const AnyPath& path, const PathRange<Scalar>& range,
                            Visitor& visitor) {
  ++query.statistics.unclipped;
  query.statistics.candidates += query.mesh.triangle_count();
  const typename Visitor::Narrowphase narrowphase(path, query.options, range, query.statistics);
  for (std::uint32_t id = 0; id < query.mesh.triangle_count() && !visitor.is_done(); ++id) {
    Candidate<Scalar> candidate{id, query.mesh.triangle(id), {}};
    visitor.take(query, narrowphase, candidate, Closeness::unknown);
  }
}

/// Walks the path cell by cell through a frame from tau `enters` on, until the visitor is done. Gives the visitor the
/// triangles that the path may meet. `When` is `AtOnce` or `OnDemand`.
template <typename When, typename Scalar, typename AnyPath, typename Visitor>
HWY_INLINE void walk_frame(const GridFrame& frame, float enters, const Query<Scalar>& query, const AnyPath& path,
                           const PathRange<Scalar>& range, const ClippedPath& clipped, When& when, Visitor& visitor) {
  GridTraversal traversal(query.grid, frame, clipped, enters);
  if constexpr (Visitor::shortens) {
    if (&frame != &query.grid.frame()) traversal.shorten(visitor.limit());
  }
  for (; !traversal.at_end(); traversal.advance()) {
    ++query.statistics.cells;
    if constexpr (requires { visitor.begin_cell(query, frame, clipped, traversal); }) {
      visitor.begin_cell(query, frame, clipped, traversal);
    }
    if (traversal.word().is_empty() || !traversal.meets_box()) continue;
    if (query.mesh.has_slabs() && !traversal.meets(query.mesh.slab(traversal.word()))) continue;
    const KernelInput<Scalar>& input = when.get(path, range, frame);
    const bool shorter = visit_cell(query, range, path, input, traversal.word(), visitor);
    if constexpr (Visitor::shortens) {
      if (shorter) traversal.shorten(visitor.limit());
    } else if (visitor.is_done()) {
      return;
    }
  }
}

/// Walks a path of floats through an inner grid that it does not begin near, if its start can be moved. Returns true if
/// it walked, or if it misses the grid. Else the path is clipped.
template <typename Visitor>
HWY_NOINLINE bool walk_inner_from_afar(const Query<float>& query, const Path<float>& path,
                                       const PathRange<float>& range, const GridFrame& frame,
                                       ClippedPath::InFloat in_float, ClippedPath& clipped, Visitor& visitor) {
  const FarClip far(frame, path, range.first, range.last, in_float, clipped);
  if (!far.is_free) return far.status == FarClip::Status::miss;
  const FarPath far_path(path, far);
  OnDemand<float> when(far_path, range, frame);
  walk_frame(frame, 0, query, far_path, range, clipped, when, visitor);
  return true;
}

/// Gives the visitor all lists of an inner grid, until the visitor is done.
template <typename Scalar, typename AnyPath, typename Visitor>
HWY_INLINE void visit_inner_lists(const Query<Scalar>& query, const AnyPath& path, const PathRange<Scalar>& range,
                                  const KernelInput<Scalar>& input, const GridFrame& frame, Visitor& visitor) {
  const std::size_t tops = std::size_t{frame.cells[0]} * frame.cells[1] * frame.cells[2];
  visit_list_cells(query.grid, frame, 0, tops, [&](const ListCell& cell) {
    if (!visitor.is_done()) visit_cell(query, range, path, input, cell.word, visitor);
  });
}

/// Walks the path through the inner grid of a cell, until the visitor is done. A path that is too far away to be
/// clipped meets all lists of the inner grid. The input of the kernel belongs to the path.
template <typename Scalar, typename AnyPath, typename Visitor>
HWY_NOINLINE void walk_inner(const Query<Scalar>& query, const AnyPath& path, const PathRange<Scalar>& range,
                             const KernelInput<Scalar>& input, CellWord word, Visitor& visitor) {
  const GridFrame& frame = query.grid.inner_frame(word);
  const auto walk_clipped_to_frame = [&](const auto& any_path, const ClippedPath& clipped) {
    if (clipped.status == ClippedPath::Status::miss) return;
    if (clipped.status == ClippedPath::Status::too_far) {
      visit_inner_lists(query, path, range, input, frame, visitor);
      return;
    }
    OnDemand<Scalar> when(any_path, range, frame);
    walk_frame(frame, 0, query, any_path, range, clipped, when, visitor);
  };
  if constexpr (std::is_convertible_v<const AnyPath&, const Path<float>&>) {
    // A start that was moved may be far from this grid too.
    const Path<float>& whole = path;
    ClippedPath clipped;
    const auto in_float = clipped.clip_in_float(frame, whole, range.first, range.last);
    if (in_float != ClippedPath::InFloat::done) {
      if (walk_inner_from_afar(query, whole, range, frame, in_float, clipped, visitor)) return;
    }
    walk_clipped_to_frame(whole, clipped);
  } else {
    walk_clipped_to_frame(path, clipped_to(frame, path, range));
  }
}

/// Walks the path through a frame from tau `enters` on, until the visitor is done. `When` is `AtOnce` or `OnDemand`.
template <template <typename> class When, typename Scalar, typename AnyPath, typename Visitor>
HWY_INLINE void walk_from(const GridFrame& frame, float enters, const Query<Scalar>& query, const AnyPath& path,
                          const PathRange<Scalar>& range, const ClippedPath& clipped, Visitor& visitor) {
#if HWY_TARGET != HWY_SCALAR
  if constexpr (std::is_same_v<Visitor, AnyHit<float>>) {
    // It returns false if there is a main grid.
    if (walk_in_lanes(enters, query, path, range, clipped, visitor)) return;
  }
#endif
  When<Scalar> when(path, range, frame);
  walk_frame(frame, enters, query, path, range, clipped, when, visitor);
}

/// Gives the visitor all triangles of a grid of one list, if the path comes to their box.
template <typename Scalar, typename Visitor>
HWY_INLINE void visit_only_list(const Query<Scalar>& query, const Path<Scalar>& path, const PathRange<Scalar>& range,
                                Visitor& visitor) {
  const GridFrame& frame = query.grid.frame();
  if (!is_finite(path) || misses_box(path, frame.low, frame.high)) return;
  ++query.statistics.cells;
  Scalar reach = 0;  // The first bound of P1. The path need not come to the cell of the list.
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double start = path.start[static_cast<Eigen::Index>(axis)];
    const double way = std::max(std::fabs(start - frame.low[axis]), std::fabs(start - frame.high[axis]));
    reach = std::max(reach, static_cast<Scalar>(way));
  }
  const KernelInput<Scalar> input(KernelPath<Scalar>(path, reach), range);
  visit_list(query, range, path, input, list_of(query, query.grid.top()[0]), visitor);
}

/// Gives the visitor the triangles that a path may meet, until the visitor is done. The path is clipped to the
/// outermost frame or to that of the main grid. A long path of floats walks only through the grid's cover, if this is
/// useful. Paths of doubles have one walk for all lengths, because two would take too much stack.
template <typename Scalar, typename AnyPath, typename Visitor>
HWY_INLINE void walk_clipped(const GridFrame& frame, const Query<Scalar>& query, const AnyPath& path,
                             const PathRange<Scalar>& range, ClippedPath& clipped, Visitor& visitor) {
  if (clipped.status == ClippedPath::Status::miss) return;
  if (clipped.status == ClippedPath::Status::too_far) {
    visit_all<Scalar, Path<Scalar>>(query, path, range, visitor);
    return;
  }
  constexpr float few_cells = 4;
  const bool is_far = is_long(few_cells, query.grid, clipped, 0);
  if (!is_far && clipped.stays_in_empty_space(query.grid, frame)) {
    ++query.statistics.cells;
    return;
  }
  if constexpr (std::is_same_v<Scalar, float>) {
    if (is_far) {
      float enters = 0;
      const GridCover& cover = query.grid.cover();
      if (cover.is_useful() && &frame == &query.grid.frame()) {
        const GridCover::Part part = cover.part_of(clipped.start, clipped.inverse_rate, clipped.octant, clipped.end);
        if (part.enters > part.leaves) return;
        enters = part.enters;
        clipped.end = part.leaves;
      }
      walk_from<AtOnce>(frame, enters, query, path, range, clipped, visitor);
      return;
    }
  }
  walk_from<OnDemand>(frame, 0, query, path, range, clipped, visitor);
}

/// Clips a path of floats that does not begin near the grid, or is very slow or fast. Returns true if it misses the
/// grid, or if it has walked.
template <typename Visitor>
HWY_NOINLINE bool walk_from_afar(const GridFrame& frame, const Query<float>& query, const Path<float>& path,
                                 const PathRange<float>& range, ClippedPath::InFloat in_float, ClippedPath& clipped,
                                 Visitor& visitor) {
  const FarClip far(frame, path, range.first, range.last, in_float, clipped);
  if (far.is_free) walk_clipped(frame, query, FarPath(path, far), range, clipped, visitor);
  return far.is_free || far.status == FarClip::Status::miss;
}

/// Gives the visitor the triangles that the path may meet, until the visitor is done.
template <typename Scalar, typename Visitor>
HWY_INLINE void walk(const Query<Scalar>& query, const Path<Scalar>& path, const PathRange<Scalar>& range,
                     Visitor& visitor) {
  ++query.statistics.paths;
  if (range.is_empty()) return;
  if (query.grid.is_one_list()) {
    visit_only_list(query, path, range, visitor);
    return;
  }
  if (query.grid.is_empty()) return;
  if constexpr (std::is_same_v<Scalar, float>) {
    const bool is_in_main =
        query.grid.main_grid().takes_floats() && misses_others(query.grid.main_grid(), path, range.first, range.last);
    const GridFrame& frame = is_in_main ? query.grid.main_frame() : query.grid.frame();
    ClippedPath clipped;
    const auto in_float = clipped.clip_in_float(frame, path, range.first, range.last);
    if (in_float != ClippedPath::InFloat::done) [[unlikely]] {
      if (walk_from_afar(frame, query, path, range, in_float, clipped, visitor)) return;
    }
    walk_clipped(frame, query, path, range, clipped, visitor);
  } else {
    ClippedPath clipped(query.grid, path, range.first, range.last);
    walk_clipped(query.grid.frame(), query, path, range, clipped, visitor);
  }
}

/// Returns the hit that the visitor of a path has kept.
template <typename Scalar>
HWY_INLINE Hit<Scalar> round_first(const Query<Scalar>& query, const Path<Scalar>& path, const PathRange<Scalar>& range,
                                   FirstHit<Scalar>& first) {
  Hit<Scalar> hit;
  bool is_rounded = first.is_certain();
  if constexpr (std::is_same_v<Scalar, float>) {
    is_rounded = is_rounded && try_round(path, first.triangle(), first.t_size(), first.edge_size(), hit);
  } else {
    is_rounded = is_rounded && try_round(path, first.triangle(), hit);
  }
  if (!is_rounded) {
    return first.decide_hit(typename FirstHit<Scalar>::Narrowphase(path, query.options, range, query.statistics));
  }
  hit.triangle = first.id();
  return hit;
}

/// Returns the first hit of a path.
template <typename Scalar>
std::optional<Hit<Scalar>> search_first(const Query<Scalar>& query, const Path<Scalar>& path) noexcept {
  const PathRange<Scalar> range(path, query.options);
  FirstHit<Scalar> first(query);
  walk(query, path, range, first);
  if (!first.is_found()) return std::nullopt;
  return round_first(query, path, range, first);
}

/// Returns true if the path has a hit.
template <typename Scalar>
bool search_any(const Query<Scalar>& query, const Path<Scalar>& path) noexcept {
  const PathRange<Scalar> range(path, query.options);
  AnyHit<Scalar> any(query);
  walk(query, path, range, any);
  return any.is_done();
}

/// Appends all hits of a path in order. Each triangle has at most one hit.
template <typename Scalar>
void search_all(const Query<Scalar>& query, const Path<Scalar>& path, std::vector<Hit<Scalar>>& hits) {
  const PathRange<Scalar> range(path, query.options);
  AllHits<Scalar> all;
  walk(query, path, range, all);
  const typename AllHits<Scalar>::Narrowphase narrowphase(path, query.options, range, query.statistics);
  all.append_to(hits, query, narrowphase);
}

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
