// Many paths against one mesh, for the instruction set that Highway compiles this for.

#if defined(SUREHIT_BATCH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_BATCH_INL
#undef SUREHIT_BATCH_INL
#else
#define SUREHIT_BATCH_INL
#endif

#include <hwy/cache_control.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <span>
#include <utility>

#include "filter/hit_rounding-inl.hpp"
#include "query/query_walk-inl.hpp"

#if HWY_TARGET != HWY_SCALAR  // which has no lanes
#include "query/lane_walk-inl.hpp"
#endif

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

/// Paths of one kind, walked side by side, some vectors of them: while one waits for its cells, the next one steps. A
/// path that has come to an occupied cell meets that cell's list alone, a vector of triangles at a time; where one has
/// ended, the next one takes its place.
///
/// `Visitor` is what single queries use, one for each path. `finish(index, visitor)` is called when a path ends, if its
/// visitor was shown a triangle, and `alone(index)` for each path that the lanes cannot place.
template <typename Visitor, typename Finish, typename Alone>
class Batch {
 public:
  Batch(const Query<float>& query, const PathRange<float>& range, const PathSpan<float>& paths, Finish& finish,
        const Alone& alone)
      : query_(query),
        range_(range),
        weights_(range),
        walk_(query.grid, query.mesh.slabs()),
        paths_(paths),
        finish_(finish),
        alone_(alone),
        visitors_(for_all_paths(query, std::make_index_sequence<max_paths>())) {}

  HWY_INLINE void run() {
    if (query_.grid.levels() > 0) {
      run_levels<true>();
    } else {
      run_levels<false>();
    }
  }

 private:
  /// Paths at once, each in its slot: of vector i those from i max_lanes on. More would gain little and take stack.
  static constexpr std::size_t max_paths = 48;
  static constexpr std::size_t vectors = max_paths / max_lanes;
  static_assert(max_paths % max_lanes == 0 && max_paths <= 64);  // a bit each in a set of slots

  template <std::size_t... slot>
  static std::array<Visitor, max_paths> for_all_paths(const Query<float>& query, std::index_sequence<slot...>) {
    return {((void)slot, Visitor(query))...};
  }

  using Kernel = typename Visitor::Kernel;

  static constexpr std::size_t path_size = PathSpan<float>::numbers_each;
  static constexpr std::size_t paths_ahead = 64;           ///< so much before they are clipped, paths are fetched
  static constexpr std::size_t line = 64 / sizeof(float);  ///< of the cache
  /// A vector's lanes are filled when this share of them is idle: each time one ends would cost more than it saves.
  static constexpr std::size_t idle_share = 4;

  /// Made a Path only where one is wanted.
  struct PathOfSlot {
    const PathSpan<float>& paths;
    std::size_t index;
    operator Path<float>() const { return paths[index]; }
  };
  /// Triangles of a list that the path of a slot has come to, as many as the kernel takes at once.
  struct Job {
    std::uint16_t slot;
    std::uint16_t from;  ///< counted from those that are jobs already
  };
  /// What the kernel says of a job's triangles, if the path may meet one of them.
  struct Open {
    std::size_t slot;
    std::size_t from;
    Lanes lanes;
    FirstLanes<float> first;
  };
  /// `BlockKernel::Crossing` in memory.
  struct alignas(max_lanes * sizeof(float)) Crossing {
    LaneFloats height;
    LaneFloats det;
  };
  /// So many triangles of each list become jobs before the verdicts on any of them are heeded. Where any hit will do,
  /// the rest of a list is often not asked for.
  static constexpr std::size_t max_at_once = Visitor::wants_order ? 64 : 32;
  static_assert(max_at_once % max_lanes == 0);
  /// The kernel is asked about so many jobs before anything is done about its verdicts: what is kept of each takes
  /// stack.
  static constexpr std::size_t max_jobs = 256 / max_lanes;

