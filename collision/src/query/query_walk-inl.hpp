// Single paths, for the instruction set that Highway compiles this for.

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
#include "filter/hit_rounding-inl.hpp"
#include "filter/kernel_path.hpp"
#include "query/hit_visitors-inl.hpp"
#if HWY_TARGET != HWY_SCALAR  // which has no lanes
#include "walk/lane_walk-inl.hpp"
#endif
#include "narrowphase.hpp"
#include "query/query.hpp"
#include "walk/grid_traversal.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

template <typename Scalar>
HWY_INLINE TriangleList<Scalar> list_of(const Query<Scalar>& query, CellWord word) {
  const std::size_t first = query.grid.first_entry(word);
  const Scalar* block = query.mesh.block(word.number(), first);
  return {MeshBlocks<Scalar>::corners(block), query.grid.entry_count(word), first,
          MeshBlocks<Scalar>::edge_size(block)};
}

/// Shows the visitor the triangles of a list, from one of them on, that the path may meet. Returns whether the path is
/// shorter now.
template <typename Scalar, typename AnyPath, typename Visitor>
HWY_INLINE bool meet_list(const Query<Scalar>& query, const PathRange<Scalar>& range, const AnyPath& path,
                          const KernelPath<Scalar>& kernel_path, const RangeWeights<Scalar>& weights,
                          const TriangleList<Scalar>& list, std::size_t from, Visitor& visitor) {
  bool shorter = false;
  const auto bounds = Visitor::Kernel::bounds(kernel_path, weights, list);
  for (; from < list.count; from += hn::Lanes(hn::ScalableTag<Scalar>())) {
    FirstLanes<Scalar> first = {};
    Lanes lanes;
    if constexpr (Visitor::wants_order) {
      lanes = classify<typename Visitor::Kernel>(kernel_path, weights, list, bounds, from, visitor.t_upper(), first);
    } else {
      lanes = classify<typename Visitor::Kernel>(kernel_path, weights, list, bounds, from);
    }
    if (lanes.possible == 0) continue;
    query.statistics.undecided += static_cast<std::uint64_t>(std::popcount(lanes.possible & ~lanes.certain));
    shorter |= visitor.meet(Meeting<Scalar, AnyPath>{query, range, path, list, from, lanes, first});
    if (visitor.is_done()) return true;
  }
  return shorter;
}

/// What the kernel needs besides a list.
template <typename Scalar>
struct ForKernel {
  ForKernel(const Path<Scalar>& any_path, const PathRange<Scalar>& range, const GridFrame& frame)
      : path(any_path, frame), weights(range) {}
  KernelPath<Scalar> path;
  RangeWeights<Scalar> weights;
};

/// A walk makes it at once, while it waits for the first cells, on a long path of floats; else for the first list that
/// it meets, for most short paths meet none. (At once for all, short first hits took 1.04 of the time; on demand for
/// all, long ones 1.03 to 1.07.)
template <typename Scalar>
struct AtOnce {
  AtOnce(const Path<Scalar>& path, const PathRange<Scalar>& range, const GridFrame& frame) : made(path, range, frame) {}
  const ForKernel<Scalar>& get(const Path<Scalar>&, const PathRange<Scalar>&, const GridFrame&) const { return made; }
  ForKernel<Scalar> made;
};
template <typename Scalar>
struct OnDemand {
  OnDemand(const Path<Scalar>&, const PathRange<Scalar>&, const GridFrame&) {}
  const ForKernel<Scalar>& get(const Path<Scalar>& path, const PathRange<Scalar>& range, const GridFrame& frame) {
    if (!made) made.emplace(path, range, frame);
    return *made;
  }
  std::optional<ForKernel<Scalar>> made;
};

/// Whether a path has so many cells before it, from some tau on.
HWY_INLINE bool is_long(float min_cells, const Grid& grid, const ClippedPath& clipped, float enters) {
  const float rate = clipped.rate[0] + clipped.rate[1] + clipped.rate[2];
  const float way = (std::min(clipped.end, clipped.exit) - enters) * rate;
  return way >= min_cells * static_cast<float>(grid.frame().division) && way < 0x1p20F;
}

#if HWY_TARGET != HWY_SCALAR
/// Shows the visitor the triangles of the lists that the path may meet in the cells in which lanes stand, until it is
/// done.
template <typename Visitor>
HWY_INLINE void meet_cells(const Query<float>& query, const PathRange<float>& range, const Path<float>& path,
                           const ForKernel<float>& for_kernel, const LaneWalk& lanes, const LaneWalk::Cells& cells,
                           std::uint32_t standing, const WalkingPaths& paths, Visitor& visitor) {
  query.statistics.cells += static_cast<std::uint64_t>(std::popcount(standing));
  std::uint32_t arriving = LaneWalk::in_lists(cells, standing);
  if (arriving != 0) arriving = lanes.meet_lists(cells, arriving, paths);
  if (arriving == 0) return;
  alignas(max_lanes * sizeof(float)) std::array<std::uint32_t, max_lanes> words;
  hn::Store(cells.word, BitsTag(), words.data());
  for (; arriving != 0 && !visitor.is_done(); arriving &= arriving - 1) {
    const TriangleList<float> list =
        list_of(query, CellWord(words[static_cast<std::size_t>(std::countr_zero(arriving))]));
    query.statistics.candidates += list.count;
    meet_list(query, range, path, for_kernel.path, for_kernel.weights, list, 0, visitor);
  }
}

