// Answers batches: many paths against one mesh. Highway compiles this file for each instruction set.

#if defined(SUREHIT_BATCH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_BATCH_INL
#undef SUREHIT_BATCH_INL
#else
#define SUREHIT_BATCH_INL
#endif

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>

#include "query/batch_queries-inl.hpp"
#include "query/batch_rounding-inl.hpp"
#include "query/query_walk-inl.hpp"
#if HWY_TARGET != HWY_SCALAR  // This target has no lanes.
#include "query/batch_frame-inl.hpp"
#include "query/list_jobs-inl.hpp"
#include "query/path_queue-inl.hpp"
#include "walk/lane_walk-inl.hpp"
#endif

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

/// A path of a batch. It becomes a Path only where one is needed.
template <typename Scalar>
struct PathOfBatch {
  const PathSpan<Scalar>& paths;  ///< The paths of the batch.
  std::size_t index;              ///< The index of this path.
  operator Path<Scalar>() const { return paths[index]; }
};

/// Walks the paths of a batch side by side, in several vectors. While one vector waits for its cells, the next one
/// steps. A path that has come to a list meets the triangles alone, a vector of triangles at a time. When paths have
/// ended, waiting paths take their lanes.
///
/// `Visitor` is a visitor of single queries. Each walking path has one of its own. When a path ends, the batch calls
/// `finish(index, visitor)` if its visitor was given a triangle. It calls `alone(index)` for paths that no lane can
/// walk.
template <typename Scalar, typename Visitor, typename Queries, typename Finish, typename Alone>
class Batch {
 public:
  /// The paths begin in a frame of the grid: the outermost one, or that of the main grid.
  Batch(Queries& queries, const GridFrame& frame, const PathSpan<Scalar>& paths, Finish& finish, const Alone& alone)
      : query_(queries.of_batch()),
        queries_(queries),
        frame_(frame),
        walk_(query_.grid, frame, query_.mesh.slabs()),
        paths_(paths),
        queue_(walk_, frame, queries, paths, alone),
        jobs_(queries),
        finish_(finish),
        visitors_(for_all_slots(query_, std::make_index_sequence<slots>())) {
    for (WalkingPaths& walks : walks_) walk_.set_stops(walks);
  }

  /// Answers all paths. Each round is one step of all lanes.
  HWY_INLINE void run() {
    const BitsTag du;
    for (;;) {
      for (std::size_t i = 0; i < vectors; ++i) fill(i);
      if (walking_ == 0) return;
      query_.statistics.cells += static_cast<std::uint64_t>(std::popcount(walking_));
      // Each loop does one thing for all vectors, so that they do not wait for each other.
      const std::size_t used = (static_cast<std::size_t>(std::bit_width(walking_)) + max_lanes - 1) / max_lanes;
      for (std::size_t i = 0; i < used; ++i) {
        cells_[i] = walk_.look(walks_[i], lanes_of(i, walking_));
      }
      std::uint64_t arriving = 0;
      for (std::size_t i = 0; i < used; ++i) {
        const std::uint32_t in_lists = LaneWalk::in_lists(cells_[i], lanes_of(i, walking_));
        arriving |= slots_of(i, walk_.meet_lists(cells_[i], in_lists, walks_[i]));
        hn::Store(cells_[i].word, du, &words_[i * max_lanes]);
      }
      const std::uint64_t walked = walking_;  // The paths that are done end together with the others.
      walking_ &= ~visit_lists(arriving);
      std::uint64_t still = 0;
      for (std::size_t i = 0; i < used; ++i) {
        still |= slots_of(i, walk_.advance(cells_[i], lanes_of(i, walking_), walks_[i]));
      }
      if (has_inner_grids_) still = change_grids(still);
      end_paths(walked & ~still);
    }
  }

 private:
  // A slot is a lane of one of the vectors. The slots of vector i begin with slot i max_lanes. A set of slots or of
  // lanes has one bit for each.
  static constexpr std::size_t slots = max_slots<Scalar>;    ///< The number of slots.
  static constexpr std::size_t vectors = slots / max_lanes;  ///< The number of vectors.
  static_assert(slots % max_lanes == 0 && slots <= 64);
  /// Idle lanes of a vector are filled if they are at least one lane in this many. To fill each lane at once would cost
  /// more than it saves.
  static constexpr std::size_t idle_share = 4;

  using Jobs = ListJobs<Scalar, Visitor>;
  static constexpr bool is_float = std::is_same_v<Scalar, float>;

  /// Makes a visitor for each slot.
  template <std::size_t... slot>
  static std::array<Visitor, slots> for_all_slots(const Query<Scalar>& query, std::index_sequence<slot...>) {
    return {((void)slot, Visitor(query))...};
  }

