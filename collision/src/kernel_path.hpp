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
[[nodiscard]] inline double reach_of(const Path<double>& path, const double (&d)[3], const GridFrame& frame) {
  double reach = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double start = path.start[static_cast<Eigen::Index>(axis)];
    double way = std::max(std::fabs(start - frame.low[axis]), std::fabs(start - frame.high[axis]));
    if (path.has_end()) way = std::min(way, std::fabs(d[axis]) + frame.cell_size[axis]);
    reach = std::max(reach, way);
  }
  return reach;
}
[[nodiscard]] inline float reach_of(const Path<float>& path, const float (&d)[3], const GridFrame& frame) {
  const Float4 start = {path.start[0], path.start[1], path.start[2], 0};
  Float4 way = greatest(absolute(start - frame.float_box_low), absolute(start - frame.float_box_high));
  if (path.has_end()) way = least(way, absolute(Float4{d[0], d[1], d[2], 0}) + frame.float_cell_size);
  return -least_lane(-way)[0];
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