// A path side by side, for a visitor that is content with any hit: no step has to wait for the cell that the step
// before it loads. Where the first hit is wanted, what the later lanes find would be in vain.

/// Walks a path in pieces, one in each lane.
template <bool has_levels, typename Visitor>
HWY_NOINLINE void walk_in_pieces(float enters, const Query<float>& query, const Path<float>& path,
                                 const PathRange<float>& range, const ClippedPath& clipped, Visitor& visitor) {
  const LaneWalk lanes(query.grid, query.mesh.slabs());
  WalkingPaths pieces;
  lanes.cut(clipped, enters, pieces);
  const ForKernel<float> for_kernel(path, range, query.grid.frame());
  auto walking = static_cast<std::uint32_t>((std::uint64_t{1} << hn::Lanes(BitsTag())) - 1);
  while (walking != 0) {
    const LaneWalk::Cells cells = lanes.look<has_levels>(pieces, walking);
    meet_cells(query, range, path, for_kernel, lanes, cells, walking, pieces, visitor);
    if (visitor.is_done()) return;
    walking = lanes.advance(cells, walking, pieces);
  }
}

/// Stands in all cells of a path, one in each lane, in a grid that has no levels. None waits for another, and none is
/// leapt over.
template <typename Visitor>
HWY_NOINLINE void stand_in_cells(float enters, const Query<float>& query, const Path<float>& path,
                                 const PathRange<float>& range, const ClippedPath& clipped, Visitor& visitor) {
  const LaneWalk lanes(query.grid, query.mesh.slabs());
  const LaneWalk::Crossings crossings(clipped, enters);
  WalkingPaths paths;
  lanes.spread(clipped, paths);
  const ForKernel<float> for_kernel(path, range, query.grid.frame());
  float from = 0;
  do {
    const std::uint32_t standing = lanes.stand(crossings, from, paths);
    const LaneWalk::Cells cells = lanes.look<false>(paths, standing);
    meet_cells(query, range, path, for_kernel, lanes, cells, standing, paths, visitor);
    from += static_cast<float>(hn::Lanes(FloatTag()));
  } while (from <= crossings.last && !visitor.is_done());
}

/// The one or the other if the path has so many cells before it that it pays. Returns whether it did. (In a grid of
/// which two in five cells list triangles, long paths that stand in all cells take 0.91 of the time of those that walk
/// in pieces, and lines of sight 0.89; in one of which a tenth do, where a piece leaps over most cells, 1.06 and 1.11.)
template <typename Visitor>
HWY_INLINE bool walk_in_lanes(float enters, const Query<float>& query, const Path<float>& path,
                              const PathRange<float>& range, const ClippedPath& clipped, Visitor& visitor) {
  constexpr float min_in_pieces = 12;
  constexpr float min_in_cells = 4;
  constexpr std::size_t min_full = 4;  // one cell in as many lists triangles
  const Grid& grid = query.grid;
  const bool has_levels = grid.levels() > 0;
  const bool is_spread = LaneWalk::can_spread && !has_levels && grid.lists().size() * min_full > grid.top().size();
  if (!is_long(is_spread ? min_in_cells : min_in_pieces, grid, clipped, enters)) return false;
  if (is_spread) {
    stand_in_cells(enters, query, path, range, clipped, visitor);
  } else if (has_levels) {
    walk_in_pieces<true>(enters, query, path, range, clipped, visitor);
  } else {
    walk_in_pieces<false>(enters, query, path, range, clipped, visitor);
  }
  return true;
}
#endif

/// Shows the visitor all triangles, until it is done.
template <typename Scalar, typename Visitor>
HWY_NOINLINE void meet_all(const Query<Scalar>& query, const Path<Scalar>& path, const PathRange<Scalar>& range,
                           Visitor& visitor) {
  ++query.statistics.unclipped;
  query.statistics.candidates += query.mesh.triangle_count();
  const Narrowphase<Scalar> narrowphase(path, query.options, range, query.statistics);
  for (std::uint32_t id = 0; id < query.mesh.triangle_count() && !visitor.is_done(); ++id) {
    Candidate<Scalar> candidate{id, query.mesh.triangle(id), {}};
    visitor.meet(query, narrowphase, candidate);
  }
}

