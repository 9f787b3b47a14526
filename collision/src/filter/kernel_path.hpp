#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#include "filter/kernel_bound.hpp"
#include "grid/grid.hpp"
#include "support/float4.hpp"
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

/// A path as the kernel takes it: plain numbers, in the order of two vectors.
template <typename Scalar>
struct KernelPath {
  Scalar start[3];
  Scalar reach;  ///< S of any triangle of a list is at most this and the list's longest edge
  Scalar d[3];
  Scalar d_size;  ///< D's largest component; infinite where sizes might overflow, so that nothing is certain

  KernelPath() = default;
  KernelPath(const Path<Scalar>& path, const GridFrame& frame);
  KernelPath(const Path<Scalar>& path, Scalar any_reach) : reach(any_reach), d_size(0) {
    Scalar start_size = 0;
    for (int axis = 0; axis < 3; ++axis) {
      start[axis] = path.start[axis];
      d[axis] = path.has_end() ? path.toward[axis] - path.start[axis] : path.toward[axis];
      start_size = std::fabs(start[axis]) > start_size ? std::fabs(start[axis]) : start_size;
      d_size = std::fabs(d[axis]) > d_size ? std::fabs(d[axis]) : d_size;
    }
    if (!are_small(start_size, d_size)) d_size = std::numeric_limits<Scalar>::infinity();
  }

 private:
  /// With the start and all vertices below half of it, S stays below `largest_size`.
  static bool are_small(Scalar start_size, Scalar any_d_size) {
    return start_size <= KernelBound<Scalar>::largest_size / 2 && any_d_size <= KernelBound<Scalar>::largest_size;
  }
};

template <>
inline KernelPath<double>::KernelPath(const Path<double>& path, const GridFrame& frame) : KernelPath(path, 0.0) {
  reach = reach_of(path, d, frame);
}

/// The same, `reach_of` too, with the axes side by side: with the numbers one by one, single first hits near surfaces
/// take 1.02 of the time and short ones 1.05.
template <>
inline KernelPath<float>::KernelPath(const Path<float>& path, const GridFrame& frame) {
  Float4 from = {path.start[0], path.start[1], path.start[2], 0};
  Float4 way = {path.toward[0], path.toward[1], path.toward[2], 0};
  if (path.has_end()) way -= from;
  Float4 far = max(absolute(from - frame.float_box_low), absolute(from - frame.float_box_high));
  if (path.has_end()) far = min(far, absolute(way) + frame.float_cell_size);
  const Float4 sizes = max_lanes(absolute(from), absolute(way), far, far);
  from[3] = sizes[2];
  way[3] = are_small(sizes[0], sizes[1]) ? sizes[1] : std::numeric_limits<float>::infinity();
  static_assert(std::is_standard_layout_v<KernelPath> && sizeof(KernelPath) == 2 * sizeof(Float4));
  auto* const bytes = reinterpret_cast<unsigned char*>(this);
  std::memcpy(bytes, &from, sizeof from);
  std::memcpy(bytes + sizeof from, &way, sizeof way);
}

}  // namespace surehit::detail
