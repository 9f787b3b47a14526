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
};

inline void set_one(Bounded& x) { x = exact(1); }
inline void set_one(Sized& x) { x = {1, 1}; }
template <int Bits>
void set_one(WideInt<Bits>& x) {
  x = WideInt<Bits>::power_of_two(0);
}

/// Finds the point of a triangle that counts as touched: of all that a box touches, it is the nearest one to the box's
/// centre (B4). The numbers are of the types in `Numbers`: either exact integers, or doubles with bounds.
template <typename Numbers>
class TouchedPoint {
 public:
  using Difference = typename Numbers::Difference;
  using Moved = typename Numbers::Moved;
  using Side = HalfPlane<Difference, typename Numbers::Constant>;
  using Point = WeightedPoint<typename Numbers::Weight, typename Numbers::Divisor>;

  /// The sides 0 to 2 are those of the triangle: v ≥ 0, u + v ≤ 1 and u ≥ 0. Side 3 + 2 i keeps the point below the
  /// upper face of the box on axis i, and side 4 + 2 i above the lower one.
  static constexpr std::size_t side_count = 9;

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
      sides_[3 + 2 * i] = {negated(ab[i]), negated(ac[i]), extents[i] + to_centre[i]};
      sides_[4 + 2 * i] = {ab[i], ac[i], extents[i] - to_centre[i]};
    }
  }

  /// Returns the point of a triangle with an area (B5).
  [[nodiscard]] Point find() {
    Point point = below_centre();
    for (std::size_t k = 0; k < side_count; ++k) {
      if (is_beyond(point, sides_[k])) point = find_on(k, k);
    }
    return point;
  }
  /// Returns the nearest point on the line of side `k` that is not beyond any of the first `count` sides (B5).
  [[nodiscard]] Point find_on(std::size_t k, std::size_t count) {
    Point point = foot_on(sides_[k]);
    for (std::size_t j = 0; j < count; ++j) {
      if (j != k && is_beyond(point, sides_[j])) point = crossing(sides_[k], sides_[j]);
    }
    return point;
  }

 private:
  [[nodiscard]] Point below_centre() {
    const HalfPlane<typename Numbers::Square, typename Numbers::MovedSquare> along_ab = {dot(ab_, ab_), dot(ab_, ac_),
                                                                                         negated(dot(to_centre_, ab_))};
    const HalfPlane<typename Numbers::Square, typename Numbers::MovedSquare> along_ac = {dot(ab_, ac_), dot(ac_, ac_),
                                                                                         negated(dot(to_centre_, ac_))};
    return crossing(along_ab, along_ac);
  }
  [[nodiscard]] Point foot_on(const Side& side) {
    // The line goes along d = v ab - u ac. At its nearest point, the rest of the way to the centre is across d.
    Vector<typename Numbers::Direction> d;
    for (std::size_t i = 0; i < 3; ++i) d[i] = side.v * ab_[i] - side.u * ac_[i];
    const HalfPlane<typename Numbers::Slope, typename Numbers::MovedSlope> across = {dot(ab_, d), dot(ac_, d),
                                                                                     negated(dot(to_centre_, d))};
    return crossing(side, across);
  }
  template <typename X, typename Y>
  [[nodiscard]] Point crossing(const X& x, const Y& y) {
    Point point;
    point.u = x.v * y.constant - y.v * x.constant;
    point.v = x.constant * y.u - y.constant * x.u;
    point.z = x.u * y.v - y.u * x.v;
    if (signs_.of(point.z) < 0) point = {negated(point.u), negated(point.v), negated(point.z)};
    return point;
  }
  [[nodiscard]] bool is_beyond(const Point& point, const Side& side) {
    return signs_.of(point.u * side.u + point.v * side.v + side.constant * point.z) < 0;
  }

  const Vector<Moved>& to_centre_;
  const Vector<Difference>& ab_;
  const Vector<Difference>& ac_;
  std::array<Side, side_count> sides_;
  Signs& signs_;
};

}  // namespace surehit::detail
