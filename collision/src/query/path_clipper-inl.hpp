// Clips the paths of a batch side by side. Highway compiles this file for each instruction set.

#if defined(SUREHIT_PATH_CLIPPER_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_PATH_CLIPPER_INL
#undef SUREHIT_PATH_CLIPPER_INL
#else
#define SUREHIT_PATH_CLIPPER_INL
#endif

#include <hwy/highway.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "filter/kernel_lanes-inl.hpp"
#include "filter/kernel_path.hpp"
#include "path_range.hpp"
#include "surehit/path_span.hpp"
#include "walk/far_lanes-inl.hpp"
#include "walk/lane_clip-inl.hpp"
#include "walk/lane_walk-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// Copies paths of a batch side by side in double, with their ranges. `lanes` tells which, from path `first` on.
/// Returns those whose range is not empty.
template <typename Scalar, typename Queries>
HWY_INLINE std::uint32_t copy_in_double(const Queries& queries, const PathSpan<Scalar>& paths, std::size_t first,
                                        std::uint32_t lanes, LaneClip::DoublePaths& copies) {
  std::uint32_t taken = 0;
  for (std::uint32_t left = lanes; left != 0; left &= left - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(left));
    const auto range = queries.range(first + lane);
    if (range.is_empty()) continue;
    taken |= std::uint32_t{1} << lane;
    std::array<Scalar, 6> numbers;
    paths.copy(first + lane, numbers.data());
    for (std::size_t axis = 0; axis < 3; ++axis) {
      copies.start[axis][lane] = numbers[axis];
      copies.toward[axis][lane] = numbers[3 + axis];
    }
    copies.first_t[lane] = range.first;
    copies.last_t[lane] = range.last;
  }
  return taken;
}

/// Returns those of some lanes whose path may meet what is not in the main grid (L18).
HWY_INLINE std::uint32_t lanes_beside(const MainGrid& main, const LaneClip::DoublePaths& paths, PathKind kind,
                                      std::uint32_t lanes) {
  std::uint32_t beside = 0;
  for (std::size_t from = 0; lanes >> from != 0; from += hn::Lanes(DoublePathLanes::Tag())) {
    beside |= lanes_beside(main, DoublePathLanes(paths, kind == PathKind::segment, from)) << from;
  }
  return beside & lanes;
}

/// Clips the paths of a batch to a frame of the grid: the outermost one, or that of the main grid. It clips as many at
/// a time as a vector has lanes. `Queries` is `SharedQuery`, `OwnQueries` or `PlacedQueries`.
template <typename Scalar, typename Queries>
class PathClipper {
 public:
  PathClipper(const GridFrame& frame, const Queries& queries, const PathSpan<Scalar>& paths)
      : queries_(queries), frame_(frame), paths_(paths) {}

  /// Clips `count` paths, one in each lane. The first of them is path `first`.
  HWY_INLINE LaneClip::Clipped clip(std::size_t first, std::size_t count) {
    first_ = first;
    if constexpr (is_float) {
      if (paths_.is_packed() && count == hn::Lanes(FloatTag())) return clip_numbers(paths_.packed(first), count);
      // All lanes are read.
      std::array<float, path_size* max_lanes> copies = {};
      for (std::size_t i = 0; i < count; ++i) paths_.copy(first + i, &copies[path_size * i]);
      return clip_numbers(copies.data(), count);
    } else {
      return clip_doubles(count);
    }
  }

  /// Returns the walks of the paths that were clipped.
  [[nodiscard]] WalkingPaths& walks() { return clipped_; }

  /// Gives the path of lane `from` to lane `to` of those that walk. It calls `enter(to, index, parameter)`, which
  /// returns where its KernelPath goes. The parameter is that of the walk: for paths of doubles a `WalkParameter`, for
  /// paths of floats what `WalkingPaths::enters` leaves out. If the KernelPath begins at a point to which the start was
  /// moved, it also calls `move_start(to, moved_t, is_end, reach)`. The reach is that from the path's own start. For a
  /// placed path, it calls `move_start(to, moved_t)`.
  template <typename Enter, typename MoveStart>
  HWY_INLINE void give(std::size_t from, std::size_t to, const Enter& enter, const MoveStart& move_start) const {
    if constexpr (is_float) {
      kernel_paths_.copy(from, enter(to, first_ + from, enters_rest_[from]));
    } else {
      enter(to, first_ + from, taus_[from]) = KernelPath<Scalar>(paths_[first_ + from], frame_);
    }
    if constexpr (Queries::is_placed) {
      move_start(to, placer_.moved_t(from));
    } else if constexpr (is_float) {
      if ((far_.free >> from & 1) != 0) [[unlikely]] {
        move_start(to, far_.moved_t[from], (far_.ends >> from & 1) != 0, kernel_paths_.reach_from_start(from));
      }
    }
  }

 private:
  static constexpr bool is_float = std::is_same_v<Scalar, float>;
  static constexpr std::size_t path_size = 6;  ///< The number of scalars of a path.
  using LaneDoubles = std::array<double, max_lanes>;

  /// Clips paths of floats that lie side by side. `numbers` must be readable for all lanes.
  HWY_NOINLINE LaneClip::Clipped clip_numbers(const float* numbers, std::size_t count) {
    if constexpr (Queries::is_placed) {
      return placer_.clip(numbers, count, clip_, clipped_, kernel_paths_, enters_rest_);
    }
    const auto ends = queries_.ends(first_, count);
    enters_rest_ = {};
    const LaneClip::Clipped clipped =
        clip_.clip(numbers, paths_.kind() == PathKind::segment, ends.first, ends.last, count, clipped_, kernel_paths_);
    far_.free = 0;
    if (is_main_) return clip_to_main(numbers, count, clipped);
    if (!can_clip_in_float_) return clip_apart({0, static_cast<std::uint32_t>((std::uint64_t{1} << count) - 1)});
    return clipped.apart == 0 ? clipped : clip_from_afar(numbers, count, clipped);
  }

