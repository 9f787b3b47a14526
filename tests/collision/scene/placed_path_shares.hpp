#pragma once

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "path_and_instance.hpp"
#include "scene/instance_frame.hpp"
#include "scene/placed_path.hpp"

namespace surehit::test {

// The shares that the errors of a placed path take up of their bounds.

/// The anchor of an instance, and what its numbers leave out of it on each axis (I2).
struct AnchorError {
  template <typename Scalar>
  AnchorError(const PathAndInstance<Scalar>& drawn, const detail::InstanceFrame& frame)
      : anchor(drawn.matrix * exact(frame.anchor) + exact(drawn.placement.pose.translation)),
        alone(anchor - exact(frame.placed_anchor)),
        with_near_rest(alone - exact(frame.near_rest)),
        with_rest(alone - exact(frame.placed_anchor_rest)) {}

  [[nodiscard]] static mpq_class sum(const ExactVector& x) { return abs(x[0]) + abs(x[1]) + abs(x[2]); }

  ExactVector anchor;
  ExactVector alone;           ///< What `placed_anchor` leaves out.
  ExactVector with_near_rest;  ///< What the sum with `near_rest` leaves out.
  ExactVector with_rest;       ///< What the sum with `placed_anchor_rest` leaves out.
};

/// Returns the largest share of its bound that an entry of the inverse is off by (I1).
template <typename Scalar>
double share_of_inverse(const PathAndInstance<Scalar>& drawn, const detail::InstanceFrame& frame) {
  double largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const mpq_class error = drawn.inverse_matrix[i][j] - mpq_class(frame.inverse[j][i]);
      largest = std::max(largest, share_of(error, frame.inverse_error * std::fabs(frame.inverse[j][i])));
    }
  }
  return largest;
}

/// The shares of the bounds of one path (I7).
struct PathShares {
  double start = 0, direction = 0, position = 0, reach = 0;

  PathShares() = default;
  template <typename Scalar>
  PathShares(const PathAndInstance<Scalar>& drawn, const detail::PlacedPath<Scalar>& placed) {
    const mpq_class moved_t(placed.moved.moved_t);
    const ExactVector exact_start = drawn.local_at(moved_t);
    const ExactVector way = drawn.inverse_matrix * drawn.direction;
    const ExactVector start_off = exact_start - exact(placed.moved.start);
    const ExactVector way_off = way - exact(placed.moved.direction);
    start = largest_share(start_off, placed.start_error);
    direction = largest_share(way_off, placed.direction_error);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = static_cast<Eigen::Index>(i);
      for (const double corner : {drawn.box.low[axis], drawn.box.high[axis]}) {
        reach = std::max(reach, share_of(exact_start[i] - mpq_class(corner), placed.reach));
      }
    }
    const auto inside = drawn.in_box();
    if (!inside) return;
    for (const mpq_class& t : *inside) {
      const ExactVector off = start_off + (t - moved_t) * way_off;
      for (std::size_t i = 0; i < 3; ++i) {
        position = std::max(position, share_of(off[i], placed.moved.position_error[i]));
      }
    }
  }

  void include(const PathShares& other) {
    start = std::max(start, other.start);
    direction = std::max(direction, other.direction);
    position = std::max(position, other.position);
    reach = std::max(reach, other.reach);
  }
};

}  // namespace surehit::test
