#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "surehit/grid.hpp"
#include "surehit/path.hpp"

#if defined(__FAST_MATH__)
#error "surehit's walk does not hold under -ffast-math: leave this header to the library, whose sources are without it"
#endif

namespace surehit {

/// A path as a grid sees it: from where it enters the grid on, in finest cells, and mirrored so that it rises on every
/// axis. Plain floats, so that many of them can be walked side by side.
struct PlacedPath {
  enum class Place : std::uint8_t {
    outside,    ///< the path misses the grid
    inside,     ///< it is walked
    unclipped,  ///< so far away that it cannot be placed within the padding: it must meet all triangles
  };

  /// Rates between these need no scaling: tau is below 2^36 then while the path is in the grid, or 1 on a segment. So
  /// one of less than `least_rate` moves it by less than 2^-24 cells, and counts as none.
  static constexpr float slow = 0x1p-20F;
  static constexpr float fast = 0x1p20F;
  static constexpr float least_rate = 0x1p-66F;
  static constexpr float greatest_inverse = 0x1p100F;

  Place place = Place::outside;
  std::uint32_t octant = 0;     ///< bit k: mirrored on axis k
  detail::Float4 start;         ///< where the walk begins
  detail::Float4 rate;          ///< cells a unit of the walk's parameter tau
  detail::Float4 inverse_rate;  ///< finite
  float end = 0;                ///< tau beyond which nothing counts
  float exit = 0;               ///< tau at which the path leaves the grid, about
  /// tau = t unit[0] unit[1] unit[2] - origin[0] - origin[1] - origin[2]
  std::array<double, 3> unit = {1, 1, 1};
  std::array<double, 3> origin = {0, 0, 0};

  /// [first_t, last_t] is the part of the path that counts, either end possibly infinite. A path that is not finite is
  /// outside. The caller holds a FloatingPointEnvironment.
  template <typename Scalar>
  PlacedPath(const Grid& grid, const Path<Scalar>& path, double first_t, double last_t) noexcept;
  PlacedPath() = default;

  /// tau at t or a little beyond it.
  [[nodiscard]] float beyond(double t) const noexcept;

 private:
  template <typename Scalar>
  void place_in_double(const GridFrame& frame, const Path<Scalar>& path, double first_t, double last_t) noexcept;
  bool try_place_in_float(const GridFrame& frame, const Path<float>& path, float first_t, float last_t) noexcept;
};

template <typename Scalar>
[[gnu::always_inline]] inline PlacedPath::PlacedPath(const Grid& grid, const Path<Scalar>& path, double first_t,
                                                     double last_t) noexcept {
  if (grid.is_empty()) return;
  if constexpr (std::is_same_v<Scalar, float>) {
    // The limits of a float path are floats.
    if (try_place_in_float(grid.frame(), path, static_cast<float>(first_t), static_cast<float>(last_t))) return;
  }
  place_in_double(grid.frame(), path, first_t, last_t);
}

/// For most paths: near and neither slow nor fast. Without branches on the direction, which nobody could foretell.
[[gnu::always_inline]] inline bool PlacedPath::try_place_in_float(const GridFrame& frame, const Path<float>& path,
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
  const Int4 falls = move < all_lanes(0.0F);
  const Int4 stands = speed < all_lanes(least_rate);
  const Float4 from = falls ? stop - at : at;
  rate = stands ? all_lanes(0.0F) : speed;
  inverse_rate = stands ? all_lanes(greatest_inverse) : 1 / speed;
  const Float4 limits = greatest_lanes(-from * inverse_rate, (from - stop) * inverse_rate, speed,
                                       is_near ? all_lanes(0.0F) : all_lanes(1.0F));
  if (limits[3] != 0 || !(limits[2] >= slow || path.has_end())) return false;
  const float enters = std::max(first_t, limits[0]);
  const float leaves = std::min(last_t, -limits[1]);
  if (!(enters <= leaves)) return true;
  place = Place::inside;
  octant = static_cast<std::uint32_t>((falls[0] & 1) | (falls[1] & 2) | (falls[2] & 4));
  origin[2] = double{enters};
  end = (last_t - enters) + (std::fabs(last_t) + std::fabs(enters)) * 0x1p-22F + std::numeric_limits<float>::min();
  exit = leaves - enters;
  start = least(greatest(from + enters * rate, all_lanes(0.0F)), stop * (1 - 0x1p-24F));
  return true;
}

/// The cells that a path goes through, in the path's order, empty ones in leaps.
///
/// Contract: for every triangle that the path exactly meets at some t in the range, and that `shorten` has not put out
/// of reach, a cell that lists the triangle is visited before the walk ends. The argument stands in grid_traversal.cpp;
/// it presupposes that the caller holds a FloatingPointEnvironment for as long as it walks.
class GridTraversal {
 public:
  /// Stands at the first cell, or at the end where the path is not inside the grid. Both outlive the walk.
  [[gnu::always_inline]] GridTraversal(const Grid& grid, const PlacedPath& path) noexcept
      : grid_(grid), path_(path), end_(path.end) {
    if (path.place != PlacedPath::Place::inside) return;
    const GridFrame& frame = grid.frame();
    std::int32_t pitch = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto cells = static_cast<std::int32_t>(frame.cells[axis]);
      const std::int32_t falls = -static_cast<std::int32_t>(path.octant >> axis & 1);  // all bits, or none
      pitch_[axis] = (pitch ^ falls) - falls;
      first_ += (cells - 1) * pitch & falls;
      flip_[axis] = falls & static_cast<std::int32_t>(Grid::brick_edge - 1);
      pitch *= cells;
    }
    finest_ = detail::to_int(path.start);
    stop_ = detail::to_int(frame.float_stop);
    at_end_ = false;
    look();
  }