  template <bool has_levels>
  HWY_INLINE void run_levels() {
    const BitsTag du;
    for (;;) {
      for (std::size_t i = 0; i < vectors; ++i) fill<has_levels>(i);
      if (walking_ == 0) return;
      query_.statistics.cells += static_cast<std::uint64_t>(std::popcount(walking_));
      // Each loop does one thing for all vectors, so that they do not wait for each other.
      const std::size_t used = (static_cast<std::size_t>(std::bit_width(walking_)) + max_lanes - 1) / max_lanes;
      for (std::size_t i = 0; i < used; ++i) {
        cells_[i] = walk_.look<has_levels>(lanes_[i], of_vector(i, walking_));
      }
      std::uint64_t arriving = 0;
      for (std::size_t i = 0; i < used; ++i) {
        const std::uint32_t standing = LaneWalk::in_lists(cells_[i], of_vector(i, walking_));
        arriving |= slots_of(i, walk_.meet_lists(cells_[i], standing, lanes_[i]));
        hn::Store(cells_[i].word, du, &words_[i * max_lanes]);
      }
      const std::uint64_t walked = walking_;  // those that are done end with the rest
      walking_ &= ~meet_lists(arriving);
      std::uint64_t still = 0;
      for (std::size_t i = 0; i < used; ++i) {
        still |= slots_of(i, walk_.advance(cells_[i], of_vector(i, walking_), lanes_[i]));
      }
      end_paths(walked & ~still);
    }
  }

  // Sets of lanes and of slots have a bit for each.

  static std::uint32_t of_vector(std::size_t vector, std::uint64_t slots) {
    constexpr std::uint64_t all = (std::uint64_t{1} << max_lanes) - 1;
    return static_cast<std::uint32_t>(slots >> vector * max_lanes & all);
  }
  static std::uint64_t slots_of(std::size_t vector, std::uint32_t lanes) {
    return std::uint64_t{lanes} << vector * max_lanes;
  }

  /// Puts paths that are clipped but not yet walked into a vector's idle lanes, if these are many enough.
  template <bool has_levels>
  HWY_INLINE void fill(std::size_t vector) {
    const std::size_t lanes = hn::Lanes(FloatTag());
    const std::uint32_t all = static_cast<std::uint32_t>((std::uint64_t{1} << lanes) - 1);
    std::uint32_t idle = all & ~of_vector(vector, walking_);
    if (static_cast<std::size_t>(std::popcount(idle)) * idle_share < lanes) return;
    while (idle != 0) {
      if (waiting_ == 0 && !clip_next<has_levels>()) break;
      alignas(max_lanes * sizeof(float)) LaneIndices from_lane = {};
      std::uint32_t filled = 0;
      for (; waiting_ != 0 && idle != 0; waiting_ &= waiting_ - 1, idle &= idle - 1) {
        const auto from = static_cast<std::size_t>(std::countr_zero(waiting_));
        const auto to = static_cast<std::size_t>(std::countr_zero(idle));
        from_lane[to] = static_cast<std::int32_t>(from);
        kernel_path_[vector * max_lanes + to] = clipped_kernel_paths_.at(from);
        index_[vector * max_lanes + to] = clipped_first_ + from;
        filled |= std::uint32_t{1} << to;
      }
      lanes_[vector].take(filled, clipped_, from_lane);
      walking_ |= slots_of(vector, filled);
    }
  }

  /// Places the next paths until one of them is inside the grid.
  template <bool has_levels>
  HWY_INLINE bool clip_next() {
    const std::size_t lanes = hn::Lanes(FloatTag());
    while (next_ < paths_.size()) {
      clipped_first_ = next_;
      const std::size_t count = std::min(lanes, paths_.size() - next_);
      next_ += count;
      prefetch_paths(next_ + paths_ahead);
      const float* numbers = paths_.numbers(clipped_first_);
      std::array<float, path_size * max_lanes> last;  // whole lanes are read
      if (count < lanes) {
        last.fill(0);
        std::copy_n(numbers, path_size * count, last.begin());
        numbers = last.data();
      }
      const LaneWalk::Clipped clipped =
          walk_.clip(numbers, paths_.have_ends(), range_.first, range_.last, count, clipped_, clipped_kernel_paths_);
      query_.statistics.paths += count - static_cast<std::size_t>(std::popcount(clipped.apart));
      for (std::uint32_t apart = clipped.apart; apart != 0; apart &= apart - 1) {
        alone_(clipped_first_ + static_cast<std::size_t>(std::countr_zero(apart)));
      }
      waiting_ = leave_empty_space<has_levels>(clipped.inside);
      if (waiting_ != 0) return true;
    }
    return false;
  }

