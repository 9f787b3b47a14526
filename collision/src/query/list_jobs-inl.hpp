// Prepares the lists that paths have come to for the kernel. Highway compiles this file for each instruction set.

#if defined(SUREHIT_LIST_JOBS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_LIST_JOBS_INL
#undef SUREHIT_LIST_JOBS_INL
#else
#define SUREHIT_LIST_JOBS_INL
#endif

#include <hwy/cache_control.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "filter/block_kernel-inl.hpp"
#include "query/batch_queries-inl.hpp"
#include "query/far_path.hpp"
#include "query/hit_visitors-inl.hpp"
#include "query/octet_boxes-inl.hpp"
#include "walk/lane_walk-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// The lists that the paths of a batch have come to, cut into jobs. A job is as many triangles of one list as the
/// kernel takes at once. The kernel runs over many jobs before any verdict is used, because a processor can predict
/// neither the length of a list nor a verdict.
template <typename Scalar, typename Visitor, std::size_t slots = max_slots<Scalar>>
class ListJobs {
  using Kernel = typename Visitor::Kernel;
  /// The number of lanes of the kernel, at most that of the widest vectors of today.
  static constexpr std::size_t kernel_lanes = std::min(hn::MaxLanes(hn::ScalableTag<Scalar>()), 64 / sizeof(Scalar));
  static constexpr bool may_move = std::is_same_v<Scalar, float>;  ///< Starts of paths of doubles are not moved.

 public:
  /// The maximum number of triangles of a list that become jobs before their verdicts are used. It is lower if any hit
  /// is enough, because the rest of a list is often not needed then.
  static constexpr std::size_t max_at_once = Visitor::wants_order ? 64 : 32;
  static_assert(max_at_once % kernel_lanes == 0);
  /// The maximum number of jobs of one call of `classify`. More would take stack.
  static constexpr std::size_t max_jobs = 256 / kernel_lanes;

  /// A job with triangles that the path of its slot may meet.
  struct Open {
    std::size_t slot;          ///< The slot of the path.
    std::size_t from;          ///< The index in the list of the triangle in lane 0.
    Verdicts verdicts;         ///< The verdicts of the kernel.
    FirstLanes<Scalar> first;  ///< The hits that may be first. It is set only if the visitor wants an order.
  };

  /// The paths of the slots have the weights of these queries.
  template <typename Queries>
  explicit ListJobs(const Queries& queries) {
    for (std::size_t slot = 0; slot < slots; ++slot) weights_[slot] = &queries.weights_in(slot);
  }

  /// Notes that the path of a slot begins at a point to which its start was moved, as a `FarPath` does.
  void move_start(std::size_t slot, double moved_t, bool is_end, Scalar reach_from_start) {
    moved_ |= std::uint64_t{1} << slot;
    moved_t_[slot] = moved_t;
    own_reach_[slot] = reach_from_start;
    weights_[slot] = &moved_weights_[is_end ? 1 : 0];
  }
  /// Notes the same for a placed path. Its query knows the weights of its range.
  void move_start(std::size_t slot, double moved_t) {
    moved_ |= std::uint64_t{1} << slot;
    moved_t_[slot] = moved_t;
    own_reach_[slot] = 0;
  }
  /// Returns whether the start of the path of a slot was moved.
  [[nodiscard]] bool is_moved(std::size_t slot) const { return (moved_ >> slot & 1) != 0; }
  /// Forgets which of these slots have paths whose start was moved.
  template <typename Queries>
  HWY_INLINE void forget_moved(std::uint64_t of_slots, const Queries& queries) {
    for (std::uint64_t moved = moved_ & of_slots; moved != 0; moved &= moved - 1) {
      const auto slot = static_cast<std::size_t>(std::countr_zero(moved));
      weights_[slot] = &queries.weights_in(slot);
    }
    moved_ &= ~of_slots;
  }
  /// Returns the reach of the path of a slot from its own start, which may be farther away than that of the kernel.
  [[nodiscard]] Scalar reach_from_start(std::size_t slot) const {
    if constexpr (may_move) {
      if (is_moved(slot)) return own_reach_[slot];
    }
    return kernel_path_[slot].reach;
  }

  /// Returns the path of a slot, which the caller sets.
  [[nodiscard]] KernelPath<Scalar>& path(std::size_t slot) { return kernel_path_[slot]; }
  /// Returns the list of a slot.
  [[nodiscard]] const TriangleList<Scalar>& list(std::size_t slot) const { return lists_[slot]; }