  /// Clips paths of floats to the main grid. Those that may meet something beside it stay apart (L18).
  HWY_NOINLINE LaneClip::Clipped clip_to_main(const float* numbers, std::size_t count, LaneClip::Clipped result) {
    const auto ends = queries_.ends(first_, count);
    const PathLanes paths(numbers, paths_.kind() == PathKind::segment, ends.first, ends.last);
    const auto all = static_cast<std::uint32_t>((std::uint64_t{1} << count) - 1);
    const std::uint32_t others = lanes_beside(queries_.of_batch().grid.main_grid(), paths) & all;
    result = {result.inside & ~others, result.apart & ~others};
    if (result.apart != 0) result = clip_from_afar(numbers, count, result);
    return {result.inside, result.apart | others};
  }

  /// Clips the paths of floats that do not begin near the grid, or are very slow or fast.
  HWY_NOINLINE LaneClip::Clipped clip_from_afar(const float* numbers, std::size_t count, LaneClip::Clipped result) {
    const auto ends = queries_.ends(first_, count);
    const PathLanes paths(numbers, paths_.kind() == PathKind::segment, ends.first, ends.last);
    const auto far = far_.template clip<LaneClip::Clipped>(frame_, paths, result.apart, clipped_, kernel_paths_);
    if (far.inside != 0) enters_rest_ = far_.enters_rest;
    const LaneClip::Clipped all = {result.inside | far.inside, far.apart};
    return all.apart == 0 ? all : clip_apart(all);
  }

  /// Clips the paths of floats that the lanes could not clip in float. Those that must be scaled, or that are too far
  /// away, stay apart.
  HWY_NOINLINE LaneClip::Clipped clip_apart(LaneClip::Clipped result) {
    LaneDoubles enters;
    LaneClip::DoublePaths copies = {};
    const std::uint32_t taken = copy_in_double(queries_, paths_, first_, result.apart, copies);
    const LaneClip::Clipped clipped = clip_.clip_in_double(copies, paths_.kind(), taken, clipped_, enters);
    for (std::uint32_t inside = clipped.inside; inside != 0; inside &= inside - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(inside));
      enters_rest_[lane] = LaneWalk::rest_of_enters(enters[lane]);
    }
    return {result.inside | clipped.inside, clipped.apart};
  }

  /// Clips `count` paths of doubles. They walk in float, like all paths.
  HWY_NOINLINE LaneClip::Clipped clip_doubles(std::size_t count) {
    LaneDoubles enters;
    LaneClip::DoublePaths copies = {};
    const auto all = static_cast<std::uint32_t>((std::uint64_t{1} << count) - 1);
    const std::uint32_t taken = copy_in_double(queries_, paths_, first_, all, copies);
    const std::uint32_t others =
        is_main_ ? lanes_beside(queries_.of_batch().grid.main_grid(), copies, paths_.kind(), taken) : 0;
    LaneClip::Clipped result = clip_.clip_in_double(copies, paths_.kind(), taken & ~others, clipped_, enters);
    for (std::uint32_t inside = result.inside; inside != 0; inside &= inside - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(inside));
      taus_[lane] = {{1, 1, 1}, {0, 0, enters[lane]}};
    }
    for (std::uint32_t apart = std::exchange(result.apart, 0); apart != 0; apart &= apart - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(apart));
      const auto range = queries_.range(first_ + lane);
      const Path<Scalar> path = paths_[first_ + lane];
      const ClippedPath clipped(frame_, path, range.first, range.last);
      if (clipped.status == ClippedPath::Status::too_far) result.apart |= std::uint32_t{1} << lane;
      if (clipped.status != ClippedPath::Status::clipped) continue;
      result.inside |= std::uint32_t{1} << lane;
      LaneWalk::put(lane, frame_, clipped, clipped_);
      taus_[lane] = clipped.tau;
    }
    result.apart |= others;
    return result;
  }

  /// Takes the place of what only paths of floats or of doubles have.
  template <int>
  struct None {};

  WalkingPaths clipped_ = {};  ///< The last paths that were clipped, one in each lane.
  /// The same paths for the kernel. Those of doubles are made when they begin to walk.
  [[no_unique_address]] std::conditional_t<is_float, KernelLanes, None<2>> kernel_paths_ = {};
  /// What `WalkingPaths::enters` leaves out of the t where tau is 0, for paths of floats.
  LaneFloats enters_rest_ = {};
  /// The paths of floats that do not begin near the grid.
  [[no_unique_address]] std::conditional_t<is_float, FarLanes, None<0>> far_;
  /// The parameters of their walks, for paths of doubles.
  [[no_unique_address]] std::conditional_t<is_float, None<1>, std::array<WalkParameter, max_lanes>> taus_;
  const Queries& queries_;                                           ///< The queries of the paths.
  [[no_unique_address]] typename Queries::Placer placer_{queries_};  ///< Brings placed paths into the frame of a mesh.
  const GridFrame& frame_;                                           ///< The frame that the paths are clipped to.
  const LaneClip clip_{frame_};
  const bool is_main_ = &frame_ != &queries_.of_batch().grid.frame();  ///< True if it is that of the main grid.
  /// True if floats hold the numbers of the grid's frame. Else `LaneClip::clip` only sets the paths of the kernel.
  const bool can_clip_in_float_ = frame_.has_floats;
  const PathSpan<Scalar>& paths_;  ///< All paths of the batch.
  std::size_t first_ = 0;          ///< The index of the path in lane 0 of `clipped_`.
};

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
