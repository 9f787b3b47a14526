#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "surehit/path.hpp"
#include "walk/direction.hpp"

namespace surehit::detail {

/// A box that contains the part of a path up to some parameter.
///
/// X1. The box contains each point of the path with a parameter up to `limit`.
/// Proof. On each axis, the path goes one way. So its points lie between where it comes from and where it is at
/// `limit`.
///     A segment ends at `toward` at the latest, which needs no arithmetic. Otherwise, four roundings take part: those
///     of the difference, of the product, of the sum and of the result. Each is at most 2^-24 (|start| + |moved|), up
///     to terms of a higher order. `slack` is four times as much as all of them, and the smallest normal number covers
///     underflow. A point that is too large bounds nothing.
template <typename Scalar>
struct PathBox {
  std::array<Scalar, 3> low;   ///< The lowest coordinates. They may be infinite.
  std::array<Scalar, 3> high;  ///< The highest coordinates. They may be infinite.

  PathBox(const Path<Scalar>& path, double limit) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double start = path.start[static_cast<Eigen::Index>(axis)];
      const double toward = path.toward[static_cast<Eigen::Index>(axis)];
      const double way = direction_of(path.kind, start, toward);
      if (way == 0) {
        low[axis] = high[axis] = static_cast<Scalar>(start);
        continue;
      }
      const double from = path.has_start() ? start : -std::copysign(infinity, way);
      double to = toward;
      double slack = 0;
      if (!path.has_end() || limit < 1) {
        const double moved = limit * way;
        to = start + moved;
        slack = (std::fabs(start) + std::fabs(moved)) * 0x1p-20 + double{std::numeric_limits<Scalar>::min()};
        if (!(std::fabs(to) + slack < double{std::numeric_limits<Scalar>::max()})) {
          to = std::copysign(infinity, way);
          slack = 0;
        }
      }
      low[axis] = static_cast<Scalar>(std::min(from, to - slack));
      high[axis] = static_cast<Scalar>(std::max(from, to + slack));
    }
  }
};

}  // namespace surehit::detail