  /// Finds the list of the cell of a slot, and asks for its memory. `load_bounds` must follow.
  HWY_INLINE void find_list(std::size_t slot, const Query<Scalar>& query, CellWord word) {
    TriangleList<Scalar>& list = lists_[slot];
    list.first_entry = query.grid.first_entry(word);
    list.count = query.grid.entry_count(word);
    list.corners = MeshBlocks<Scalar>::corners(query.mesh.block(word.list(), list.first_entry));
    prefetch(list);
    if constexpr (requires { Visitor::passes_over_octets; }) {
      list.boxes = boxes_of(query.mesh, list.first_entry, list.count);
      if (list.boxes != nullptr) prefetch_boxes(list);
    }
    query.statistics.candidates += list.count;
  }
  /// Computes the bounds of the paths of these slots with the lists that were found. Only this reads the memory of the
  /// lists. So a processor waits for many of them at once.
  HWY_INLINE void load_bounds(std::uint64_t of_slots) {
    for (; of_slots != 0; of_slots &= of_slots - 1) {
      const auto slot = static_cast<std::size_t>(std::countr_zero(of_slots));
      TriangleList<Scalar>& list = lists_[slot];
      list.edge_size = MeshBlocks<Scalar>::edge_size_of(list.corners);
      bounds_[slot] = Kernel::bounds(kernel_path_[slot], *weights_[slot], list);
    }
  }

  /// Makes jobs from up to `max_at_once` triangles of the slot's list. The first one is triangle `from`. There were
  /// `count` jobs before. Returns true if the list has more triangles after these. The caller keeps the count in a
  /// register for many lists, and then calls `set_count`.
  HWY_INLINE bool add(std::size_t slot, std::size_t from, std::size_t& count) {
    const std::size_t lanes = hn::Lanes(hn::ScalableTag<Scalar>());
    const std::size_t left = lists_[slot].count - from;
    for (std::size_t i = 0; i < max_at_once; i += lanes) {
      jobs_[count + i / lanes] = {static_cast<std::uint16_t>(slot), static_cast<std::uint16_t>(i)};
    }
    count += (std::min(left, max_at_once) + lanes - 1) / lanes;
    return left > max_at_once;
  }
  /// Does the same, but passes over the octets that the path misses between the parameters `first` and `last`. The list
  /// must have boxes, and `load_bounds` must have read it.
  HWY_INLINE bool add_met(std::size_t slot, std::size_t from, Scalar first, Scalar last, std::size_t& count) {
    const std::size_t lanes = hn::Lanes(hn::ScalableTag<Scalar>());
    const std::size_t left = lists_[slot].count - from;
    const std::uint64_t octets = octets_met(kernel_path_[slot], lists_[slot], from, first, last);
    for (std::size_t i = 0; i < std::min(left, max_at_once); i += lanes) {
      jobs_[count] = {static_cast<std::uint16_t>(slot), static_cast<std::uint16_t>(i)};
      count += (octets >> i / MeshBlocks<Scalar>::octet & octets_of_lanes(lanes)) != 0 ? 1 : 0;
    }
    return left > max_at_once;
  }
  /// Returns whether `add_met` may be called for the list of a slot. A path that was moved is not exactly the kernel's.
  [[nodiscard]] bool has_boxes(std::size_t slot) const { return lists_[slot].boxes != nullptr && !is_moved(slot); }

  /// Returns the number of jobs.
  [[nodiscard]] std::size_t count() const { return count_; }
  void set_count(std::size_t count) { count_ = count; }

  /// Runs the kernel over up to `max_jobs` jobs, from job `first_job` on. `from` must be that of `add`. Returns the
  /// jobs whose path may meet a triangle. The next call overwrites them.
  template <typename Visitors>
  HWY_NOINLINE std::span<const Open> classify(std::size_t first_job, std::size_t from, const Visitors& visitors) {
    const hn::ScalableTag<Scalar> d;
    const auto some = std::span(jobs_).subspan(first_job, std::min(count_ - first_job, max_jobs));
    std::size_t open = 0;
    for (const Job& job : some) {
      const std::size_t first_triangle = from + job.from;
      const Kernel kernel(kernel_path_[job.slot], lists_[job.slot], first_triangle);
      const Verdicts verdicts = kernel.classify(*weights_[job.slot], bounds_[job.slot]);
      Open& next = open_[open];
      next.slot = job.slot;
      next.from = first_triangle;
      next.verdicts = verdicts;
      if constexpr (Visitor::wants_order) {
        const typename Kernel::Crossing crossing = kernel.crossing();
        hn::Store(crossing.height, d, crossings_[open].height.data());
        hn::Store(crossing.det, d, crossings_[open].det.data());
      }
      open += verdicts.possible != 0 ? 1 : 0;
    }
    if constexpr (Visitor::wants_order) {
      for (std::size_t i = 0; i < open; ++i) locate_first(i, visitors);
    }
    return std::span(open_).first(open);
  }

