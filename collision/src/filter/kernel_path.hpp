#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#include "filter/kernel_bound.hpp"
#include "grid/grid.hpp"
#include "support/float4.hpp"
#include "support/inlining.hpp"
#include "surehit/path.hpp"
#include "walk/direction.hpp"

namespace surehit::detail {

/// Returns the reach of the path: the part of |S| that does not depend on the list.
///
/// P1. Let the path come to a list. For any of its triangles, no component of S exceeds the reach plus the list's
///     longest edge. This leaves out 2^-21 |D| of a segment, which K5 includes.
/// Proof. The corner a is in the mesh's box. So it is at most as far from the start as the farther side of the box.
///     A segment has a second bound. The list's cell, with its paddings, has a point X of the path in it.
///     It also has a point Y of the triangle's bounding box. On one axis, the distances are:
///
///     from start to X    at most |D|, and a walk may go 2^-21 |D| beyond the end;
///     from X to Y        at most the size of the cell;
///     from Y to a        at most the longer one of b - a and c - a.
///
///     The first bound is the smaller one for long segments, and where a flat mesh has thick cells.
[[nodiscard]] inline double reach_of(const Path<double>& path, const double (&d)[3], const GridFrame& frame) {
  double reach = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double start = path.start[static_cast<Eigen::Index>(axis)];
    double way = std::max(std::fabs(start - frame.low[axis]), std::fabs(start - frame.high[axis]));
    if (path.has_end()) way = std::min(way, std::fabs(d[axis]) + frame.cell_size[axis]);  // P1
    reach = std::max(reach, way);
  }
  return reach;
}

/// A path in the form that the kernel uses. Its members have the layout of two vectors.
template <typename Scalar>
struct KernelPath {
  Scalar start[3];  ///< The start of the path.
  Scalar reach;     ///< No component of S exceeds this plus the list's longest edge (P1).
  Scalar d[3];      ///< The computed D.
  Scalar d_size;    ///< The largest component of D. It is infinite if sizes might overflow, so that nothing is certain.

  KernelPath() = default;
  KernelPath(const Path<Scalar>& path, const GridFrame& frame);
  KernelPath(const Path<Scalar>& path, Scalar any_reach) : reach(any_reach), d_size(0) {
    Scalar start_size = 0;
    for (int axis = 0; axis < 3; ++axis) {
      start[axis] = path.start[axis];
      d[axis] = direction_of(path.kind, path.start[axis], path.toward[axis]);
      start_size = std::fabs(start[axis]) > start_size ? std::fabs(start[axis]) : start_size;
      d_size = std::fabs(d[axis]) > d_size ? std::fabs(d[axis]) : d_size;
    }
    if (!are_small(start_size, d_size)) d_size = std::numeric_limits<Scalar>::infinity();
  }

  /// Sets all members of a path of floats. The fourth lanes are the reach and `d_size`.
  SUREHIT_ALWAYS_INLINE void set(Float4 from, Float4 way) {
    static_assert(std::is_standard_layout_v<KernelPath<float>> && sizeof(KernelPath<float>) == 2 * sizeof(Float4));
    auto* const bytes = reinterpret_cast<unsigned char*>(this);
    std::memcpy(bytes, &from, sizeof from);
    std::memcpy(bytes + sizeof from, &way, sizeof way);
  }

 private:
  /// S is at most `largest_size` if the start and the first corners of a list are at most half of it.
  static bool are_small(Scalar start_size, Scalar any_d_size) {
    return start_size <= KernelBound<Scalar>::largest_size / 2 && any_d_size <= KernelBound<Scalar>::largest_size;
  }
};

template <>
inline KernelPath<double>::KernelPath(const Path<double>& path, const GridFrame& frame) : KernelPath(path, 0.0) {
  reach = reach_of(path, d, frame);
}

/// The same for floats, `reach_of` included. A vector holds all axes, because scalars are slower on short paths.
template <>
inline KernelPath<float>::KernelPath(const Path<float>& path, const GridFrame& frame) {
  Float4 from = {path.start[0], path.start[1], path.start[2], 0};
  Float4 way = direction_of(path.kind, from, Float4{path.toward[0], path.toward[1], path.toward[2], 0});
  Float4 far = max(absolute(from - frame.float_box_low), absolute(from - frame.float_box_high));
  if (path.has_end()) far = min(far, absolute(way) + frame.float_cell_size);
  const Float4 sizes = max_lanes(absolute(from), absolute(way), far, far);
  from[3] = sizes[2];
  way[3] = are_small(sizes[0], sizes[1]) ? sizes[1] : std::numeric_limits<float>::infinity();
  set(from, way);
}

}  // namespace surehit::detail