  /// Fetches as many paths as are clipped together into the cache: the machine does not foresee them, for much else is
  /// read between two such reads. (Where paths come from memory, batches of short ones take 0.87 of the time.)
  HWY_INLINE void prefetch_paths(std::size_t first) const {
    const std::size_t lanes = hn::Lanes(FloatTag());
    if (first + lanes > paths_.size()) return;
    const float* const numbers = paths_.numbers(first);
    for (std::size_t from = 0; from < path_size * lanes; from += line) hwy::Prefetch(numbers + from);
  }

  /// Steps the clipped paths that begin in empty cells: most short ones end with that. Returns those that still walk.
  template <bool has_levels>
  HWY_INLINE std::uint32_t leave_empty_space(std::uint32_t inside) {
    const LaneWalk::Cells cells = walk_.look<has_levels>(clipped_, inside);
    const std::uint32_t leaving = inside & ~LaneWalk::in_lists(cells, inside);
    query_.statistics.cells += static_cast<std::uint64_t>(std::popcount(leaving));
    return (inside & ~leaving) | walk_.advance(cells, leaving, clipped_);
  }

  /// Fetches the beginning of a list into the cache, or what lies behind it. More lines would cost more than they save;
  /// so does one for a single path, which needs the list at once.
  static void prefetch(const TriangleList<float>& list) {
    constexpr std::size_t lines = 4;
    for (std::size_t from = 0; from < lines * line; from += line) hwy::Prefetch(list.corners + from);
  }

  /// Lets these paths meet the lists of their cells, and returns those that are done. The kernel runs over some lists,
  /// of whatever length, before anything is done about its verdicts: neither can be foretold.
  HWY_INLINE std::uint64_t meet_lists(std::uint64_t arriving) {
    std::uint64_t done = 0;
    for (std::size_t from = 0; arriving != 0; from += max_at_once) {
      std::uint64_t longer = 0;
      const std::size_t jobs =
          from == 0 ? list_jobs<true>(arriving, 0, longer) : list_jobs<false>(arriving, from, longer);
      for (std::size_t first_job = 0; first_job < jobs; first_job += max_jobs) {
        const auto some = std::span(jobs_).subspan(first_job, std::min(jobs - first_job, max_jobs));
        for (const auto& [slot, first_triangle, verdicts, first] : std::span(open_).first(open_jobs(some, from))) {
          query_.statistics.undecided +=
              static_cast<std::uint64_t>(std::popcount(verdicts.possible & ~verdicts.certain));
          shown_ |= std::uint64_t{1} << slot;
          const bool shorter = visitors_[slot].meet(Meeting<float, PathOfSlot>{
              query_, range_, PathOfSlot{paths_, index_[slot]}, lists_[slot], first_triangle, verdicts, first});
          done |= heed(slot, shorter);
        }
      }
      arriving = longer & ~done;
    }
    return done;
  }

  /// Of the lists of these slots' paths the triangles from one of them on, as many as become jobs at once. Says how
  /// many jobs there are, and whose lists are longer. The first time it finds the lists: a loop of its own, over as
  /// many as nobody could foretell, would cost a branch more.
  template <bool finds_lists>
  HWY_INLINE std::size_t list_jobs(std::uint64_t slots, std::size_t from, std::uint64_t& longer) {
    const std::size_t lanes = hn::Lanes(hn::ScalableTag<float>());
    std::size_t jobs = 0;
    for (; slots != 0; slots &= slots - 1) {
      const auto slot = static_cast<std::uint16_t>(std::countr_zero(slots));
      if constexpr (finds_lists) {
        const TriangleList<float>& list = lists_[slot] = list_of(query_, CellWord(words_[slot]));
        prefetch(list);
        bounds_[slot] = Kernel::bounds(kernel_path_[slot], weights_, list);
        query_.statistics.candidates += list.count;
      }
      const std::size_t left = lists_[slot].count - from;
      for (std::size_t i = 0; i < max_at_once; i += lanes) {
        jobs_[jobs + i / lanes] = {slot, static_cast<std::uint16_t>(i)};
      }
      jobs += (std::min(left, max_at_once) + lanes - 1) / lanes;
      longer |= std::uint64_t{left > max_at_once} << slot;
    }
    return jobs;
  }

