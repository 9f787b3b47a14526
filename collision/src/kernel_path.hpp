#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel_bound.hpp"
#include "surehit/grid.hpp"
#include "surehit/path.hpp"

namespace surehit::detail {

/// How far from the start the corner a of a triangle may be on any axis, if the path comes to a list in which the
/// triangle is: no farther than this and the list's longest edge.
///
/// In the list's cell, but for paddings, are a point X of the path and a point Y of the triangle's box, which is no
/// farther from a than the longer of b - a and c - a. X is no farther from a segment's start than its end is, but for
/// the 2^-21 of it by which a walk may go on. And a is in the mesh's box, however thick the cells of a flat mesh are
/// and however long the path.
template <typename Scalar>
[[nodiscard]] Scalar reach_of(const Path<Scalar>& path, const Scalar (&d)[3], const GridFrame& frame) {
  constexpr double largest = std::numeric_limits<Scalar>::max();
  Scalar reach = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Scalar start = path.start[static_cast<Eigen::Index>(axis)];
    Scalar way = std::max(std::fabs(start - static_cast<Scalar>(frame.low[axis])),
                          std::fabs(start - static_cast<Scalar>(frame.high[axis])));
    if (path.has_end()) {
      way = std::min(way, std::fabs(d[axis]) + static_cast<Scalar>(std::min(frame.cell_size[axis], largest)));
    }
    reach = std::max(reach, way);
  }
  return reach;
}

/// A path as the kernel takes it: plain numbers.
template <typename Scalar>
struct KernelPath {
  Scalar start[3];
  Scalar d[3];
  Scalar d_size;  ///< D's largest component; infinite where sizes might overflow, so that nothing is certain
  Scalar reach;   ///< S of any triangle of a list is at most this and the list's longest edge

  KernelPath() = default;
  KernelPath(const Path<Scalar>& path, const GridFrame& frame) : KernelPath(path, Scalar{0}) {
    reach = reach_of(path, d, frame);
  }
  KernelPath(const Path<Scalar>& path, Scalar any_reach) : d_size(0), reach(any_reach) {
    Scalar start_size = 0;
    for (int axis = 0; axis < 3; ++axis) {
      start[axis] = path.start[axis];
      d[axis] = path.has_end() ? path.toward[axis] - path.start[axis] : path.toward[axis];
      start_size = std::fabs(start[axis]) > start_size ? std::fabs(start[axis]) : start_size;
      d_size = std::fabs(d[axis]) > d_size ? std::fabs(d[axis]) : d_size;
    }
    // With the start and all vertices below half of it, S stays below `largest_size`.
    if (!(start_size <= KernelBound<Scalar>::largest_size / 2 && d_size <= KernelBound<Scalar>::largest_size)) {
      d_size = std::numeric_limits<Scalar>::infinity();
    }
  }
};

}  // namespace surehit::detail
