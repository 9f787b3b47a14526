#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "shape/box_terms.hpp"

namespace surehit::detail {

/// The points of a triangle's plane with u v.u + v v.v + constant / M ≥ 0, where M > 0 belongs to all half-planes.
/// `Slope` and `Constant` are number types.
template <typename Slope, typename Constant>
struct HalfPlane {
  Slope u;            ///< The factor of u.
  Slope v;            ///< The factor of v.
  Constant constant;  ///< What is added, times M.
};

/// The point with the weights u / (M z) and v / (M z), where z > 0.
template <typename Weight, typename Divisor>
struct WeightedPoint {
  Weight u;
  Weight v;
  Divisor z;
  unsigned sides = 0;  ///< A bit for each side that the point was put on. It may be on others too.
};

inline void set_one(Bounded& x) { x = exact(1); }
inline void set_one(Sized& x) { x = {1, 1}; }
template <int Bits>
void set_one(WideInt<Bits>& x) {
  x = WideInt<Bits>::power_of_two(0);
}

/// Finds the point of a triangle that counts as touched: of all that a box touches, it is the nearest one to the box's
/// centre (B5). The numbers are of the types in `Numbers`: either exact integers, or doubles with bounds.
template <typename Numbers>
class TouchedPoint {
 public:
  using Difference = typename Numbers::Difference;
  using Moved = typename Numbers::Moved;
  using Side = HalfPlane<Difference, typename Numbers::Constant>;
  using Point = WeightedPoint<typename Numbers::Weight, typename Numbers::Divisor>;

  /// Sides 0 to 2 are the edges of the triangle: v ≥ 0, u + v ≤ 1 and u ≥ 0. For each axis i, the point is below the
  /// upper face of the box and above the lower one.
  static constexpr std::size_t side_count = 9;
  static constexpr unsigned all_sides = (1U << side_count) - 1;
  static constexpr std::size_t upper_side(std::size_t i) { return 3 + 2 * i; }
  static constexpr std::size_t lower_side(std::size_t i) { return 4 + 2 * i; }

  /// `to_centre` is the centre less the point without weights, times M. `ab` and `ac` are the edges from there.
  /// `extents` are the half extents, times M.
  template <typename Extent>
  TouchedPoint(const Vector<Moved>& to_centre, const Vector<Difference>& ab, const Vector<Difference>& ac,
               const Vector<Extent>& extents, const typename Numbers::Time& m, Signs& signs)
      : to_centre_(to_centre), ab_(ab), ac_(ac), signs_(signs) {
    set_one(sides_[0].v);
    set_one(sides_[2].u);
    sides_[1] = {negated(sides_[2].u), negated(sides_[0].v), m};
    for (std::size_t i = 0; i < 3; ++i) {
      sides_[upper_side(i)] = {negated(ab[i]), negated(ac[i]), extents[i] + to_centre[i]};
      sides_[lower_side(i)] = {ab[i], ac[i], extents[i] - to_centre[i]};
    }
  }

  /// Returns the nearest point that is not beyond any of these sides (B6). The triangle must have an area.
  [[nodiscard]] Point find(unsigned sides = all_sides) {
    Point point = below_centre();
    for (std::size_t k = 0; k < side_count; ++k) {
      if ((sides >> k & 1) != 0 && is_beyond(point, k)) point = find_on(k, sides & ((1U << k) - 1));
    }
    return point;
  }
  /// Returns the nearest point on the line of side `k` that is not beyond any of the other sides.
  [[nodiscard]] Point find_on(std::size_t k, unsigned sides = all_sides) {
    Point point = foot_on(k);
    for (std::size_t j = 0; j < side_count; ++j) {
      if ((sides >> j & 1) != 0 && j != k && is_beyond(point, j)) point = crossing(k, j);
    }
    return point;
  }
  /// Returns the point on the lines of two sides.
  [[nodiscard]] Point crossing(std::size_t k, std::size_t j) {
    Point point = crossing_of(sides_[k], sides_[j]);
    point.sides = 1U << k | 1U << j;
    return point;
  }

 private:
  [[nodiscard]] Point below_centre() {
    const HalfPlane<typename Numbers::Square, typename Numbers::MovedSquare> along_ab = {dot(ab_, ab_), dot(ab_, ac_),
                                                                                         negated(dot(to_centre_, ab_))};
    const HalfPlane<typename Numbers::Square, typename Numbers::MovedSquare> along_ac = {dot(ab_, ac_), dot(ac_, ac_),
                                                                                         negated(dot(to_centre_, ac_))};
    return crossing_of(along_ab, along_ac);
  }
  [[nodiscard]] Point foot_on(std::size_t k) {
    // The line goes along d = v ab - u ac. At its nearest point, the rest of the way to the centre is across d.
    const Side& side = sides_[k];
    Vector<typename Numbers::Direction> d;
    for (std::size_t i = 0; i < 3; ++i) d[i] = side.v * ab_[i] - side.u * ac_[i];
    const HalfPlane<typename Numbers::Slope, typename Numbers::MovedSlope> across = {dot(ab_, d), dot(ac_, d),
                                                                                     negated(dot(to_centre_, d))};
    Point point = crossing_of(side, across);
    point.sides = 1U << k;
    return point;
  }
  template <typename X, typename Y>
  [[nodiscard]] Point crossing_of(const X& x, const Y& y) {
    Point point;
    point.u = x.v * y.constant - y.v * x.constant;
    point.v = x.constant * y.u - y.constant * x.u;
    point.z = x.u * y.v - y.u * x.v;
    if (signs_.of(point.z) < 0) {
      point.u = negated(point.u);
      point.v = negated(point.v);
      point.z = negated(point.z);
    }
    return point;
  }
  [[nodiscard]] bool is_beyond(const Point& point, std::size_t k) {
    const Side& side = sides_[k];
    // The whole triangle is on one side of a face that it is parallel to, and some of its points are in the box.
    if (certain_sign(side.u) == 0 && certain_sign(side.v) == 0) return false;
    return signs_.of(point.u * side.u + point.v * side.v + side.constant * point.z) < 0;
  }

  const Vector<Moved>& to_centre_;
  const Vector<Difference>& ab_;
  const Vector<Difference>& ac_;
  std::array<Side, side_count> sides_;
  Signs& signs_;
};

}  // namespace surehit::detail
