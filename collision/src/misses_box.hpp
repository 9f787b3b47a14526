#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <tuple>

#include "support/inlining.hpp"
#include "surehit/path.hpp"
#include "surehit/triangle.hpp"

namespace surehit::detail {

/// Returns true if the path misses the box from `low` to `high`. These have three floats or doubles each. All
/// comparisons are exact. The path may be of any kind and have any length.
template <typename Scalar, typename Corner>
SUREHIT_ALWAYS_INLINE [[nodiscard]] inline bool misses_box(const Path<Scalar>& path, const Corner& low,
                                                           const Corner& high) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Scalar start = path.start[static_cast<Eigen::Index>(axis)];
    const Scalar toward = path.toward[static_cast<Eigen::Index>(axis)];
    if (path.has_end()) {
      if (std::max(start, toward) < low[axis] || std::min(start, toward) > high[axis]) return true;
      continue;
    }
    // A line comes from either side, unless it does not move.
    const bool comes_from_both = !path.has_start() && toward != 0;
    if (start < low[axis] && !(toward > 0 || comes_from_both)) return true;
    if (start > high[axis] && !(toward < 0 || comes_from_both)) return true;
  }
  return false;
}

/// Returns true if the path misses the box of the triangle.
template <typename Scalar>
[[nodiscard]] bool misses_box(const Path<Scalar>& path, const Triangle<Scalar>& triangle) {
  std::array<Scalar, 3> low;
  std::array<Scalar, 3> high;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto at = static_cast<Eigen::Index>(axis);
    std::tie(low[axis], high[axis]) = std::minmax({triangle.a[at], triangle.b[at], triangle.c[at]});
  }
  return misses_box(path, low, high);
}

}  // namespace surehit::detail