  /// Returns the lanes of a vector that belong to a set of slots.
  static std::uint32_t lanes_of(std::size_t vector, std::uint64_t set) {
    constexpr std::uint64_t all = (std::uint64_t{1} << max_lanes) - 1;
    return static_cast<std::uint32_t>(set >> vector * max_lanes & all);
  }
  /// Returns the slots of some lanes of a vector.
  static std::uint64_t slots_of(std::size_t vector, std::uint32_t lanes) {
    return std::uint64_t{lanes} << vector * max_lanes;
  }

  /// Fills the idle lanes of a vector with waiting paths, if enough lanes are idle.
  HWY_INLINE void fill(std::size_t vector) {
    const std::size_t lanes = hn::Lanes(FloatTag());
    const auto all = static_cast<std::uint32_t>((std::uint64_t{1} << lanes) - 1);
    const std::uint32_t idle = all & ~lanes_of(vector, walking_);
    if (static_cast<std::size_t>(std::popcount(idle)) * idle_share < lanes) return;
    const auto enter = [&](std::size_t lane, std::size_t index, const auto& parameter) -> KernelPath<Scalar>& {
      const std::size_t slot = vector * max_lanes + lane;
      index_[slot] = index;
      if constexpr (!Queries::is_shared) {
        queries_.set_weights(slot, index);
        visitors_[slot].begin(queries_.query(index));
      }
      if constexpr (is_float) {
        enters_rest_[slot] = parameter;
      } else {
        taus_[slot] = parameter;
      }
      return jobs_.path(slot);
    };
    const auto move_start = [&]([[maybe_unused]] std::size_t lane, const auto&... numbers) {
      if constexpr (is_float) jobs_.move_start(vector * max_lanes + lane, numbers...);
      if constexpr (Queries::is_placed) queries_.move_start(vector * max_lanes + lane, numbers...);
    };
    walking_ |= slots_of(vector, queue_.fill(idle, walks_[vector], enter, move_start));
  }

  /// Gives the lists of these paths' cells to their visitors. Returns the paths that are done.
  HWY_NOINLINE std::uint64_t visit_lists(std::uint64_t arriving) {
    std::uint64_t done = 0;
    in_inner_ = 0;
    for (std::size_t from = 0; arriving != 0; from += Jobs::max_at_once) {
      const std::uint64_t longer = from == 0 ? list_jobs<true>(arriving, 0) : list_jobs<false>(arriving, from);
      for (std::size_t first_job = 0; first_job < jobs_.count(); first_job += Jobs::max_jobs) {
        for (const typename Jobs::Open& open : jobs_.classify(first_job, from, visitors_)) {
          done |= visit_job(open);
        }
      }
      arriving = longer & ~done;
    }
    return done;
  }

  /// Lets paths enter the inner grids of their cells, and lets those that have left an inner grid go on around it.
  /// `still` has the slots that walk on. Returns those that walk on now.
  HWY_NOINLINE std::uint64_t change_grids(std::uint64_t still) {
    for (std::uint64_t entering = in_inner_ & walking_; entering != 0; entering &= entering - 1) {
      const auto slot = static_cast<std::size_t>(std::countr_zero(entering));
      const std::uint64_t bit = std::uint64_t{1} << slot;
      still = enter_inner(slot, (still & bit) != 0) ? still | bit : still & ~bit;
    }
    in_inner_ = 0;
    for (std::uint64_t leaving = has_outer_ & walking_ & ~still; leaving != 0; leaving &= leaving - 1) {
      const auto slot = static_cast<std::size_t>(std::countr_zero(leaving));
      if (Visitor::wants_order || !visitors_[slot].is_done()) still |= leave_inner(slot);
    }
    return still;
  }

