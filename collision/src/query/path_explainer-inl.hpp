// The visitor of a query that explains itself. Highway compiles this file for each instruction set.

#if defined(SUREHIT_PATH_EXPLAINER_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_PATH_EXPLAINER_INL
#undef SUREHIT_PATH_EXPLAINER_INL
#else
#define SUREHIT_PATH_EXPLAINER_INL
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "query/pair_explainer.hpp"
#include "query/query_walk-inl.hpp"
#include "surehit/explain.hpp"
#include "walk/direction.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// The determinants of one vector of triangles, in memory.
template <typename Scalar>
class StoredDeterminants : BlockDeterminants<Scalar> {
  using Base = BlockDeterminants<Scalar>;

 public:
  StoredDeterminants(const KernelPath<Scalar>& path, const TriangleList<Scalar>& list, std::size_t from)
      : Base(path, list, from) {
    hn::Store(Base::det_, Base::d_, stored_[0].lanes);
    hn::Store(Base::height_, Base::d_, stored_[1].lanes);
    hn::Store(Base::u_, Base::d_, stored_[2].lanes);
    hn::Store(Base::v_, Base::d_, stored_[3].lanes);
  }

  /// Returns the numbers of a lane, with the bounds of its list.
  [[nodiscard]] FilterNumbers numbers(std::size_t lane, const ListBounds<Scalar>& bounds) const {
    const Scalar det = stored_[0].lanes[lane];
    const Scalar u = stored_[2].lanes[lane];
    const Scalar v = stored_[3].lanes[lane];
    const auto number = [](Scalar value, Scalar bound) { return FilterNumber{value, bound}; };
    return {number(det, bounds.det), number(stored_[1].lanes[lane], bounds.height), number(u, bounds.side),
            number(v, bounds.side), number(det - u - v, bounds.side)};
  }

 private:
  static constexpr std::size_t max_lanes_of_any = hn::MaxLanes(hn::ScalableTag<Scalar>());
  struct Stored {
    alignas(sizeof(Scalar) * max_lanes_of_any) Scalar lanes[max_lanes_of_any];
  };
  std::array<Stored, 4> stored_;  ///< det, T, U and V.
};

/// Notes the steps of the walk and what becomes of each candidate. The walk ends where that of a first hit may.
template <typename Scalar>
class PathExplainer {
 public:
  using Kernel = BlockKernel<Scalar>;
  using Narrowphase = detail::Narrowphase<Scalar>;
  static constexpr bool shortens = true;  ///< Nothing beyond `limit()` counts.

  PathExplainer(const Query<Scalar>& query, const Path<Scalar>& path, const PathRange<Scalar>& range,
                Explanation<Scalar>& explanation)
      : path_(path), range_(range), pairs_(query, path, range), told_(explanation) {}

  /// Notes a step. The walk calls it before it looks at the cell.
  void begin_cell(const Query<Scalar>& query, const GridFrame& frame, const ClippedPath& clipped,
                  const GridTraversal& traversal) {
    told_.walk = ExplainedWalk::cells;
    const CellWord word = traversal.word();
    const bool is_inner = &frame != &query.grid.frame();
    CellFinding finding = CellFinding::list;
    std::int32_t cells = 1;
    if (word.is_empty()) {
      finding = CellFinding::empty;
      // A walk that begins in an empty cell begins with a leap. Below the top cells, it always leaps.
      const std::uint32_t distance = word.distance(clipped.octant);
      const bool is_top = traversal.size() == static_cast<std::int32_t>(frame.division);
      const bool is_first = told_.cells.empty() || told_.cells.back().is_inner != is_inner;
      if (!is_top || is_first || distance >= GridTraversal::min_leap) cells = static_cast<std::int32_t>(distance);
    } else if (!traversal.meets_box()) {
      finding = CellFinding::misses_box;
    } else if (query.mesh.has_slabs() && !traversal.meets(query.mesh.slab(word))) {
      finding = CellFinding::misses_slab;
    }
    add_cell(box_of_cells(frame, clipped.octant, traversal, cells), finding, is_inner);
  }

