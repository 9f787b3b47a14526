#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "grid/grid.hpp"
#include "support/double4.hpp"
#include "support/inlining.hpp"
#include "surehit/path.hpp"
#include "walk/direction.hpp"

#if defined(__FAST_MATH__)
#error "surehit's walk does not hold under -ffast-math: leave this header to the library, whose sources are without it"
#endif

namespace surehit {

/// The walk's parameter: tau is t unit[0] unit[1] unit[2] - origin[0] - origin[1] - origin[2].
struct WalkParameter {
  std::array<double, 3> unit;    ///< Their product is the tau per unit of t. One double may not hold it.
  std::array<double, 3> origin;  ///< Their sum is subtracted.

  /// Returns tau at t, rounded up (L12).
  [[nodiscard]] float beyond(double t) const noexcept;
};

/// A path that is known up to errors, and whose start was moved along it: start + (t - moved_t) direction. An instance
/// of a scene is met by such a path, in the frame of its mesh.
struct MovedPath {
  detail::Double4 start;           ///< The point at t = `moved_t`.
  detail::Double4 direction;       ///< The way from there to the point at `moved_t` + 1.
  detail::Double4 position_error;  ///< Inside the mesh's box, no point is off by more than this.
  double moved_t = 0;              ///< The t by which the start was moved.

  /// Returns true if the errors are so small that the walk through this frame misses nothing (L15).
  [[nodiscard]] bool is_precise_in(const GridFrame& frame) const noexcept;
};

/// A path as the grid sees it: clipped to the grid, counted in finest cells, and mirrored so that it rises on every
/// axis. It holds plain floats, so that the lanes of a vector can take them. The proof of the walk, with its lemmas L1
/// to L12, is in WALK.md.
struct ClippedPath {
  /// What became of the path.
  enum class Status : std::uint8_t {
    miss,     ///< The path misses the grid.
    clipped,  ///< The path can be walked.
    too_far,  ///< The path starts too far away to be clipped (L10). It must be tested against all triangles.
  };

  /// A ray or line that is slower than this on all axes, in cells a unit of t, is scaled (L11).
  static constexpr float slow = 0x1p-20F;
  /// A path that is faster than this on some axis is clipped in double.
  static constexpr float fast = 0x1p20F;
  /// A path that is faster than this on some axis is scaled.
  static constexpr double too_fast = 0x1p60;
  /// A start at most this many widths from the grid's low corner, on each axis, need not be moved (L9).
  static constexpr double far_widths = 0x1p20;
  /// A ray or line whose start is farther than it moves in so many units of t is scaled (L11).
  static constexpr double max_t_to_grid = 0x1p38;
  /// A lower rate counts as 0, because it moves the path by less than 2^-27 cells (L11).
  static constexpr float min_rate = 0x1p-66F;
  /// The inverse of a rate of 0. It puts all crossings beyond every tau that counts (L1).
  static constexpr float max_inverse = 0x1p100F;

  Status status = Status::miss;      ///< The result of the clipping.
  bool is_clipped_in_float = false;  ///< If true, the walk's tau is t - tau.origin[2].
  std::uint32_t octant = 0;          ///< Bit k is set if the path is mirrored on axis k.
  detail::Float4 start;              ///< The position where the walk begins, where tau is 0.
  detail::Float4 rate;               ///< The number of finest cells per unit of tau.
  detail::Float4 inverse_rate;       ///< 1 / rate, or `max_inverse` where the rate is 0.
  float end = 0;                     ///< Beyond this tau nothing counts (L12).
  float exit = 0;                    ///< The tau at which the path leaves the grid, rounded.
  WalkParameter tau;                 ///< Only `origin[2]` is set if the path is clipped in float.

  /// Returns a mask of the axes on which the path is mirrored.
  SUREHIT_ALWAYS_INLINE [[nodiscard]] detail::Int4 is_mirrored() const noexcept {
    using namespace detail;
    return (all_lanes(static_cast<std::int32_t>(octant)) & Int4{1, 2, 4, 0}) != all_lanes(0);
  }