  /// Does what a path's visitor has come to; returns the path's bit if that is the end.
  HWY_INLINE std::uint64_t heed(std::size_t slot, bool shorter) {
    if constexpr (Visitor::wants_order) {
      if (shorter) lanes_[slot / max_lanes].shorten(slot % max_lanes, visitors_[slot].limit());
      return 0;
    }
    return std::uint64_t{visitors_[slot].is_done()} << slot;
  }

  /// Asks the kernel; returns how many of the jobs are open then.
  HWY_NOINLINE std::size_t open_jobs(std::span<const Job> jobs, std::size_t first) {
    const hn::ScalableTag<float> d;
    std::size_t open = 0;
    for (const Job& job : jobs) {
      const std::size_t from = first + job.from;
      const Kernel kernel(kernel_path_[job.slot], lists_[job.slot], from);
      open_[open].slot = job.slot;
      open_[open].from = from;
      open_[open].lanes = kernel.classify(weights_, bounds_[job.slot]);
      if constexpr (Visitor::wants_order) {
        const typename Kernel::Crossing crossing = kernel.crossing();
        hn::Store(crossing.height, d, crossings_[open].height.data());
        hn::Store(crossing.det, d, crossings_[open].det.data());
      }
      open += open_[open].lanes.possible != 0 ? 1 : 0;
    }
    if constexpr (Visitor::wants_order) {
      for (std::size_t i = 0; i < open; ++i) {
        const auto& [height, det] = crossings_[i];
        auto& [slot, from, lanes, first] = open_[i];
        if (lanes.certain == lanes.possible && std::has_single_bit(lanes.certain)) [[likely]] {
          const auto lane = static_cast<std::size_t>(std::countr_zero(lanes.certain));
          first = Kernel::lone_first(bounds_[slot], height[lane], det[lane], lanes.certain);
          continue;
        }
        const float limit = visitors_[slot].t_upper();
        first = Kernel::first_of(bounds_[slot], {hn::Load(d, height.data()), hn::Load(d, det.data())}, lanes.certain,
                                 limit);
        const bool is_clear = lanes.certain == lanes.possible && (first.lanes & (first.lanes - 1)) == 0;
        if (!is_clear) [[unlikely]] {
          Kernel::weigh_each(kernel_path_[slot], lists_[slot], from, weights_, limit, lanes, first);
        }
      }
    }
    return open;
  }

  HWY_INLINE void end_paths(std::uint64_t ended) {
    walking_ &= ~ended;
    for (std::uint64_t shown = ended & shown_; shown != 0; shown &= shown - 1) {
      const auto slot = static_cast<std::size_t>(std::countr_zero(shown));
      finish_(index_[slot], visitors_[slot]);
      visitors_[slot].reset();
    }
    shown_ &= ~ended;
  }

  WalkingPaths clipped_ = {};  ///< paths that are clipped together
  KernelLanes clipped_kernel_paths_ = {};
  std::array<WalkingPaths, vectors> lanes_ = {};
  std::array<LaneWalk::Cells, vectors> cells_;  ///< where they stand
  const Query<float>& query_;
  const PathRange<float>& range_;
  RangeWeights<float> weights_;
  LaneWalk walk_;
  PathSpan<float> paths_;
  Finish& finish_;
  const Alone& alone_;
  std::size_t next_ = 0;           ///< the first path that is not clipped yet
  std::size_t clipped_first_ = 0;  ///< the first of `clipped_`,
  std::uint32_t waiting_ = 0;      ///< of `clipped_`, still to be walked
  std::uint64_t walking_ = 0;      ///< slots that hold a path
  std::uint64_t shown_ = 0;        ///< of these, those whose visitors have been shown a triangle
  std::array<std::size_t, max_paths> index_ = {};
  std::array<KernelPath<float>, max_paths> kernel_path_;
  std::array<Visitor, max_paths> visitors_;
  alignas(max_lanes * sizeof(float)) std::array<std::uint32_t, max_paths> words_;  ///< of their cells,
  std::array<TriangleList<float>, max_paths> lists_;                               ///< and of these the lists
  std::array<typename Kernel::Bounds, max_paths> bounds_;                          ///< of the path and its list
  std::array<Job, vectors * max_at_once> jobs_;  ///< each slot has max_at_once / lanes of them at most
  std::array<Open, max_jobs> open_;              ///< of some jobs,
  std::array<Crossing, Visitor::wants_order ? max_jobs : 0> crossings_;  ///< and where their paths cross
};