  [[nodiscard]] bool at_end() const noexcept { return at_end_; }
  /// What the cell holds in which the walk stands; it is never divided.
  [[nodiscard]] CellWord word() const noexcept { return word_; }
  /// That cell's low corner and edge, in finest cells as the path is mirrored.
  [[nodiscard]] std::array<std::int32_t, 3> low() const noexcept {
    return {finest_[0] & -size_, finest_[1] & -size_, finest_[2] & -size_};
  }
  [[nodiscard]] std::int32_t size() const noexcept { return size_; }

  /// Steps beyond the cell, or beyond the cube of empty cells that begins with it.
  [[gnu::always_inline]] void advance() noexcept {
    using namespace detail;
    const std::int32_t leap =
        word_.is_empty() ? size_ * static_cast<std::int32_t>(word_.distance(path_.octant)) : size_;
    const Int4 plane = (finest_ & -size_) + leap;
    const Float4 crossing = (to_float(plane) - path_.start) * path_.inverse_rate;
    const Float4 tau = least_lane(crossing);
    // No farther than the plane but for roundings, so that it fits.
    const Int4 place = to_int(path_.start + tau * path_.rate);
    finest_ = crossing == tau ? plane : greatest(place, finest_);
    at_end_ = !(tau[0] < end_) || any_lane(finest_ >= stop_);
    if (!at_end_) look();
  }

  /// Whether the path may meet a triangle of the cell's list: it passes through the box that they take up there.
  [[gnu::always_inline]] [[nodiscard]] bool meets_box() const noexcept {
    using namespace detail;
    const auto bits = static_cast<std::int32_t>(grid_.box(word_).bits());
    constexpr std::int32_t last_part = CellBox::parts - 1;
    const Int4 low = all_lanes(bits) >> Int4{0, 10, 20, 0} & last_part;
    const Int4 high = all_lanes(bits) >> Int4{5, 15, 25, 5} & last_part;
    const Int4 falls = flip_ != all_lanes(0);
    const Int4 first = falls ? last_part - high : low;
    const Int4 last = falls ? last_part - low : high;
    const float part = static_cast<float>(size_) * (1.0F / CellBox::parts);
    const Float4 padding = GridFrame::padding_share * grid_.frame().float_stop;
    const Float4 corner = to_float(finest_ & -size_) - path_.start;
    const Float4 enters = without_fourth((corner + (to_float(first) * part - padding)) * path_.inverse_rate);
    const Float4 leaves = without_fourth((corner + (to_float(last + 1) * part + padding)) * path_.inverse_rate);
    const Float4 limits = greatest_lanes(enters, -leaves, enters, -leaves);
    return std::max(limits[0], 0.0F) <= std::min(-limits[1], end_);
  }

  /// What the path meets beyond parameter t is of no interest any more.
  void shorten(double t) noexcept { end_ = std::min(end_, path_.beyond(t)); }

 private:
  /// Finds the undivided cell around the finest one.
  [[gnu::always_inline]] void look() noexcept {
    std::uint32_t shift = 2 * grid_.levels();
    std::int32_t index = first_;
    for (std::size_t axis = 0; axis < 3; ++axis) index += (finest_[axis] >> shift) * pitch_[axis];
    word_ = grid_.top()[static_cast<std::size_t>(index)];
    while (word_.is_divided()) {
      shift -= 2;
      std::uint32_t cell = word_.number() * Grid::brick_size;
      for (std::uint32_t axis = 0; axis < 3; ++axis) {
        cell += (static_cast<std::uint32_t>((finest_[axis] >> shift) ^ flip_[axis]) & (Grid::brick_edge - 1))
                << 2 * axis;
      }
      word_ = grid_.bricks()[cell];
    }
    size_ = std::int32_t{1} << shift;
  }

  const Grid& grid_;
  const PlacedPath& path_;
  detail::Int4 finest_ = {0, 0, 0, 0};  ///< the finest cell in which the walk stands
  detail::Int4 stop_ = {0, 0, 0, 0};
  detail::Int4 flip_ = {0, 0, 0, 0};
  std::array<std::int32_t, 3> pitch_ = {0, 0, 0};
  std::int32_t first_ = 0;
  std::int32_t size_ = 1;
  float end_;
  CellWord word_;
  bool at_end_ = true;
};

}  // namespace surehit