  /// Notes what becomes of the triangles of a list. Returns true if the path is shorter now.
  bool visit(const Query<Scalar>& query, const KernelInput<Scalar>& input, const TriangleList<Scalar>& list) {
    if (told_.cells.empty()) {
      told_.walk = ExplainedWalk::one_list;
      const GridFrame& frame = query.grid.frame();
      add_cell({{frame.low[0], frame.low[1], frame.low[2]}, {frame.high[0], frame.high[1], frame.high[2]}},
               CellFinding::list, false);
    }
    bool is_shorter = false;
    const auto bounds = Kernel::bounds(input.path, input.weights, list);
    constexpr std::size_t lanes = hn::MaxLanes(hn::ScalableTag<Scalar>());
    for (std::size_t from = 0; from < list.count; from += hn::Lanes(hn::ScalableTag<Scalar>())) {
      const Verdicts verdicts = classify<Kernel>(input.path, input.weights, list, bounds, from);
      const StoredDeterminants<Scalar> stored(input.path, list, from);
      for (std::size_t lane = 0; lane < std::min(lanes, list.count - from); ++lane) {
        ExplainedCandidate candidate;
        candidate.triangle = query.grid.entries()[list.first_entry + from + lane];
        candidate.numbers = stored.numbers(lane, bounds);
        candidate.filter_verdict = (verdicts.possible >> lane & 1) == 0  ? FilterVerdict::miss
                                   : (verdicts.certain >> lane & 1) != 0 ? FilterVerdict::hit
                                                                         : FilterVerdict::undecided;
        is_shorter |= add_candidate(candidate);
        ++told_.cells.back().candidate_count;
      }
    }
    return is_shorter;
  }

  /// Notes what becomes of a triangle of a path that is too far away for the grid.
  bool take(const Query<Scalar>&, const Narrowphase&, const Candidate<Scalar>& taken, Closeness) {
    told_.walk = ExplainedWalk::all_triangles;
    ExplainedCandidate candidate;
    candidate.triangle = taken.id;
    return add_candidate(candidate);
  }

  /// Returns the t at which the walk may end.
  [[nodiscard]] double limit() const { return pairs_.limit(); }
  /// Returns false, because a later triangle may have an earlier hit.
  [[nodiscard]] bool is_done() const { return false; }
  /// Tells the hits, when the walk has ended.
  void finish() { told_.hits = pairs_.sorted_hits(); }

 private:
  bool add_candidate(ExplainedCandidate& candidate) {
    const bool is_shorter = pairs_.decide(candidate);
    told_.candidates.push_back(candidate);
    return is_shorter;
  }

  void add_cell(const Boxd& box, CellFinding finding, bool is_inner) {
    double enters = double{range_.first};
    double leaves = double{range_.last};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto at = static_cast<Eigen::Index>(axis);
      const double start = path_.start[at];
      const double way = direction_of(path_.kind, start, double{path_.toward[at]});
      if (way == 0) continue;
      const auto [first, last] = std::minmax({(box.low[at] - start) / way, (box.high[at] - start) / way});
      enters = std::max(enters, first);
      leaves = std::min(leaves, last);
    }
    // Near an edge of the box, roundings may exchange the two.
    ExplainedCell& cell = told_.cells.emplace_back();
    cell.box = box;
    cell.enters = std::min(enters, leaves);
    cell.leaves = std::max(enters, leaves);
    cell.finding = finding;
    cell.is_inner = is_inner;
    cell.first_candidate = told_.candidates.size();
  }

  /// Returns the box of a cube of so many cells, which begins with the current one.
  [[nodiscard]] static Boxd box_of_cells(const GridFrame& frame, std::uint32_t octant, const GridTraversal& traversal,
                                         std::int32_t cells) {
    const std::array<std::int32_t, 3> low = traversal.low();
    Boxd box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double end = frame.resolution(axis);
      double from = low[axis];
      double to = std::min(from + static_cast<double>(traversal.size()) * cells, end);
      // The walk counts from the other end where the path falls.
      if ((octant >> axis & 1) != 0) {
        from = end - from;
        to = end - to;
        std::swap(from, to);
      }
      const auto coordinate = [&](double position) {
        return ((position - double{frame.margin[axis]}) / frame.scale[axis] + frame.origin[axis]) / frame.unit[0] /
               frame.unit[1];
      };
      box.low[static_cast<Eigen::Index>(axis)] = coordinate(from);
      box.high[static_cast<Eigen::Index>(axis)] = coordinate(to);
    }
    return box;
  }

  const Path<Scalar>& path_;
  const PathRange<Scalar>& range_;
  PairExplainer<Scalar> pairs_;
  Explanation<Scalar>& told_;
};

/// Takes the place of `visit_list` for other visitors, which do not need the numbers of the kernel.
template <typename Scalar, typename AnyPath>
bool visit_list(const Query<Scalar>& query, const PathRange<Scalar>& range, const AnyPath& path,
                const KernelInput<Scalar>& input, const TriangleList<Scalar>& list, PathExplainer<Scalar>& explainer) {
  if constexpr (std::is_same_v<AnyPath, Path<Scalar>>) {
    return explainer.visit(query, input, list);
  } else {
    // The start of a path from afar was moved. The numbers that are told are those of its own start.
    return explainer.visit(query, KernelInput<Scalar>(path.path, range, query.grid.frame()), list);
  }
}

/// Explains a path.
template <typename Scalar>
void explain_path(const Query<Scalar>& query, const Path<Scalar>& path, Explanation<Scalar>& explanation) {
  const PathRange<Scalar> range(path, query.options);
  PathExplainer<Scalar> explainer(query, path, range, explanation);
  walk(query, path, range, explainer);
  explainer.finish();
}

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