#endif  // HWY_TARGET != HWY_SCALAR

/// Turns what `FirstHit` kept of the batch's paths into hits, as many at a time as a vector has doubles. What they
/// cannot tell goes through the narrowphase one by one.
class BatchRounding {
 public:
  BatchRounding(const Query<float>& query, const PathRange<float>& range, const PathSpan<float>& paths,
                std::span<Hit<float>> hits)
      : query_(query), range_(range), paths_(paths), hits_(hits) {}

  /// A path that has ended, if it has hit anything.
  HWY_INLINE void add(std::size_t index, FirstHit<float>& first) {
    if (!first.is_found()) return;
    if (first.is_weighed()) {
      const Path<float> path = paths_[index];
      hits_[index] = first.hit(query_, Narrowphase<float>(path, query_.options, range_, query_.statistics));
      return;
    }
    index_[count_] = index;
    entry_[count_] = first.entry();
    t_size_[count_] = first.t_size();
    edge_size_[count_] = first.edge_size();
    static_assert(sizeof(Triangle<float>) == 9 * sizeof(float) && PathSpan<float>::numbers_each == 6);
    // Four numbers at once, one of which is another vector's: the last one, or the first where there is none behind.
    copy(0, paths_.numbers(index), 0);
    copy(1, paths_.numbers(index), 2);
    copy(2, &first.triangle(), 0);
    copy(3, &first.triangle(), 3);
    copy(4, &first.triangle(), 5);
    if (++count_ == hn::Lanes(DoubleTag())) flush();
  }

  HWY_NOINLINE void flush() {
    if (count_ == 0) return;
    const DoubleTag d;
    const FloatTag df;
    const auto vectors = [&](std::size_t which, bool is_behind_another = false) -> Vectors<DoubleTag> {
      hn::Vec<FloatTag> first, second, third, fourth;
      hn::LoadInterleaved4(df, vectors_[which][0].data(), first, second, third, fourth);
      const auto of = [&](const auto& x, const auto& y, const auto& z) -> Vectors<DoubleTag> {
        return {hn::PromoteTo(d, x), hn::PromoteTo(d, y), hn::PromoteTo(d, z)};
      };
      return is_behind_another ? of(second, third, fourth) : of(first, second, third);
    };
    const Vectors<DoubleTag> start = vectors(0);
    Vectors<DoubleTag> direction = vectors(1, true);
    if (paths_.have_ends()) {
      direction = {hn::Sub(direction.x, start.x), hn::Sub(direction.y, start.y), hn::Sub(direction.z, start.z)};
    }
    const auto doubles = [&](const std::array<float, max_hits>& floats) {
      return hn::PromoteTo(d, hn::Load(df, floats.data()));
    };
    const HitIntervals<DoubleTag> intervals(d, start, direction, vectors(2), vectors(3), vectors(4, true),
                                            doubles(t_size_), doubles(edge_size_));
    const RoundedHits<DoubleTag> rounded(d, intervals);
    std::array<float, max_hits> t;
    std::array<float, max_hits> u;
    std::array<float, max_hits> v;
    hn::StoreU(rounded.t, df, t.data());
    hn::StoreU(rounded.u, df, u.data());
    hn::StoreU(rounded.v, df, v.data());
    for (std::size_t i = 0; i < count_; ++i) {
      if ((rounded.rounded >> i & 1) != 0) {
        hits_[index_[i]] = {t[i], u[i], v[i], query_.grid.entries()[entry_[i]],
                            (rounded.front >> i & 1) != 0 ? Side::front : Side::back};
      } else {
        round_alone(i);
      }
    }
    count_ = 0;
  }