 private:
  /// As many triangles of a list as the kernel takes at once.
  struct Job {
    std::uint16_t slot;  ///< The slot of the path.
    std::uint16_t from;  ///< The index of the first triangle, minus the `from` of `add`.
  };
  /// A `BlockKernel::Crossing` in memory.
  struct alignas(kernel_lanes * sizeof(Scalar)) Crossing {
    std::array<Scalar, kernel_lanes> height;  ///< The height of each lane.
    std::array<Scalar, kernel_lanes> det;     ///< The det of each lane.
  };

  /// Locates the certain hits of an open job that may be the first one.
  template <typename Visitors>
  HWY_INLINE void locate_first(std::size_t i, const Visitors& visitors) {
    const hn::ScalableTag<Scalar> d;
    const auto& [height, det] = crossings_[i];
    auto& [slot, from, verdicts, first] = open_[i];
    if (verdicts.certain == verdicts.possible && std::has_single_bit(verdicts.certain)) [[likely]] {
      const auto lane = static_cast<std::size_t>(std::countr_zero(verdicts.certain));
      first = Kernel::first_of_one(bounds_[slot], height[lane], det[lane], verdicts.certain);
    } else {
      Scalar limit = visitors[slot].t_upper();
      if constexpr (may_move) {
        if (is_moved(slot)) limit = MovedParameter{moved_t_[slot]}.limit(limit);
      }
      first = Kernel::first_of(bounds_[slot], {hn::Load(d, height.data()), hn::Load(d, det.data())}, verdicts.certain,
                               limit);
    }
    if constexpr (may_move) {
      if (is_moved(slot) && verdicts.certain != 0) MovedParameter{moved_t_[slot]}.set(first);
    }
  }

  /// Fetches the beginning of a list into the cache. If the list is short, it also fetches what lies after it. More
  /// lines would cost more than they save. A single path does not prefetch, because it needs the list at once.
  static void prefetch(const TriangleList<Scalar>& list) {
    constexpr std::size_t lines = 4;
    constexpr std::size_t line = 64 / sizeof(Scalar);
    for (std::size_t from = 0; from < lines * line; from += line) hwy::Prefetch(list.corners + from);
  }

  /// Fetches the boxes of a list that has about as many triangles as most long ones.
  static void prefetch_boxes(const TriangleList<Scalar>& list) {
    constexpr std::size_t lines = 3;
    constexpr std::size_t line = 64 / sizeof(Scalar);
    for (std::size_t from = 0; from < lines * line; from += line) hwy::Prefetch(list.boxes + from);
  }

  std::array<KernelPath<Scalar>, slots> kernel_path_;         ///< The path of each slot.
  std::array<const RangeWeights<Scalar>*, slots> weights_;    ///< The weights of its range for the kernel.
  std::array<TriangleList<Scalar>, slots> lists_;             ///< The list that the path has come to.
  std::array<typename Kernel::Bounds, slots> bounds_;         ///< The bounds of the path and the list.
  std::array<Job, slots * max_at_once / kernel_lanes> jobs_;  ///< Each slot has at most max_at_once / lanes jobs.
  std::size_t count_ = 0;                                     ///< The number of jobs.
  std::uint64_t moved_ = 0;                                   ///< The slots whose path has a start that was moved.
  std::array<double, may_move ? slots : 0> moved_t_;          ///< The t by which it was moved.
  std::array<Scalar, may_move ? slots : 0> own_reach_;        ///< The reach from its own start.
  /// The weights of paths whose start was moved. The second ones are for segments that count up to their end.
  std::array<RangeWeights<float>, 2> moved_weights_ = {RangeWeights<float>(FarPath::kernel_range(false)),
                                                       RangeWeights<float>(FarPath::kernel_range(true))};
  std::array<Open, max_jobs> open_;                                      ///< The open jobs of the last call.
  std::array<Crossing, Visitor::wants_order ? max_jobs : 0> crossings_;  ///< The crossings of `open_`.
};

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
