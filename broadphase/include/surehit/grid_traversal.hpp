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
  std::uint32_t octant = 0;           ///< bit k: mirrored on axis k
  std::array<float, 3> start;         ///< where the walk begins
  std::array<float, 3> rate;          ///< cells a unit of the walk's parameter tau
  std::array<float, 3> inverse_rate;  ///< finite
  float end = 0;                      ///< tau beyond which nothing counts
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
  if (!frame.has_floats) return false;
  std::array<float, 3> from;
  float enters = first_t;
  float leaves = last_t;
  float fastest = 0;
  bool is_plain = true;
  std::uint32_t falls = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    const auto stop = static_cast<float>(static_cast<std::int32_t>(frame.resolution(axis)));
    const float move = (path.has_end() ? path.toward[i] - path.start[i] : path.toward[i]) * frame.float_scale[axis];
    const float place = (path.start[i] - frame.float_low[axis]) * frame.float_scale[axis] + frame.margin[axis];
    const float speed = std::fabs(move);
    is_plain &= (-stop <= place) & (place <= 2 * stop) & (speed <= fast);
    fastest = std::max(fastest, speed);
    const std::uint32_t falling = move < 0 ? 1 : 0;
    falls |= falling << axis;
    from[axis] = std::array<float, 2>{place, stop - place}[falling];
    rate[axis] = speed < least_rate ? 0 : speed;
    inverse_rate[axis] = speed < least_rate ? greatest_inverse : 1 / speed;
    enters = std::max(enters, -from[axis] * inverse_rate[axis]);
    leaves = std::min(leaves, (stop - from[axis]) * inverse_rate[axis]);
  }
  if (!is_plain || !(fastest >= slow || path.has_end())) return false;
  if (!(enters <= leaves)) return true;
  place = Place::inside;
  octant = falls;
  origin[2] = double{enters};
  end = (last_t - enters) + (std::fabs(last_t) + std::fabs(enters)) * 0x1p-22F + std::numeric_limits<float>::min();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto stop = static_cast<float>(static_cast<std::int32_t>(frame.resolution(axis)));
    start[axis] = std::min(std::max(from[axis] + enters * rate[axis], 0.0F), stop * (1 - 0x1p-24F));
  }
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
      stop_[axis] = cells * static_cast<std::int32_t>(frame.division);
      finest_[axis] = static_cast<std::int32_t>(path.start[axis]);
      const std::int32_t falls = -static_cast<std::int32_t>(path.octant >> axis & 1);  // all bits, or none
      pitch_[axis] = (pitch ^ falls) - falls;
      first_ += (cells - 1) * pitch & falls;
      flip_[axis] = falls & static_cast<std::int32_t>(Grid::brick_edge - 1);
      pitch *= cells;
    }
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
    const std::int32_t leap =
        word_.is_empty() ? size_ * static_cast<std::int32_t>(word_.distance(path_.octant)) : size_;
    std::array<std::int32_t, 3> plane;
    std::array<float, 3> crossing;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      plane[axis] = (finest_[axis] & -size_) + leap;
      crossing[axis] = (static_cast<float>(plane[axis]) - path_.start[axis]) * path_.inverse_rate[axis];
    }
    const float tau = std::min(std::min(crossing[0], crossing[1]), crossing[2]);
    bool inside = tau < end_;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      // No farther than the plane but for roundings, so that it fits.
      const auto place = static_cast<std::int32_t>(path_.start[axis] + tau * path_.rate[axis]);
      const std::int32_t cell = std::min(std::max(place, finest_[axis]), plane[axis] - 1);
      finest_[axis] = crossing[axis] == tau ? plane[axis] : cell;
      inside &= finest_[axis] < stop_[axis];
    }
    at_end_ = !inside;
    if (inside) look();
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
      std::uint32_t cell = word_.offset() * Grid::brick_size;
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
  std::array<std::int32_t, 3> finest_ = {0, 0, 0};  ///< the finest cell in which the walk stands
  std::array<std::int32_t, 3> stop_ = {0, 0, 0};
  std::array<std::int32_t, 3> pitch_ = {0, 0, 0};
  std::array<std::int32_t, 3> flip_ = {0, 0, 0};
  std::int32_t first_ = 0;
  std::int32_t size_ = 1;
  float end_;
  CellWord word_;
  bool at_end_ = true;
};

}  // namespace surehit
