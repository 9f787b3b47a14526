// Many paths against one mesh, for the instruction set that Highway compiles this for.

#if defined(SUREHIT_BATCH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_BATCH_INL
#undef SUREHIT_BATCH_INL
#else
#define SUREHIT_BATCH_INL
#endif

#include <array>
#include <bit>
#include <optional>

#include "query_walk-inl.hpp"

#if HWY_TARGET != HWY_SCALAR  // which has no lanes
#include "lane_walk-inl.hpp"
#endif

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

/// Paths of one kind, walked side by side. A lane whose path has come to an occupied cell meets that cell's list alone,
/// a vector of triangles at a time; a lane whose path has ended is filled with the next one.
///
/// `Visitor` is what single queries use, one for each path that comes to an occupied cell. `finish(index, visitor)` is
/// called for these when they end, and `alone(index)` for each path that the lanes cannot place.
template <typename Visitor, typename AnyPath, typename Finish, typename Alone>
class Batch {
 public:
  Batch(const Query<float>& query, const PathRange<float>& range, std::span<const AnyPath> paths, const Finish& finish,
        const Alone& alone)
      : query_(query),
        range_(range),
        weights_(range),
        walk_(query.grid),
        paths_(paths),
        finish_(finish),
        alone_(alone) {
    static_assert(sizeof(AnyPath) == path_size * sizeof(float));
  }

  HWY_INLINE void run() {
    if (query_.grid.levels() > 0) {
      run_levels<true>();
    } else {
      run_levels<false>();
    }
  }

 private:
  /// What a path in a lane needs besides its walk.
  struct Visit {
    Visit(const Query<float>& query, const PathRange<float>& range, const RangeWeights<float>& weights,
          const AnyPath& any_path)
        : path(any_path),
          narrowphase(path, query.options, range, query.statistics),
          visitor(query, narrowphase),
          kernel_path(path, weights) {}

    Path<float> path;
    Narrowphase<float> narrowphase;
    Visitor visitor;
    KernelPath<float> kernel_path;
  };

  static constexpr std::size_t path_size = 6;
  /// Lanes are filled when this share of them is idle: each time one ends would cost more than it saves.
  static constexpr std::size_t idle_share = 4;

  template <bool has_levels>
  HWY_INLINE void run_levels() {
    const std::size_t lanes = hn::Lanes(FloatTag());
    const std::uint32_t all = static_cast<std::uint32_t>((std::uint64_t{1} << lanes) - 1);
    lanes_ = {};
    std::uint32_t walking = 0;
    for (;;) {
      const std::uint32_t idle = all & ~walking;
      if (static_cast<std::size_t>(std::popcount(idle)) * idle_share >= lanes) walking |= fill<has_levels>(idle);
      if (walking == 0) return;
      query_.statistics.cells += static_cast<std::uint64_t>(std::popcount(walking));
      const LaneWalk::Cells cells = walk_.look<has_levels>(lanes_, walking);
      const BitsTag du;
      const auto lists = hn::Eq(hn::And(cells.word, hn::Set(du, 15U)), hn::Zero(du));
      if (const auto meeting = static_cast<std::uint32_t>(bits_of(du, lists)) & walking; meeting != 0) {
        alignas(most_lanes * sizeof(float)) std::array<std::uint32_t, most_lanes> words;
        hn::Store(cells.word, du, words.data());
        walking &= ~meet_lists(meeting, words);
      }
      const std::uint32_t still = walk_.advance(cells, walking, lanes_);
      end_lanes(walking & ~still);
      walking = still;
    }
  }

  /// Puts paths that are placed but not yet walked into idle lanes; returns the lanes filled.
  template <bool has_levels>
  HWY_INLINE std::uint32_t fill(std::uint32_t idle) {
    std::uint32_t filled = 0;
    while (idle != 0) {
      if (waiting_ == 0 && !place_next<has_levels>()) break;
      const auto from = static_cast<std::size_t>(std::countr_zero(waiting_));
      const auto to = static_cast<std::size_t>(std::countr_zero(idle));
      lanes_.copy_lane(to, placed_, from);
      index_[to] = placed_first_ + from;
      waiting_ &= waiting_ - 1;
      idle &= idle - 1;
      filled |= std::uint32_t{1} << to;
    }
    return filled;
  }

  /// Places the next paths until one of them is inside the grid.
  template <bool has_levels>
  HWY_INLINE bool place_next() {
    const std::size_t lanes = hn::Lanes(FloatTag());
    while (next_ < paths_.size()) {
      placed_first_ = next_;
      const std::size_t count = std::min(lanes, paths_.size() - next_);
      next_ += count;
      const auto* numbers = reinterpret_cast<const float*>(paths_.data() + placed_first_);
      std::array<float, path_size * most_lanes> last;  // whole lanes are read
      if (count < lanes) {
        last.fill(0);
        std::copy_n(numbers, path_size * count, last.begin());
        numbers = last.data();
      }
      const LaneWalk::Placed placed =
          walk_.place(numbers, Path<float>(paths_.front()).has_end(), range_.first, range_.last, count, placed_);
      query_.statistics.paths += count - static_cast<std::size_t>(std::popcount(placed.apart));
      for (std::uint32_t apart = placed.apart; apart != 0; apart &= apart - 1) {
        alone_(placed_first_ + static_cast<std::size_t>(std::countr_zero(apart)));
      }
      waiting_ = leave_empty_space<has_levels>(placed.inside);
      if (waiting_ != 0) return true;
    }
    return false;
  }