  /// Clips a path to a grid that is not empty. [first_t, last_t] is the part that counts; either end may be infinite. A
  /// path that is not finite misses the grid. The caller must hold a FloatingPointEnvironment.
  template <typename Scalar>
  ClippedPath(const GridFrame& frame, const Path<Scalar>& path, double first_t, double last_t) noexcept;
  /// Clips a path to the outermost grid. Every path misses a grid without cells.
  template <typename Scalar>
  ClippedPath(const Grid& grid, const Path<Scalar>& path, double first_t, double last_t) noexcept;
  /// Clips a moved path to a grid that is not empty. Its numbers must be finite. It is too far if it is not precise.
  ClippedPath(const GridFrame& frame, const MovedPath& path, double first_t, double last_t) noexcept {
    if (!try_clip_in_float(frame, path, first_t, last_t)) clip_in_double(frame, path, first_t, last_t);
  }
  ClippedPath() = default;

  /// What `clip_in_float` has done.
  enum class InFloat : std::uint8_t {
    done,  ///< The path is clipped, or it misses the grid.
    far,   ///< The path does not begin near the grid. `start` is its start, and the rates and the octant are set.
    none,  ///< The path must be clipped in double.
  };
  /// Clips a path that begins near the grid, in float (L8).
  InFloat clip_in_float(const GridFrame& frame, const Path<float>& path, float first_t, float last_t) noexcept;

  /// Returns true if tau is t less the last origin.
  [[nodiscard]] bool is_unscaled() const noexcept {
    const std::array<double, 3> one = {1, 1, 1};
    return is_clipped_in_float || (tau.unit == one && tau.origin[0] == 0 && tau.origin[1] == 0);
  }
  /// Returns true if the path meets nothing, because it ends in the cube of empty cells in which it begins (L6). Most
  /// short paths do. The path must be clipped. If it begins in a cell with a list, the word of its last cell is
  /// prefetched.
  SUREHIT_ALWAYS_INLINE [[nodiscard]] bool stays_in_empty_space(const Grid& grid,
                                                                const GridFrame& frame) const noexcept {
    using namespace detail;
    const CellWord* const top = grid.all_top().data();
    const auto shift = static_cast<std::int32_t>(2 * grid.levels());
    const Int4 first = to_int(start) >> shift;
    const Int4 last = to_int(start + std::min(end, exit) * rate) >> shift;
    const GridFrame::TopOrder& order = frame.top_orders[octant];
    const CellWord word = top[order.index(first)];
    if (!word.is_empty()) {
      // Most short paths go through one more cell, the last one. Without a prefetch the walk would wait for its word.
      const Int4 stop = to_int(frame.float_stop) >> shift;
      const Int4 end_cell = min(max(last, first), stop - 1);
      prefetch(&top[order.index(end_cell)]);
      return false;
    }
    const auto cells = static_cast<std::int32_t>(word.distance(octant));
    return !any_lane(last - first >= all_lanes(cells));
  }

  /// Returns tau at t, rounded up (L12).
  SUREHIT_ALWAYS_INLINE [[nodiscard]] float beyond(double t) const noexcept {
    return is_clipped_in_float ? beyond(t, tau.origin[2]) : tau.beyond(t);
  }
  /// Returns tau at t, rounded up, where tau is t - `enters`.
  [[nodiscard]] static float beyond(double t, double enters) noexcept {
    const double exact = t - enters;
    const double rounding = (std::fabs(t) + std::fabs(enters)) * 0x1p-50 + std::fabs(exact) * 0x1p-22 + 0x1p-140;
    return static_cast<float>(exact + rounding);
  }