/// Shows the visitor the triangles that the path may meet from some tau on, cell by cell, until it is done or the walk
/// ends.
template <template <typename> class When, typename Scalar, typename Visitor>
HWY_INLINE void walk_from(float enters, const Query<Scalar>& query, const Path<Scalar>& path,
                          const PathRange<Scalar>& range, const ClippedPath& clipped, Visitor& visitor) {
#if HWY_TARGET != HWY_SCALAR
  if constexpr (std::is_same_v<Visitor, AnyHit<float>>) {
    if (walk_in_lanes(enters, query, path, range, clipped, visitor)) return;
  }
#endif
  When<Scalar> when(path, range, query.grid.frame());
  for (GridTraversal traversal(query.grid, clipped, enters); !traversal.at_end(); traversal.advance()) {
    ++query.statistics.cells;
    if (traversal.word().is_empty() || !traversal.meets_box()) continue;
    if (query.mesh.has_slabs() && !traversal.meets(query.mesh.slab(traversal.word()))) continue;
    const ForKernel<Scalar>& for_kernel = when.get(path, range, query.grid.frame());
    const TriangleList<Scalar> list = list_of(query, traversal.word());
    query.statistics.candidates += list.count;
    const bool shorter = meet_list(query, range, path, for_kernel.path, for_kernel.weights, list, 0, visitor);
    if constexpr (Visitor::wants_order) {
      if (shorter) traversal.shorten(visitor.limit());
    } else if (visitor.is_done()) {
      return;
    }
  }
}

/// The same for a long path, from where it enters the grid's cover to where it leaves that.
template <typename Visitor>
HWY_NOINLINE void walk_in_cover(const Query<float>& query, const Path<float>& path, const PathRange<float>& range,
                                ClippedPath& clipped, Visitor& visitor) {
  const GridCover::Part part =
      query.grid.cover().part_of(clipped.start, clipped.inverse_rate, clipped.octant, clipped.end);
  if (part.enters > part.leaves) return;
  clipped.end = part.leaves;
  walk_from<AtOnce>(part.enters, query, path, range, clipped, visitor);
}

/// Shows the visitor the triangles that the path may meet, until it is done.
template <typename Scalar, typename Visitor>
HWY_INLINE void walk(const Query<Scalar>& query, const Path<Scalar>& path, const PathRange<Scalar>& range,
                     Visitor& visitor) {
  ++query.statistics.paths;
  if (range.is_empty()) return;
  ClippedPath clipped(query.grid, path, range.first, range.last);
  if (clipped.status == ClippedPath::Status::miss) return;
  if (clipped.status == ClippedPath::Status::too_far) {
    meet_all(query, path, range, visitor);
    return;
  }
  constexpr float few_cells = 4;
  const bool is_far = is_long(few_cells, query.grid, clipped, 0);
  if (!is_far && clipped.stays_in_empty_space(query.grid)) {
    ++query.statistics.cells;
    return;
  }
  if constexpr (std::is_same_v<Scalar, float>) {  // for double, more than one walk would take too much stack
    if (is_far) {
      if (query.grid.cover().is_useful()) {
        walk_in_cover(query, path, range, clipped, visitor);
      } else {
        walk_from<AtOnce>(0, query, path, range, clipped, visitor);
      }
      return;
    }
  }
  walk_from<OnDemand>(0, query, path, range, clipped, visitor);
}

template <typename Scalar>
std::optional<Hit<Scalar>> search_first(const Query<Scalar>& query, const Path<Scalar>& path) {
  const PathRange<Scalar> range(path, query.options);
  FirstHit<Scalar> first(query);
  walk(query, path, range, first);
  if (!first.is_found()) return std::nullopt;
  if constexpr (std::is_same_v<Scalar, float>) {
    Hit<Scalar> hit;
    if (first.is_located_only() && try_round(path, first.triangle(), first.t_size(), first.edge_size(), hit)) {
      hit.triangle = first.id(query);
      return hit;
    }
  }
  return first.hit(query, Narrowphase<Scalar>(path, query.options, range, query.statistics));
}

template <typename Scalar>
bool search_any(const Query<Scalar>& query, const Path<Scalar>& path) {
  const PathRange<Scalar> range(path, query.options);
  AnyHit<Scalar> any(query);
  walk(query, path, range, any);
  return any.is_done();
}

template <typename Scalar>
void search_all(const Query<Scalar>& query, const Path<Scalar>& path, std::vector<Hit<Scalar>>& hits) {
  const PathRange<Scalar> range(path, query.options);
  AllHits<Scalar> all;
  walk(query, path, range, all);
  const Narrowphase<Scalar> narrowphase(path, query.options, range, query.statistics);
  all.append_to(hits, query, narrowphase);
}

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