 private:
  using DoubleTag = hn::CappedTag<double, 8>;
  using FloatTag = hn::Rebind<float, DoubleTag>;
  /// As many as the widest instruction set of today has doubles.
  static constexpr std::size_t max_hits = 8;

  HWY_INLINE void copy(std::size_t which, const void* numbers, std::size_t from) {
    auto& four = vectors_[which][count_];
    std::memcpy(four.data(), static_cast<const char*>(numbers) + from * sizeof(float), sizeof four);
  }

  HWY_NOINLINE void round_alone(std::size_t i) {
    const Path<float> path = paths_[index_[i]];
    const Narrowphase<float> narrowphase(path, query_.options, range_, query_.statistics);
    const std::uint32_t id = query_.grid.entries()[entry_[i]];
    Candidate<float> candidate{id, query_.mesh.triangle(id), {}};
    if (narrowphase.find_contact(candidate.triangle, candidate.contact)) hits_[index_[i]] = narrowphase.hit(candidate);
  }

  const Query<float>& query_;
  const PathRange<float>& range_;
  PathSpan<float> paths_;
  std::span<Hit<float>> hits_;
  std::size_t count_ = 0;
  /// The path's start and its end or direction, and the triangle's corners, each with one number more. Beyond the last
  /// hit anything finite.
  alignas(max_hits * sizeof(float)) std::array<std::array<std::array<float, 4>, max_hits>, 5> vectors_ = {};
  alignas(max_hits * sizeof(float)) std::array<float, max_hits> t_size_ = {};  ///< what `HitIntervals` goes by besides,
  alignas(max_hits * sizeof(float)) std::array<float, max_hits> edge_size_ = {};  //
  std::array<std::size_t, max_hits> index_;
  std::array<std::size_t, max_hits> entry_;  ///< the one where the id stands, which is on its way into the cache
};

/// Answers all paths: side by side where there are lanes and the grid's frame is one of floats, else one by one.
template <typename Visitor, typename Finish, typename Alone>
HWY_INLINE void answer_each(const Query<float>& query, [[maybe_unused]] const PathRange<float>& range,
                            const PathSpan<float>& paths, [[maybe_unused]] Finish& finish, const Alone& alone) {
  if (query.grid.is_empty()) return;
#if HWY_TARGET != HWY_SCALAR
  if (query.grid.frame().has_floats && !range.is_empty()) {
    Batch<Visitor, Finish, Alone>(query, range, paths, finish, alone).run();
    return;
  }
#endif
  for (std::size_t i = 0; i < paths.size(); ++i) alone(i);
}

inline void find_each_first(const Query<float>& query, const PathSpan<float>& paths, std::span<Hit<float>> hits) {
  std::fill_n(hits.begin(), paths.size(), Hit<float>{});
  if (paths.empty()) return;
  const PathRange<float> range(paths[0], query.options);
  BatchRounding rounding(query, range, paths, hits);
  const auto finish = [&](std::size_t index, FirstHit<float>& first) { rounding.add(index, first); };
  const auto alone = [&](std::size_t index) {
    hits[index] = find_first<float>(query, paths[index]).value_or(Hit<float>{});
  };
  answer_each<FirstHit<float>>(query, range, paths, finish, alone);
  rounding.flush();
}

inline void find_each_any(const Query<float>& query, const PathSpan<float>& paths, std::span<std::uint8_t> blocked) {
  std::fill_n(blocked.begin(), paths.size(), std::uint8_t{0});
  if (paths.empty()) return;
  const PathRange<float> range(paths[0], query.options);
  const auto finish = [&](std::size_t index, const AnyHit<float>& any) { blocked[index] = any.is_done() ? 1 : 0; };
  const auto alone = [&](std::size_t index) { blocked[index] = find_any<float>(query, paths[index]) ? 1 : 0; };
  answer_each<AnyHit<float>>(query, range, paths, finish, alone);
}

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
