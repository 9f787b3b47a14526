#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "grid/grid.hpp"
#include "surehit/path.hpp"

#if defined(__FAST_MATH__)
#error "surehit's walk does not hold under -ffast-math: leave this header to the library, whose sources are without it"
#endif

namespace surehit {

/// A path as a grid sees it: from where it enters the grid on, in finest cells, and mirrored so that it rises on every
/// axis. Plain floats, so that many of them can be walked side by side.
struct ClippedPath {
  enum class Status : std::uint8_t {
    miss,     ///< the path misses the grid
    clipped,  ///< it is walked
    too_far,  ///< so far away that it cannot be clipped within the padding: it must meet all triangles
  };

  /// Rates between these need no scaling: tau is below 2^36 then while the path is in the grid, or 1 on a segment. So
  /// one of less than `min_rate` moves it by less than 2^-24 cells, and counts as none.
  static constexpr float slow = 0x1p-20F;
  static constexpr float fast = 0x1p20F;
  static constexpr float min_rate = 0x1p-66F;
  static constexpr float max_inverse = 0x1p100F;

  Status status = Status::miss;
  bool is_clipped_in_float = false;  ///< tau is t - origin[2] then
  std::uint32_t octant = 0;          ///< bit k: mirrored on axis k
  detail::Float4 start;              ///< where the walk begins
  detail::Float4 rate;               ///< cells a unit of the walk's parameter tau
  detail::Float4 inverse_rate;       ///< finite
  float end = 0;                     ///< tau beyond which nothing counts
  float exit = 0;                    ///< tau at which the path leaves the grid, about
  /// tau = t unit[0] unit[1] unit[2] - origin[0] - origin[1] - origin[2]. Of a path that is clipped in float, only
  /// `origin[2]` is set.
  std::array<double, 3> unit;
  std::array<double, 3> origin;

  /// The axes on which it is mirrored, all ones.
  [[nodiscard]] detail::Int4 is_mirrored() const noexcept {
    using namespace detail;
    return (all_lanes(static_cast<std::int32_t>(octant)) & Int4{1, 2, 4, 0}) != all_lanes(0);
  }

  /// [first_t, last_t] is the part of the path that counts, either end possibly infinite. A path that is not finite is
  /// outside. The caller holds a FloatingPointEnvironment.
  template <typename Scalar>
  ClippedPath(const Grid& grid, const Path<Scalar>& path, double first_t, double last_t) noexcept;
  ClippedPath() = default;

  /// Whether it ends in the cube of empty cells in which it begins, as most short ones do, and so meets nothing. Of a
  /// path that is inside. Of one that begins in a cell with a list it also fetches the word of the cell where it ends.
  [[gnu::always_inline]] [[nodiscard]] bool stays_in_empty_space(const Grid& grid) const noexcept {
    using namespace detail;
    const GridFrame& frame = grid.frame();
    const auto shift = static_cast<std::int32_t>(2 * grid.levels());
    const Int4 first = to_int(start) >> shift;
    const Int4 last = to_int(start + std::min(end, exit) * rate) >> shift;
    const GridFrame::TopOrder& order = frame.top_orders[octant];
    const CellWord word = grid.top()[static_cast<std::size_t>(order.index(first))];
    if (!word.is_empty()) {
      // A short path mostly goes through one more cell, the one where it ends, whose word it would wait for then.
      const Int4 stop = to_int(frame.float_stop) >> shift;
      const Int4 end_cell = min(max(last, first), stop - 1);
      __builtin_prefetch(&grid.top()[static_cast<std::size_t>(order.index(end_cell))]);
      return false;
    }
    const auto cells = static_cast<std::int32_t>(word.distance(octant));
    return !any_lane(last - first >= all_lanes(cells));
  }

  /// tau at t or a little beyond it.
  [[gnu::always_inline]] [[nodiscard]] float beyond(double t) const noexcept {
    return is_clipped_in_float ? beyond(t, origin[2]) : beyond_in_double(t);
  }
  /// The same where tau is t - `enters`.
  [[nodiscard]] static float beyond(double t, double enters) noexcept {
    const double tau = t - enters;
    const double rounding = (std::fabs(t) + std::fabs(enters)) * 0x1p-50 + std::fabs(tau) * 0x1p-22 + 0x1p-140;
    return static_cast<float>(tau + rounding);
  }

