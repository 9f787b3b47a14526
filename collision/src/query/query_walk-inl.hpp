// Walks single paths. Highway compiles this file for each instruction set.

#if defined(SUREHIT_QUERY_WALK_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_QUERY_WALK_INL
#undef SUREHIT_QUERY_WALK_INL
#else
#define SUREHIT_QUERY_WALK_INL
#endif

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <vector>

#include "filter/double_hit_rounding-inl.hpp"
#include "filter/hit_rounding-inl.hpp"
#include "filter/kernel_path.hpp"
#include "grid/list_cells.hpp"
#include "misses_box.hpp"
#include "narrowphase.hpp"
#include "query/clipped_to-inl.hpp"
#include "query/far_path.hpp"
#include "query/hit_visitors-inl.hpp"
#include "query/list_visit-inl.hpp"
#include "query/path_in_lanes-inl.hpp"
#include "query/query.hpp"
#include "walk/far_clip.hpp"
#include "walk/grid_traversal.hpp"
#include "walk/main_grid_path.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

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
