#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel_bound.hpp"
#include "surehit/path.hpp"

namespace surehit::detail {

/// A path as the kernel takes it: plain numbers.
template <typename Scalar>
struct KernelPath {
  Scalar start[3];
  Scalar d[3];
  Scalar d_size;  ///< D's largest component; infinite where sizes might overflow, so that nothing is certain

  KernelPath() = default;
  explicit KernelPath(const Path<Scalar>& path) {
    Scalar start_size = 0;
    d_size = 0;
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