  /// Lets the path of a slot enter the inner grid of its cell. Before, it has left the cell, and `walks_on` tells
  /// whether there is more to walk. Returns whether there is something to walk now.
  HWY_INLINE bool enter_inner(std::size_t slot, bool walks_on) {
    const std::uint64_t bit = std::uint64_t{1} << slot;
    const CellWord word(words_[slot]);
    const GridFrame& frame = query_.grid.inner_frame(word);
    const auto& range = queries_.range(index_[slot]);
    const Path<Scalar> path = paths_[index_[slot]];
    ClippedPath clipped = clipped_to(frame, path, range);
    if (clipped.status == ClippedPath::Status::miss) return walks_on;
    const bool can_return = !walks_on || (in_inner_frame_ & bit) == 0;
    if (clipped.status == ClippedPath::Status::too_far || (is_float && !clipped.is_unscaled()) || !can_return) {
      visited_ |= bit;
      const auto& query = queries_.query(index_[slot]);
      walk_inner(query, path, range, KernelInput<Scalar>(path, range, query.grid.frame()), word, visitors_[slot]);
      if constexpr (Visitor::wants_order) {
        shorten(slot, visitors_[slot].limit());
        return walks_on;
      }
      return walks_on && !visitors_[slot].is_done();
    }
    if constexpr (Visitor::wants_order) {
      clipped.end = std::min(clipped.end, clipped.beyond(visitors_[slot].limit()));
    }
    if (clipped.stays_in_empty_space(query_.grid, frame)) {
      ++query_.statistics.cells;
      return walks_on;
    }
    WalkingPaths& lanes = walks_[slot / max_lanes];
    const std::size_t lane = slot % max_lanes;
    if (walks_on) {
      OuterWalk& outer = outer_[slot];
      outer.path = WalkingPath(lanes, lane);
      outer.reach = jobs_.path(slot).reach;
      if constexpr (is_float) {
        outer.parameter = enters_rest_[slot];
      } else {
        outer.parameter = taus_[slot];
      }
      has_outer_ |= bit;
    }
    LaneWalk::put(lane, frame, clipped, lanes);
    LaneWalk::set_stop(lane, frame, lanes);
    if constexpr (is_float) {
      enters_rest_[slot] = LaneWalk::rest_of_enters(clipped.tau.origin[2]);
    } else {
      taus_[slot] = clipped.tau;
    }
    // A start that was moved is near the grid in which the batch begins, and has the reach of that grid.
    if (!jobs_.is_moved(slot)) jobs_.path(slot).reach = KernelPath<Scalar>(path, frame).reach;
    in_inner_frame_ |= bit;
    return true;
  }

  /// Lets the path of a slot go on around the inner grid that it has left. Returns the bit of the slot.
  HWY_INLINE std::uint64_t leave_inner(std::size_t slot) {
    const std::uint64_t bit = std::uint64_t{1} << slot;
    WalkingPaths& lanes = walks_[slot / max_lanes];
    const OuterWalk& outer = outer_[slot];
    LaneWalk::put(slot % max_lanes, frame_, outer.path, lanes);
    LaneWalk::set_stop(slot % max_lanes, frame_, lanes);
    jobs_.path(slot).reach = outer.reach;
    if constexpr (is_float) {
      enters_rest_[slot] = outer.parameter;
    } else {
      taus_[slot] = outer.parameter;
    }
    has_outer_ &= ~bit;
    in_inner_frame_ &= ~bit;
    if constexpr (Visitor::wants_order) shorten(slot, visitors_[slot].limit());
    return bit;
  }

  /// Makes jobs from the lists of these slots. The jobs begin with triangle `from` of each list. Returns the slots
  /// whose lists have more triangles than the jobs. If `loads_lists`, it loads the lists too.
  template <bool loads_lists>
  HWY_INLINE std::uint64_t list_jobs(std::uint64_t of_slots, std::size_t from) {
    if constexpr (loads_lists) {
      for (std::uint64_t found = of_slots; found != 0; found &= found - 1) {
        const auto slot = static_cast<std::size_t>(std::countr_zero(found));
        const CellWord word(words_[slot]);
        jobs_.find_list(slot, query_, word);
        in_inner_ |= std::uint64_t{word.has_inner_grid()} << slot;
      }
      jobs_.load_bounds(of_slots);
    }
    std::uint64_t longer = 0;
    std::size_t count = 0;
    for (; of_slots != 0; of_slots &= of_slots - 1) {
      const auto slot = static_cast<std::size_t>(std::countr_zero(of_slots));
      longer |= std::uint64_t{add_jobs(slot, from, count)} << slot;
    }
    jobs_.set_count(count);
    return longer;
  }

  /// Makes jobs from the list of a slot, as `ListJobs::add` does. It passes over octets that the path misses.
  HWY_INLINE bool add_jobs(std::size_t slot, std::size_t from, std::size_t& count) {
    if constexpr (is_float && !Queries::is_placed && requires { Visitor::passes_over_octets; }) {
      if (jobs_.has_boxes(slot)) {
        const auto& range = queries_.range(index_[slot]);
        return jobs_.add_met(slot, from, range.first, last_that_counts(range, visitors_[slot]), count);
      }
    }
    return jobs_.add(slot, from, count);
  }