 private:
  /// Clips a path to a frame.
  template <typename Scalar>
  void clip(const GridFrame& frame, const Path<Scalar>& path, double first_t, double last_t) noexcept;
  /// Clips any path in double (L9).
  template <typename Scalar>
  void clip_in_double(const GridFrame& frame, const Path<Scalar>& path, double first_t, double last_t) noexcept;
  /// Clips the path from + tau by, in the scaled frame. `tau` is set but for its last origin.
  void clip_scaled(const GridFrame& frame, std::array<double, 3>& from, std::array<double, 3>& by, double first_t,
                   double last_t) noexcept;
  /// Clips a moved path in float (L15). Returns false if it must be clipped in double.
  bool try_clip_in_float(const GridFrame& frame, const MovedPath& path, double first_t, double last_t) noexcept;
  /// Clips a moved path in double (L15).
  void clip_in_double(const GridFrame& frame, const MovedPath& path, double first_t, double last_t) noexcept;
  /// Clips the path at + tau move, in cells (L8). The range is that of tau. If `is_short`, the path may be slow.
  InFloat clip_near(const GridFrame& frame, detail::Float4 at, detail::Float4 move, bool is_short, float first,
                    float last) noexcept;
};

template <typename Scalar>
SUREHIT_ALWAYS_INLINE inline ClippedPath::ClippedPath(const GridFrame& frame, const Path<Scalar>& path, double first_t,
                                                      double last_t) noexcept {
  clip(frame, path, first_t, last_t);
}

template <typename Scalar>
SUREHIT_ALWAYS_INLINE inline void ClippedPath::clip(const GridFrame& frame, const Path<Scalar>& path, double first_t,
                                                    double last_t) noexcept {
  if constexpr (std::is_same_v<Scalar, float>) {
    // The limits of a path of floats are floats.
    if (clip_in_float(frame, path, static_cast<float>(first_t), static_cast<float>(last_t)) == InFloat::done) return;
    octant = 0;
  }
  clip_in_double(frame, path, first_t, last_t);
}

template <typename Scalar>
SUREHIT_ALWAYS_INLINE inline ClippedPath::ClippedPath(const Grid& grid, const Path<Scalar>& path, double first_t,
                                                      double last_t) noexcept {
  if (!grid.is_empty()) clip(grid.frame(), path, first_t, last_t);
}

SUREHIT_ALWAYS_INLINE inline ClippedPath::InFloat ClippedPath::clip_in_float(const GridFrame& frame,
                                                                             const Path<float>& path, float first_t,
                                                                             float last_t) noexcept {
  using namespace detail;
  if (!frame.has_floats) return InFloat::none;
  const Float4 path_start = {path.start[0], path.start[1], path.start[2], 0};
  const Float4 path_toward = {path.toward[0], path.toward[1], path.toward[2], 0};
  const Float4 move = direction_of(path.kind, path_start, path_toward) * frame.float_scale;
  const Float4 at = (path_start - frame.float_low) * frame.float_scale + frame.float_margin;
  return clip_near(frame, at, move, path.has_end(), first_t, last_t);
}

SUREHIT_ALWAYS_INLINE inline bool ClippedPath::try_clip_in_float(const GridFrame& frame, const MovedPath& path,
                                                                 double first_t, double last_t) noexcept {
  using namespace detail;
  if (!frame.has_floats) return false;
  const Double4 scale = to_double(frame.float_scale);
  const Double4 stop = to_double(frame.float_stop);
  const Double4 cells = (path.start - to_double(frame.float_low)) * scale + to_double(frame.float_margin);
  const Double4 rates = path.direction * scale;
  const Long4 is_precise = path.position_error * scale <= 0x1p-23 * stop;
  const Long4 is_moderate = (absolute(cells) <= 0x1p30) & (absolute(rates) <= 0x1p30);
  if (any_of_three(~(is_precise & is_moderate))) return false;
  Float4 at = to_float(cells);
  Float4 move = to_float(rates);
  at[3] = 1;
  move[3] = 0;
  // Both ends are rounded outward. A path that is not slow has left the grid long before tau is 2^100.
  const double first = std::max(first_t - path.moved_t, -0x1p100);
  const double last = std::min(last_t - path.moved_t, 0x1p100);
  const auto outward = [](double tau) { return std::fabs(tau) * 0x1p-22; };
  const InFloat in_float = clip_near(frame, at, move, false, static_cast<float>(first - outward(first)),
                                     static_cast<float>(last + outward(last)));
  if (in_float != InFloat::done) {
    octant = 0;
    return false;
  }
  if (status != Status::clipped) return true;
  is_clipped_in_float = false;
  tau.unit = {1, 1, 1};
  tau.origin[0] = path.moved_t;
  tau.origin[1] = 0;
  return true;
}

// It has no branches on the direction, because a processor could not predict them.
SUREHIT_ALWAYS_INLINE inline ClippedPath::InFloat ClippedPath::clip_near(const GridFrame& frame, detail::Float4 at,
                                                                         detail::Float4 move, bool is_short,
                                                                         float first_t, float last_t) noexcept {
  using namespace detail;
  const Float4 stop = frame.float_stop;
  const Float4 speed = absolute(move);
  const Int4 is_near = (-stop <= at) & (at <= stop + stop) & (speed <= all_lanes(fast));
  const Int4 is_mirrored = move < all_lanes(0.0F);
  const Int4 is_still = speed < all_lanes(min_rate);
  const Float4 from = negated_where(at, is_mirrored) + masked(is_mirrored, stop);
  rate = masked(~is_still, speed);
  inverse_rate = choose(is_still, all_lanes(max_inverse), 1 / speed);
  Float4 leaving = (from - stop) * inverse_rate;
  leaving[3] = -last_t;
  const Float4 limits = max_lanes(-from * inverse_rate, leaving, speed, masked(~is_near, all_lanes(1.0F)));
  if (!(limits[2] >= slow || is_short)) return InFloat::none;
  if (limits[3] != 0) {
    start = from;
    octant = bits_of_lanes(is_mirrored);
    return InFloat::far;
  }
  // Most paths begin inside the grid. This test does not wait for the divisions, so these paths do not wait either.
  const bool may_enter_later = any_lane(from < all_lanes(0.0F)) || first_t != 0;
  float enters = 0;
  start = from;
  if (may_enter_later) [[unlikely]] {
    enters = std::max(first_t, limits[0]);
    start = max(from + enters * rate, all_lanes(0.0F));
  }
  const float leaves = -limits[1];
  if (!(enters <= leaves)) return InFloat::done;
  status = Status::clipped;
  is_clipped_in_float = true;
  octant = bits_of_lanes(is_mirrored);
  tau.origin[2] = double{enters};
  end = (last_t - enters) + (std::fabs(last_t) + std::fabs(enters)) * 0x1p-22F + std::numeric_limits<float>::min();
  exit = leaves - enters;
  start = min(start, stop * (1 - 0x1p-24F));
  return InFloat::done;
}

/// Visits the cells that a path goes through, in the order of the path. It leaps over long rows of empty cells.
///
/// Contract: let the path exactly meet a triangle at some t in the range, and not beyond any t that `shorten` was
/// given. Then a cell that lists the triangle is visited before the walk ends. WALK.md has the proof. The caller must
/// hold a FloatingPointEnvironment during the whole walk.
class GridTraversal {
 public:
  /// The walk leaps if it can leap over this many cells. Else it steps to the next cell, which is faster: a step waits
  /// neither for a word nor for a conversion to an index. A walk that begins in an empty cell begins with a leap.
  static constexpr std::uint32_t min_leap = 6;