 private:
  template <typename Scalar>
  void place_in_double(const GridFrame& frame, const Path<Scalar>& path, double first_t, double last_t) noexcept;
  bool try_clip_in_float(const GridFrame& frame, const Path<float>& path, float first_t, float last_t) noexcept;
  [[nodiscard]] float beyond_in_double(double t) const noexcept;
};

template <typename Scalar>
[[gnu::always_inline]] inline ClippedPath::ClippedPath(const Grid& grid, const Path<Scalar>& path, double first_t,
                                                       double last_t) noexcept {
  if (grid.is_empty()) return;
  if constexpr (std::is_same_v<Scalar, float>) {
    // The limits of a float path are floats.
    if (try_clip_in_float(grid.frame(), path, static_cast<float>(first_t), static_cast<float>(last_t))) return;
  }
  place_in_double(grid.frame(), path, first_t, last_t);
}

/// For most paths: near and neither slow nor fast. Without branches on the direction, which nobody could foretell.
[[gnu::always_inline]] inline bool ClippedPath::try_clip_in_float(const GridFrame& frame, const Path<float>& path,
                                                                  float first_t, float last_t) noexcept {
  using namespace detail;
  if (!frame.has_floats) return false;
  const Float4 path_start = {path.start[0], path.start[1], path.start[2], 0};
  const Float4 path_toward = {path.toward[0], path.toward[1], path.toward[2], 0};
  const Float4 stop = frame.float_stop;
  const Float4 move = (path.has_end() ? path_toward - path_start : path_toward) * frame.float_scale;
  const Float4 at = (path_start - frame.float_low) * frame.float_scale + frame.float_margin;
  const Float4 speed = absolute(move);
  const Int4 is_near = (-stop <= at) & (at <= stop + stop) & (speed <= all_lanes(fast));
  const Int4 is_mirrored = move < all_lanes(0.0F);
  const Int4 stands = speed < all_lanes(min_rate);
  const Float4 from = negated_where(at, is_mirrored) + masked(is_mirrored, stop);
  rate = masked(~stands, speed);
  inverse_rate = stands ? all_lanes(max_inverse) : 1 / speed;
  Float4 leaving = (from - stop) * inverse_rate;
  leaving[3] = -last_t;
  const Float4 limits = max_lanes(-from * inverse_rate, leaving, speed, masked(~is_near, all_lanes(1.0F)));
  if (limits[3] != 0 || !(limits[2] >= slow || path.has_end())) return false;
  // Whether it may enter later is known before the divisions are done. Most paths begin inside, and wait for none.
  const bool may_enter_later = any_lane(from < all_lanes(0.0F)) || first_t != 0;
  float enters = 0;
  start = from;
  if (may_enter_later) [[unlikely]] {
    enters = std::max(first_t, limits[0]);
    start = max(from + enters * rate, all_lanes(0.0F));
  }
  const float leaves = -limits[1];
  if (!(enters <= leaves)) return true;
  status = Status::clipped;
  is_clipped_in_float = true;
  octant = bits_of_lanes(is_mirrored);
  origin[2] = double{enters};
  end = (last_t - enters) + (std::fabs(last_t) + std::fabs(enters)) * 0x1p-22F + std::numeric_limits<float>::min();
  exit = leaves - enters;
  start = min(start, stop * (1 - 0x1p-24F));
  return true;
}

/// The cells that a path goes through, in the path's order, empty ones in leaps where these are long.
///
/// Contract: for every triangle that the path exactly meets at some t in the range, and that `shorten` has not put out
/// of reach, a cell that lists the triangle is visited before the walk ends. The argument stands in grid_traversal.cpp;
/// it presupposes that the caller holds a FloatingPointEnvironment for as long as it walks.
class GridTraversal {
 public:
  /// Cells are stepped through one by one unless as many can be leapt over at once. A step waits neither for a word nor
  /// for a place to become an index, and takes a fraction of a leap's time. (With 4 or 8 long paths take 2 to 4%
  /// longer, and 14% with leaps alone.) A walk that begins in an empty cell begins with a leap.
  static constexpr std::uint32_t min_leap = 6;

  /// Stands at the first cell, or at the end where the path is not inside the grid. Both outlive the walk. One that
  /// begins later, where the path enters the grid's cover, leaves out what lies before.
  [[gnu::always_inline]] GridTraversal(const Grid& grid, const ClippedPath& path, float enters = 0) noexcept
      : grid_(grid), path_(path), end_(path.end) {
    using namespace detail;
    if (path.status != ClippedPath::Status::clipped) return;
    is_mirrored_ = path.is_mirrored();
    at_end_ = false;
    Float4 position = path.start;
    if (enters > 0) [[unlikely]] {
      position = min(position + enters * path.rate, grid.frame().float_stop * (1 - 0x1p-24F));
    }
    enter(to_int(position));
    if (!word_.is_empty()) begin_steps();
  }