  /// Steps the placed paths that begin in empty cells: most short ones end with that. Returns those that still walk.
  template <bool has_levels>
  HWY_INLINE std::uint32_t leave_empty_space(std::uint32_t inside) {
    const BitsTag du;
    const LaneWalk::Cells cells = walk_.look<has_levels>(placed_, inside);
    const auto empty = hn::Ne(hn::And(cells.word, hn::Set(du, 15U)), hn::Zero(du));
    const std::uint32_t leaving = static_cast<std::uint32_t>(bits_of(du, empty)) & inside;
    query_.statistics.cells += static_cast<std::uint64_t>(std::popcount(leaving));
    return (inside & ~leaving) | walk_.advance(cells, leaving, placed_);
  }

  /// Lets these lanes' paths meet the lists of their cells; returns those that are done.
  HWY_INLINE std::uint32_t meet_lists(std::uint32_t meeting, const std::array<std::uint32_t, most_lanes>& words) {
    std::uint32_t done = 0;
    for (std::uint32_t next = meeting; next != 0; next &= next - 1) {
      prefetch_list(query_, CellWord(words[static_cast<std::size_t>(std::countr_zero(next))]));
    }
    for (; meeting != 0; meeting &= meeting - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(meeting));
      std::optional<Visit>& visit = visits_[lane];
      if (!visit) visit.emplace(query_, range_, weights_, paths_[index_[lane]]);
      if (!meet_list(query_, visit->kernel_path, CellWord(words[lane]), visit->visitor)) continue;
      if (visit->visitor.is_done()) {
        done |= std::uint32_t{1} << lane;
      } else {
        lanes_.shorten(lane, visit->visitor.limit());
      }
    }
    end_lanes(done);
    return done;
  }

  HWY_INLINE void end_lanes(std::uint32_t ended) {
    for (; ended != 0; ended &= ended - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(ended));
      if (!visits_[lane]) continue;
      finish_(index_[lane], visits_[lane]->visitor);
      visits_[lane].reset();
    }
  }

  WalkingPaths placed_ = {};  ///< paths that are placed together
  WalkingPaths lanes_ = {};
  const Query<float>& query_;
  const PathRange<float>& range_;
  RangeWeights<float> weights_;
  LaneWalk walk_;
  std::span<const AnyPath> paths_;
  const Finish& finish_;
  const Alone& alone_;
  std::size_t next_ = 0;          ///< the first path that is not placed yet
  std::size_t placed_first_ = 0;  ///< the first of `placed_`,
  std::uint32_t waiting_ = 0;     ///< of `placed_`, still to be walked
  std::array<std::size_t, most_lanes> index_ = {};
  std::array<std::optional<Visit>, most_lanes> visits_;
};

#endif  // HWY_TARGET != HWY_SCALAR

/// Answers all paths: side by side where there are lanes and the grid's frame is one of floats, else one by one.
template <typename Visitor, typename AnyPath, typename Finish, typename Alone>
HWY_INLINE void answer_each(const Query<float>& query, std::span<const AnyPath> paths,
                            [[maybe_unused]] const Finish& finish, const Alone& alone) {
  if (paths.empty() || query.grid.is_empty()) return;
#if HWY_TARGET != HWY_SCALAR
  const PathRange<float> range(paths.front(), query.options);
  if (query.grid.frame().has_floats && !range.is_empty()) {
    Batch<Visitor, AnyPath, Finish, Alone>(query, range, paths, finish, alone).run();
    return;
  }
#endif
  for (std::size_t i = 0; i < paths.size(); ++i) alone(i);
}

template <typename AnyPath>
void find_each_first(const Query<float>& query, std::span<const AnyPath> paths, std::span<Hit<float>> hits) {
  std::fill_n(hits.begin(), paths.size(), Hit<float>{});
  const auto finish = [&](std::size_t index, const FirstHit<float>& first) {
    if (first.is_found()) hits[index] = first.hit();
  };
  const auto alone = [&](std::size_t index) {
    hits[index] = find_first<float>(query, paths[index]).value_or(Hit<float>{});
  };
  answer_each<FirstHit<float>>(query, paths, finish, alone);
}

template <typename AnyPath>
void find_each_any(const Query<float>& query, std::span<const AnyPath> paths, std::span<std::uint8_t> blocked) {
  std::fill_n(blocked.begin(), paths.size(), std::uint8_t{0});
  const auto finish = [&](std::size_t index, const AnyHit<float>& any) { blocked[index] = any.is_done() ? 1 : 0; };
  const auto alone = [&](std::size_t index) { blocked[index] = find_any<float>(query, paths[index]) ? 1 : 0; };
  answer_each<AnyHit<float>>(query, paths, finish, alone);
}

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