  /// Begins at the first cell of a frame of the grid. If the path is not clipped to this frame, the walk is at its end
  /// at once. The grid, the frame and the path must outlive the walk. `enters` is the tau at which the walk begins:
  /// where the path enters the grid's cover (L7).
  SUREHIT_ALWAYS_INLINE GridTraversal(const Grid& grid, const GridFrame& frame, const ClippedPath& path,
                                      float enters = 0) noexcept
      : grid_(grid), frame_(frame), path_(path), end_(path.end) {
    begin(enters);
  }
  /// Begins at the first cell of the outermost grid.
  SUREHIT_ALWAYS_INLINE GridTraversal(const Grid& grid, const ClippedPath& path, float enters = 0) noexcept
      : grid_(grid), frame_(grid.frame()), path_(path), end_(path.end) {
    begin(enters);
  }
  [[nodiscard]] bool at_end() const noexcept { return at_end_; }
  /// Returns what the current cell holds. The cell is never divided.
  [[nodiscard]] CellWord word() const noexcept { return word_; }
  /// Returns the low corner of the current cell, in finest cells. It is mirrored like the path.
  [[nodiscard]] std::array<std::int32_t, 3> low() const noexcept {
    const detail::Int4 low = detail::to_int(planes_) - size_;
    return {low[0], low[1], low[2]};
  }
  /// Returns the edge of the current cell, in finest cells.
  [[nodiscard]] std::int32_t size() const noexcept { return size_; }