  [[nodiscard]] bool at_end() const noexcept { return at_end_; }
  /// What the cell holds in which the walk stands; it is never divided.
  [[nodiscard]] CellWord word() const noexcept { return word_; }
  /// That cell's low corner and edge, in finest cells as the path is mirrored.
  [[nodiscard]] std::array<std::int32_t, 3> low() const noexcept {
    const detail::Int4 low = detail::to_int(planes_) - size_;
    return {low[0], low[1], low[2]};
  }
  [[nodiscard]] std::int32_t size() const noexcept { return size_; }

  /// Steps beyond the cell, or beyond the cube of empty cells that begins with it.
  [[gnu::always_inline]] void advance() noexcept {
    if (size_ != step_size_) [[unlikely]] {  // NOLINT(bugprone-branch-clone): of other likelihood than the next one
      leap();
    } else if (word_.is_empty() && word_.distance(path_.octant) >= min_leap) {
      leap();
    } else {
      step();
    }
  }

  /// Whether the path may meet a triangle of the cell's list: it passes through the box that they take up there.
  [[gnu::always_inline]] [[nodiscard]] bool meets_box() const noexcept {
    const TausOfBox tau = taus_of_box();
    return !detail::any_lane_exceeds_any(tau.enters, tau.leaves);
  }

  /// The same of a path that passes through that box, by the list's slab: unless the path is beyond the same plane
  /// where it enters the box and where it leaves that.
  [[gnu::always_inline]] [[nodiscard]] bool meets(CellSlab slab) const noexcept {
    using namespace detail;
    const TausOfBox tau = taus_of_box();
    const Int4 bits = all_lanes(static_cast<std::int32_t>(slab.bits()));
    const Int4 components = (bits << Int4{27, 22, 17, 0}) >> 27;
    const Float4 normal = to_float((components ^ is_mirrored_) - is_mirrored_);
    const auto size = static_cast<float>(size_);
    const Float4 to_start = path_.start - (planes_ - size / 2);
    const float enters = sum_of_three((to_start + max_lane(tau.enters) * path_.rate) * normal);
    const float leaves = sum_of_three((to_start + min_lane(tau.leaves) * path_.rate) * normal);
    const float slack = sum_of_three(absolute(normal) * (GridFrame::padding_share * grid_.frame().float_stop));
    const float step = CellSlab::step * size;
    const float low = static_cast<float>(slab.low()) * step - slack;
    const float high = static_cast<float>(slab.high() + 1) * step + slack;
    return !(std::max(enters, leaves) < low || std::min(enters, leaves) > high);
  }

  /// What the path meets beyond parameter t is of no interest any more.
  void shorten(double t) noexcept { end_ = std::min(end_, path_.beyond(t)); }

 private:
  /// tau at which the path enters and leaves the box on each axis, or begins and ends.
  struct TausOfBox {
    detail::Float4 enters, leaves;
  };
  [[gnu::always_inline]] [[nodiscard]] TausOfBox taus_of_box() const noexcept {
    using namespace detail;
    const Int4 bits = all_lanes(static_cast<std::int32_t>(grid_.box(word_).bits()));
    // Where the path is mirrored, the sides change places and count from the other end.
    constexpr std::int32_t last_part = CellBox::parts - 1;
    const Int4 turn = is_mirrored_ & last_part;
    const Int4 first = (bits >> (Int4{0, 10, 20, 0} + (is_mirrored_ & 5)) & last_part) ^ turn;
    const Int4 last = (bits >> (Int4{5, 15, 25, 5} - (is_mirrored_ & 5)) & last_part) ^ turn;
    const float part = static_cast<float>(size_) * (1.0F / CellBox::parts);
    const Float4 padding = GridFrame::padding_share * grid_.frame().float_stop;
    const Float4 corner = planes_ - static_cast<float>(size_) - path_.start;
    // What does not depend on the box is ready when that is loaded.
    const Float4 tau_of_part = part * path_.inverse_rate;
    const Float4 first_tau = (corner - padding) * path_.inverse_rate;
    const Float4 last_tau = (corner + (part + padding)) * path_.inverse_rate;
    const Float4 enters = to_float(first) * tau_of_part + first_tau;
    const Float4 leaves = to_float(last) * tau_of_part + last_tau;
    return {with_fourth(enters, 0), with_fourth(leaves, end_)};
  }

