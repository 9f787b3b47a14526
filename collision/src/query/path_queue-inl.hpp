// Holds the paths of a batch that wait for a lane. Highway compiles this file for each instruction set.

#if defined(SUREHIT_PATH_QUEUE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_PATH_QUEUE_INL
#undef SUREHIT_PATH_QUEUE_INL
#else
#define SUREHIT_PATH_QUEUE_INL
#endif

#include <hwy/cache_control.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "query/path_clipper-inl.hpp"
#include "surehit/path_span.hpp"
#include "walk/lane_clip-inl.hpp"
#include "walk/lane_walk-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// The paths of a batch that do not walk yet. It lets a `PathClipper` clip some of them when lanes are idle, and calls
/// `alone(index)` for each path that no lane can walk.
template <typename Scalar, typename Queries, typename Alone>
class PathQueue {
 public:
  /// The paths are clipped to a frame of the grid: the outermost one, or that of the main grid.
  PathQueue(const LaneWalk& walk, const GridFrame& frame, const Queries& queries, const PathSpan<Scalar>& paths,
            const Alone& alone)
      : walk_(walk), queries_(queries), paths_(paths), clipper_(frame, queries, paths), alone_(alone) {
    walk_.set_stops(clipper_.walks());
  }

  /// Puts waiting paths into idle lanes, and returns the lanes that it filled. It calls the two functions for each of
  /// them, as `PathClipper::give` does.
  template <typename Enter, typename MoveStart>
  HWY_INLINE std::uint32_t fill(std::uint32_t idle, WalkingPaths& lanes, const Enter& enter,
                                const MoveStart& move_start) {
    std::uint32_t all_filled = 0;
    while (idle != 0) {
      if (waiting_ == 0 && !clip_next()) break;
      alignas(max_lanes * sizeof(float)) LaneIndices from_lane = {};
      std::uint32_t filled = 0;
      for (; waiting_ != 0 && idle != 0; waiting_ &= waiting_ - 1, idle &= idle - 1) {
        const auto from = static_cast<std::size_t>(std::countr_zero(waiting_));
        const auto to = static_cast<std::size_t>(std::countr_zero(idle));
        from_lane[to] = static_cast<std::int32_t>(from);
        clipper_.give(from, to, enter, move_start);
        filled |= std::uint32_t{1} << to;
      }
      lanes.copy(filled, clipper_.walks(), from_lane);
      all_filled |= filled;
    }
    return all_filled;
  }

 private:
  static constexpr std::size_t path_size = 6;               ///< The number of scalars of a path.
  static constexpr std::size_t paths_ahead = 64;            ///< Paths are prefetched this many paths ahead.
  static constexpr std::size_t line = 64 / sizeof(Scalar);  ///< The number of scalars in a cache line.

  /// Clips the next paths until one of them can walk. Returns false if none is left.
  HWY_INLINE bool clip_next() {
    const std::size_t lanes = hn::Lanes(FloatTag());
    while (next_ < paths_.size()) {
      first_ = next_;
      const std::size_t count = std::min(lanes, paths_.size() - next_);
      next_ += count;
      prefetch(next_ + paths_ahead);
      const LaneClip::Clipped clipped = clipper_.clip(first_, count);
      queries_.of_batch().statistics.paths += count - static_cast<std::size_t>(std::popcount(clipped.apart));
      for (std::uint32_t apart = clipped.apart; apart != 0; apart &= apart - 1) {
        alone_(first_ + static_cast<std::size_t>(std::countr_zero(apart)));
      }
      waiting_ = leave_empty_space(clipped.inside);
      if (waiting_ != 0) return true;
    }
    return false;
  }

  /// Fetches into the cache as many paths as are clipped together. The first of them is path `first`. The processor
  /// does not fetch them by itself, because the program reads much else in the meantime.
  HWY_INLINE void prefetch(std::size_t first) const {
    const std::size_t lanes = hn::Lanes(FloatTag());
    if (first + lanes > paths_.size() || !is_packed_) return;
    const Scalar* const numbers = paths_.packed(first);
    for (std::size_t from = 0; from < path_size * lanes; from += line) hwy::Prefetch(numbers + from);
  }

  /// Makes one step with each clipped path that begins in an empty cell. Most short paths end with this step. Returns
  /// the lanes that still walk.
  HWY_INLINE std::uint32_t leave_empty_space(std::uint32_t inside) {
    const LaneWalk::Cells cells = walk_.look(clipper_.walks(), inside);
    const std::uint32_t leaving = inside & ~LaneWalk::in_lists(cells, inside);
    queries_.of_batch().statistics.cells += static_cast<std::uint64_t>(std::popcount(leaving));
    return (inside & ~leaving) | walk_.advance(cells, leaving, clipper_.walks());
  }

  const LaneWalk& walk_;
  const Queries& queries_;                     ///< The queries of the paths.
  const PathSpan<Scalar>& paths_;              ///< All paths of the batch.
  PathClipper<Scalar, Queries> clipper_;       ///< Clips the next ones.
  const bool is_packed_ = paths_.is_packed();  ///< True if paths can be read in place.
  const Alone& alone_;                         ///< Answers a path that no lane can walk.
  std::size_t next_ = 0;                       ///< The index of the first path that is not clipped yet.
  std::size_t first_ = 0;                      ///< The index of the first path that the clipper has.
  std::uint32_t waiting_ = 0;                  ///< The lanes of the clipper whose paths wait.
};

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