  /// Goes beyond the current cell, or beyond the cube of empty cells that begins with it (L2).
  SUREHIT_ALWAYS_INLINE void advance() noexcept {
    if (size_ != step_size_) [[unlikely]] {  // NOLINT(bugprone-branch-clone): less likely than the next branch
      leap();
    } else if (word_.is_empty() && word_.distance(path_.octant) >= min_leap) {
      leap();
    } else {
      step();
    }
  }

  /// Returns false if the path meets no triangle of the cell's list, because it misses the box of the list (L3).
  SUREHIT_ALWAYS_INLINE [[nodiscard]] bool meets_box() const noexcept {
    const TausOfBox tau = taus_of_box();
    return !detail::any_lane_exceeds_any(tau.enters, tau.leaves);
  }

  /// Returns false if the path meets no triangle of the cell's list, because it misses the slab of the list (L4). The
  /// path misses the slab if it is beyond the same plane where it enters the box and where it leaves the box.
  /// `meets_box` must be true.
  SUREHIT_ALWAYS_INLINE [[nodiscard]] bool meets(CellSlab slab) const noexcept {
    using namespace detail;
    const TausOfBox tau = taus_of_box();
    const Int4 bits = all_lanes(static_cast<std::int32_t>(slab.bits()));
    const Int4 components = (bits << Int4{27, 22, 17, 0}) >> 27;
    const Float4 normal = to_float((components ^ is_mirrored_) - is_mirrored_);
    const auto size = static_cast<float>(size_);
    const Float4 to_start = path_.start - (planes_ - size / 2);
    const float enters = sum_of_three((to_start + max_lane(tau.enters) * path_.rate) * normal);
    const float leaves = sum_of_three((to_start + min_lane(tau.leaves) * path_.rate) * normal);
    const float slack = sum_of_three(absolute(normal) * (GridFrame::padding_share * frame_.float_stop));
    const float step = CellSlab::step * size;
    const float low = static_cast<float>(slab.low()) * step - slack;
    const float high = static_cast<float>(slab.high() + 1) * step + slack;
    return !(std::max(enters, leaves) < low || std::min(enters, leaves) > high);
  }

  /// Ends the walk at parameter t, because the caller does not need what the path meets beyond it.
  SUREHIT_ALWAYS_INLINE void shorten(double t) noexcept { end_ = std::min(end_, path_.beyond(t)); }

 private:
  /// Goes to the first cell.
  SUREHIT_ALWAYS_INLINE void begin(float enters) noexcept {
    using namespace detail;
    if (path_.status != ClippedPath::Status::clipped) return;
    is_mirrored_ = path_.is_mirrored();
    at_end_ = false;
    Float4 position = path_.start;
    if (enters > 0) [[unlikely]] {
      position = min(position + enters * path_.rate, frame_.float_stop * (1 - 0x1p-24F));
    }
    enter(to_int(position));
    if (!word_.is_empty()) begin_steps();
  }