  /// Gives the triangles of an open job to the visitor of their path. Returns the bit of the slot if its path is done.
  HWY_INLINE std::uint64_t visit_job(const typename Jobs::Open& open) {
    const auto& [slot, from, verdicts, first] = open;
    query_.statistics.undecided += static_cast<std::uint64_t>(std::popcount(verdicts.possible & ~verdicts.certain));
    visited_ |= std::uint64_t{1} << slot;
    const auto& query = queries_.query(index_[slot]);
    const auto& range = queries_.range(index_[slot]);
    const PathOfBatch<Scalar> path{paths_, index_[slot]};
    const bool shorter =
        visit(CandidateBlock<Scalar, PathOfBatch<Scalar>>{query, range, path, jobs_.list(slot),
                                                          jobs_.reach_from_start(slot), from, verdicts, first},
              visitors_[slot]);
    if constexpr (Visitor::wants_order) {
      if (shorter) shorten(slot, visitors_[slot].limit());
      return 0;
    }
    return std::uint64_t{visitors_[slot].is_done()} << slot;
  }

  /// Ends the walk of a slot at parameter t, because nothing beyond it counts.
  HWY_INLINE void shorten(std::size_t slot, double t) {
    WalkingPaths& lanes = walks_[slot / max_lanes];
    if constexpr (is_float) {
      lanes.shorten(slot % max_lanes, t, enters_rest_[slot]);
    } else {
      lanes.shorten(slot % max_lanes, t, taus_[slot]);
    }
  }

  /// Frees the slots of ended paths. Calls `finish` for those whose visitor was given a triangle.
  HWY_NOINLINE void end_paths(std::uint64_t ended) {
    walking_ &= ~ended;
    for (std::uint64_t visited = ended & visited_; visited != 0; visited &= visited - 1) {
      const auto slot = static_cast<std::size_t>(std::countr_zero(visited));
      finish_(index_[slot], visitors_[slot]);
      visitors_[slot].reset();
    }
    visited_ &= ~ended;
    has_outer_ &= ~ended;
    for (std::uint64_t inner = ended & in_inner_frame_; inner != 0; inner &= inner - 1) {
      const auto slot = static_cast<std::size_t>(std::countr_zero(inner));
      LaneWalk::set_stop(slot % max_lanes, frame_, walks_[slot / max_lanes]);
    }
    in_inner_frame_ &= ~ended;
    jobs_.forget_moved(ended, queries_);
  }

  /// A walk through the first grid that goes on when the path has left an inner grid.
  struct OuterWalk {
    WalkingPath path;                                              ///< The walk.
    Scalar reach;                                                  ///< The reach of the path in the kernel.
    std::conditional_t<is_float, float, WalkParameter> parameter;  ///< The parameter of the walk.
  };

  std::array<WalkingPaths, vectors> walks_ = {};  ///< The walking paths.
  std::array<LaneWalk::Cells, vectors> cells_;    ///< The cells that they are in.
  const Query<Scalar>& query_;                    ///< The query of the batch.
  Queries& queries_;                              ///< The queries of its paths.
  const GridFrame& frame_;                        ///< The frame in which they begin.
  LaneWalk walk_;
  const PathSpan<Scalar>& paths_;
  PathQueue<Scalar, Queries, Alone> queue_;  ///< The paths that wait for a lane.
  Jobs jobs_;                                ///< The lists that paths have come to.
  Finish& finish_;                           ///< Is called when a path ends.
  std::uint64_t walking_ = 0;                ///< The slots that hold a path.
  const bool has_inner_grids_ = !query_.grid.inner_frames().empty();
  std::uint64_t in_inner_ = 0;          ///< The slots whose cell has an inner grid.
  std::uint64_t in_inner_frame_ = 0;    ///< The slots that walk through an inner grid.
  std::uint64_t has_outer_ = 0;         ///< The slots with an outer walk.
  std::array<OuterWalk, slots> outer_;  ///< The outer walks of the slots that have one.
  /// What `WalkingPaths::enters` leaves out of the t where tau is 0.
  std::array<float, is_float ? slots : 0> enters_rest_;
  std::uint64_t visited_ = 0;                             ///< The slots whose visitor was given a triangle.
  std::array<std::size_t, slots> index_ = {};             ///< The index of the path of each slot.
  std::array<Visitor, slots> visitors_;                   ///< The visitor of each slot.
  std::array<WalkParameter, is_float ? 0 : slots> taus_;  ///< The parameter of each walk that was clipped in double.
  alignas(max_lanes * sizeof(float)) std::array<std::uint32_t, slots> words_;  ///< The words of the cells.
};

#endif  // HWY_TARGET != HWY_SCALAR