  /// Into the next top cell.
  [[gnu::always_inline]] void step() noexcept {
    using namespace detail;
    // Which planes are crossed next is known sooner than when, and only that is waited for by the next step.
    const Float4 next_axis = __builtin_shufflevector(crossing_, crossing_, 1, 2, 0, 3);
    const Float4 last_axis = __builtin_shufflevector(crossing_, crossing_, 2, 0, 1, 3);
    const Int4 crossed = (crossing_ <= next_axis) & (crossing_ <= last_axis) & Int4{-1, -1, -1, 0};
    const Float4 tau = min(min(crossing_, next_axis), last_axis);
    at_end_ = !(tau[0] < end_);
    if (at_end_) return;
    const auto size = static_cast<float>(size_);
    // No plane ahead is crossed before tau = 0, and the next one not before this one.
    crossing_ = max(crossing_, masked(crossed, next_crossing_));
    planes_ += masked(crossed, all_lanes(size));
    next_crossing_ = (planes_ + size - path_.start) * path_.inverse_rate;
    top_ += order().step[bits_of_lanes(crossed)];
    look();
    if (!word_.is_divided()) return;
    const Int4 low = to_int(planes_) - size_;
    descend(min(max(to_int(path_.start + tau * path_.rate), low), low + (size_ - 1)));
  }

  [[gnu::always_inline]] void leap() noexcept {
    using namespace detail;
    const std::int32_t cells = word_.is_empty() ? static_cast<std::int32_t>(word_.distance(path_.octant)) : 1;
    const Float4 plane = planes_ + static_cast<float>(size_ * (cells - 1));
    const Float4 crossing = (plane - path_.start) * path_.inverse_rate;
    const Float4 tau = min_lane(crossing);
    // No farther than the plane but for roundings, so that it fits.
    const Int4 position = to_int(path_.start + tau * path_.rate);
    const Int4 finest = crossing == tau ? to_int(plane) : max(position, to_int(planes_) - size_);
    at_end_ = !(tau[0] < end_) || any_lane(finest >= to_int(grid_.frame().float_stop));
    if (at_end_) return;
    enter(finest);
    begin_steps();
  }

  [[gnu::always_inline]] void begin_steps() noexcept {
    using namespace detail;
    step_size_ = static_cast<std::int32_t>(grid_.frame().division);
    crossing_ = (planes_ - path_.start) * path_.inverse_rate;
    next_crossing_ = (planes_ + static_cast<float>(step_size_) - path_.start) * path_.inverse_rate;
    const Float4 leaves = (grid_.frame().float_stop - path_.start) * path_.inverse_rate;
    end_ = std::min(end_, min_lane(without_fourth(leaves))[0]);
  }

  /// Finds the undivided cell around the finest one.
  [[gnu::always_inline]] void enter(detail::Int4 finest) noexcept {
    size_ = static_cast<std::int32_t>(grid_.frame().division);
    top_ = order().index(finest >> static_cast<std::int32_t>(2 * grid_.levels()));
    planes_ = detail::to_float((finest & -size_) + size_);
    look();
    if (word_.is_divided()) descend(finest);
  }
  [[nodiscard]] const GridFrame::TopOrder& order() const noexcept { return grid_.frame().top_orders[path_.octant]; }
  [[gnu::always_inline]] void look() noexcept { word_ = grid_.top()[static_cast<std::size_t>(top_)]; }
  [[gnu::always_inline]] void descend(detail::Int4 finest) noexcept {
    const auto [word, size] = undivided(grid_, word_, finest, is_mirrored_);
    word_ = word;
    size_ = size;
    planes_ = detail::to_float((finest & -size_) + size_);
  }

  struct Cell {
    CellWord word;
    std::int32_t size;
  };
  /// Apart, and a function of values alone, so that the walk's state stays in registers.
  [[gnu::noinline]] static Cell undivided(const Grid& grid, CellWord word, detail::Int4 finest,
                                          detail::Int4 is_mirrored) noexcept {
    std::uint32_t shift = 2 * grid.levels();
    do {
      shift -= 2;
      std::uint32_t cell = word.number() * Grid::brick_size;
      for (std::uint32_t axis = 0; axis < 3; ++axis) {
        cell += (static_cast<std::uint32_t>((finest[axis] >> shift) ^ is_mirrored[axis]) & (Grid::brick_edge - 1))
                << 2 * axis;
      }
      word = grid.bricks()[cell];
    } while (word.is_divided());
    return {word, std::int32_t{1} << shift};
  }

  const Grid& grid_;
  const ClippedPath& path_;
  detail::Float4 planes_ = {0, 0, 0, 0};         ///< the cell's far ones
  detail::Float4 crossing_ = {0, 0, 0, 0};       ///< of a top cell: tau at which the path crosses them,
  detail::Float4 next_crossing_ = {0, 0, 0, 0};  ///< and those of the cells after it: known before they are wanted
  detail::Int4 is_mirrored_ = {0, 0, 0, 0};      ///< the axes on which it is mirrored
  std::int32_t top_ = 0;                         ///< the top cell's index
  std::int32_t size_ = 1;
  std::int32_t step_size_ = 0;  ///< a top cell's, as soon as the walk may step
  float end_;
  CellWord word_;
  bool at_end_ = true;
};

}  // namespace surehit