  /// The tau at which the path enters and leaves the box of the list.
  struct TausOfBox {
    detail::Float4 enters, leaves;  ///< On each axis. The fourth lane has the tau where the walk begins or ends.
  };
  SUREHIT_ALWAYS_INLINE [[nodiscard]] TausOfBox taus_of_box() const noexcept {
    using namespace detail;
    const Int4 bits = all_lanes(static_cast<std::int32_t>(grid_.box(word_).bits()));
    // Where the path is mirrored, low and high sides are exchanged and counted from the other end.
    constexpr std::int32_t last_part = CellBox::parts - 1;
    const Int4 turn = is_mirrored_ & last_part;
    const Int4 first = (bits >> (Int4{0, 10, 20, 0} + (is_mirrored_ & 5)) & last_part) ^ turn;
    const Int4 last = (bits >> (Int4{5, 15, 25, 5} - (is_mirrored_ & 5)) & last_part) ^ turn;
    const float part = static_cast<float>(size_) * (1.0F / CellBox::parts);
    const Float4 padding = GridFrame::padding_share * frame_.float_stop;
    const Float4 corner = planes_ - static_cast<float>(size_) - path_.start;
    // These do not depend on the box, so they are ready when the box is loaded.
    const Float4 tau_of_part = part * path_.inverse_rate;
    const Float4 first_tau = (corner - padding) * path_.inverse_rate;
    const Float4 last_tau = (corner + (part + padding)) * path_.inverse_rate;
    const Float4 enters = to_float(first) * tau_of_part + first_tau;
    const Float4 leaves = to_float(last) * tau_of_part + last_tau;
    return {with_fourth(enters, 0), with_fourth(leaves, end_)};
  }

  /// Goes to the next top cell.
  SUREHIT_ALWAYS_INLINE void step() noexcept {
    using namespace detail;
    // The comparisons tell which planes are crossed before `tau` is known. The next step waits only for them.
    const Float4 next_axis = shuffled<1, 2, 0, 3>(crossing_, crossing_);
    const Float4 last_axis = shuffled<2, 0, 1, 3>(crossing_, crossing_);
    const Int4 crossed = (crossing_ <= next_axis) & (crossing_ <= last_axis) & Int4{-1, -1, -1, 0};
    const Float4 tau = min(min(crossing_, next_axis), last_axis);
    at_end_ = !(tau[0] < end_);
    if (at_end_) return;
    const auto size = static_cast<float>(size_);
    // A maximum is enough, because no plane ahead is crossed before tau = 0, or before the plane before it.
    crossing_ = max(crossing_, masked(crossed, next_crossing_));
    planes_ += masked(crossed, all_lanes(size));
    next_crossing_ = (planes_ + size - path_.start) * path_.inverse_rate;
    top_ += order().step[bits_of_lanes(crossed)];
    look();
    if (!word_.is_divided()) return;
    const Int4 low = to_int(planes_) - size_;
    descend(min(max(to_int(path_.start + tau * path_.rate), low), low + (size_ - 1)));  // L2, case (iii)
  }

  /// Goes beyond the cell, or the cube of empty cells, and finds the next cell anew.
  SUREHIT_ALWAYS_INLINE void leap() noexcept {
    using namespace detail;
    const std::int32_t cells = word_.is_empty() ? static_cast<std::int32_t>(word_.distance(path_.octant)) : 1;
    const Float4 plane = planes_ + static_cast<float>(size_ * (cells - 1));
    const Float4 crossing = (plane - path_.start) * path_.inverse_rate;
    const Float4 tau = min_lane(crossing);
    // The position is not beyond the plane, but for roundings. So it fits an integer.
    const Int4 position = to_int(path_.start + tau * path_.rate);
    const Int4 finest =
        choose(crossing == tau, to_int(plane), max(position, to_int(planes_) - size_));  // L2, (i) and (iii)
    at_end_ = !(tau[0] < end_) || any_lane(finest >= to_int(frame_.float_stop));
    if (at_end_) return;
    enter(finest);
    begin_steps();
  }