/// Answers all paths. They walk side by side if lanes can walk them. Otherwise `alone(index)` answers each path.
template <typename Visitor, typename Scalar, typename Queries, typename Finish, typename Alone>
HWY_INLINE void search_paths(Queries& queries, const PathSpan<Scalar>& paths, [[maybe_unused]] Finish& finish,
                             const Alone& alone) {
  const Grid& grid = queries.of_batch().grid;
  if (grid.is_empty()) {
    queries.of_batch().statistics.paths += paths.size();
    return;
  }
#if HWY_TARGET != HWY_SCALAR
  if (!queries.admits_nothing() && !grid.is_one_list()) {
    const GridFrame& frame = frame_of_batch(queries, paths);
    Batch<Scalar, Visitor, Queries, Finish, Alone>(queries, frame, paths, finish, alone).run();
    return;
  }
#endif
  for (std::size_t i = 0; i < paths.size(); ++i) alone(i);
}

/// Fewer paths would fill too few lanes.
inline constexpr std::size_t min_paths_in_lanes = 12;

/// Returns true if a batch has so few paths that they are asked one by one. The last paths of a large batch are asked
/// as the others.
template <typename AnyQuery, typename Scalar>
bool are_few(const AnyQuery& query, const PathSpan<Scalar>& paths) {
  return paths.size() < min_paths_in_lanes && query.path == 0;
}

/// Sets `hits[i]` to the first hit of path i. Each element must be a miss before.
template <typename Scalar, typename Queries>
HWY_NOINLINE void search_each_first_by(Queries queries, const PathSpan<Scalar>& paths, std::span<Hit<Scalar>> hits) {
  const auto alone = [&](std::size_t index) {
    hits[index] = search_first<Scalar>(queries.query(index), paths[index]).value_or(Hit<Scalar>{});
  };
  BatchRounding<Scalar, Queries> rounding(queries, paths, hits);
  const auto finish = [&](std::size_t index, FirstHit<Scalar>& first) { rounding.add(index, first); };
  search_paths<FirstHit<Scalar>>(queries, paths, finish, alone);
  rounding.flush();
}

/// Sets `blocked[i]` to 1 if path i has a hit. Each element must be 0 before.
template <typename Scalar, typename Queries>
HWY_NOINLINE void search_each_any_by(Queries queries, const PathSpan<Scalar>& paths, std::span<std::uint8_t> blocked) {
  const auto finish = [&](std::size_t index, const AnyHit<Scalar>& any) { blocked[index] = any.is_done() ? 1 : 0; };
  const auto alone = [&](std::size_t index) {
    blocked[index] = search_any<Scalar>(queries.query(index), paths[index]) ? 1 : 0;
  };
  search_paths<AnyHit<Scalar>>(queries, paths, finish, alone);
}

/// Sets `hits[i]` to the first hit of path i, or to a miss.
template <typename Scalar>
void search_each_first(const Query<Scalar>& query, const PathSpan<Scalar>& paths,
                       std::span<const QueryOptions<Scalar>> own_options, std::span<Hit<Scalar>> hits) noexcept {
  if (are_few(query, paths)) {
    for (std::size_t i = 0; i < paths.size(); ++i) {
      hits[i] = search_first<Scalar>(query_of_path(query, own_options, i), paths[i]).value_or(Hit<Scalar>{});
    }
    return;
  }
  std::fill_n(hits.begin(), paths.size(), Hit<Scalar>{});
  if (query.filter == nullptr && own_options.empty()) {
    search_each_first_by(SharedQuery<Scalar>(query, paths.kind()), paths, hits);
  } else {
    search_each_first_by(OwnQueries<Scalar>(query, own_options, paths.kind()), paths, hits);
  }
}

/// Sets `blocked[i]` to 1 if path i has a hit, else to 0.
template <typename Scalar>
void search_each_any(const Query<Scalar>& query, const PathSpan<Scalar>& paths,
                     std::span<const QueryOptions<Scalar>> own_options, std::span<std::uint8_t> blocked) noexcept {
  if (are_few(query, paths)) {
    for (std::size_t i = 0; i < paths.size(); ++i) {
      blocked[i] = search_any<Scalar>(query_of_path(query, own_options, i), paths[i]) ? 1 : 0;
    }
    return;
  }
  std::fill_n(blocked.begin(), paths.size(), std::uint8_t{0});
  if (query.filter == nullptr && own_options.empty()) {
    search_each_any_by(SharedQuery<Scalar>(query, paths.kind()), paths, blocked);
  } else {
    search_each_any_by(OwnQueries<Scalar>(query, own_options, paths.kind()), paths, blocked);
  }
}

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