  /// Computes what `step` needs. Steps end at the first outer plane that is crossed (L2).
  SUREHIT_ALWAYS_INLINE void begin_steps() noexcept {
    using namespace detail;
    step_size_ = static_cast<std::int32_t>(frame_.division);
    crossing_ = (planes_ - path_.start) * path_.inverse_rate;
    next_crossing_ = (planes_ + static_cast<float>(step_size_) - path_.start) * path_.inverse_rate;
    const Float4 leaves = (frame_.float_stop - path_.start) * path_.inverse_rate;
    end_ = std::min(end_, min_lane(without_fourth(leaves))[0]);
  }

  /// Makes the undivided cell that holds this finest cell the current one.
  SUREHIT_ALWAYS_INLINE void enter(detail::Int4 finest) noexcept {
    size_ = static_cast<std::int32_t>(frame_.division);
    top_ = order().index(finest >> static_cast<std::int32_t>(2 * grid_.levels()));
    planes_ = detail::to_float((finest & -size_) + size_);
    look();
    if (word_.is_divided()) descend(finest);
  }
  [[nodiscard]] const GridFrame::TopOrder& order() const noexcept { return frame_.top_orders[path_.octant]; }
  SUREHIT_ALWAYS_INLINE void look() noexcept { word_ = grid_.all_top().data()[top_]; }
  /// Goes from a divided cell to the undivided cell in it that holds this finest cell.
  SUREHIT_ALWAYS_INLINE void descend(detail::Int4 finest) noexcept {
    const auto [word, size] = undivided(grid_, word_, finest, is_mirrored_);
    word_ = word;
    size_ = size;
    planes_ = detail::to_float((finest & -size_) + size_);
  }

  struct Cell {
    CellWord word;
    std::int32_t size;
  };
  /// Returns the undivided cell that holds the finest cell. It is a function of its own that takes only values, so that
  /// the state of the walk stays in registers.
  SUREHIT_NOINLINE static Cell undivided(const Grid& grid, CellWord word, detail::Int4 finest,
                                         detail::Int4 is_mirrored) noexcept {
    std::uint32_t shift = 2 * grid.levels();
    do {
      shift -= 2;
      std::uint32_t cell = word.brick() * Grid::brick_size;
      for (std::uint32_t axis = 0; axis < 3; ++axis) {
        cell += (static_cast<std::uint32_t>((finest[axis] >> shift) ^ is_mirrored[axis]) & (Grid::brick_edge - 1))
                << 2 * axis;
      }
      word = grid.bricks()[cell];
    } while (word.is_divided());
    return {word, std::int32_t{1} << shift};
  }

  const Grid& grid_;
  const GridFrame& frame_;
  const ClippedPath& path_;
  detail::Float4 planes_ = {0, 0, 0, 0};         ///< The far planes of the cell.
  detail::Float4 crossing_ = {0, 0, 0, 0};       ///< The tau at which the path crosses the far planes of a top cell.
  detail::Float4 next_crossing_ = {0, 0, 0, 0};  ///< The same for the next cell on each axis, computed ahead.
  detail::Int4 is_mirrored_ = {0, 0, 0, 0};      ///< A mask of the axes on which the path is mirrored.
  std::int32_t top_ = 0;                         ///< The index of the top cell.
  std::int32_t size_ = 1;                        ///< The edge of the cell, in finest cells.
  std::int32_t step_size_ = 0;                   ///< The edge of a top cell, or 0 until the walk may step.
  float end_;                                    ///< The walk ends at this tau.
  CellWord word_;                                ///< The word of the cell.
  bool at_end_ = true;                           ///< True if the walk has ended.
};

}  // namespace surehit
