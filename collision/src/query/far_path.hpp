#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "filter/kernel_bound.hpp"
#include "filter/kernel_path.hpp"
#include "grid/grid_frame.hpp"
#include "path_range.hpp"
#include "support/double4.hpp"
#include "support/float4.hpp"
#include "support/inlining.hpp"
#include "surehit/path.hpp"
#include "walk/far_clip.hpp"

namespace surehit::detail {

/// The parameter of a kernel that begins where the start of a path was moved to.
struct MovedParameter {
  double moved_t;  ///< The kernel has t - `moved_t`.

  /// Gives the hits of the kernel the parameter of the path. The sums are rounded outward.
  template <typename FirstHits>
  SUREHIT_ALWAYS_INLINE void set(FirstHits& first) const {
    const double lower = moved_t + double{first.t_lower};
    const double upper = moved_t + double{first.t_upper};
    constexpr double min = std::numeric_limits<float>::min();
    first.t_lower = static_cast<float>(lower - (std::fabs(lower) * 0x1p-23 + min));
    first.t_upper = static_cast<float>(upper + (std::fabs(upper) * 0x1p-23 + min));
  }
  /// Returns an upper bound on the kernel's parameter at the t of a visitor, which may be rounded to nearest.
  [[nodiscard]] float limit(float t) const {
    const double limit = t + std::fabs(double{t}) * 0x1p-23 + std::numeric_limits<float>::min() - moved_t;
    return static_cast<float>(limit + std::fabs(limit) * 0x1p-22);
  }
};

/// A path of floats whose start was moved to a point near a frame. The kernel begins there, so that its bounds are
/// small. It has a parameter of its own: t - `moved_t`.
class FarPath {
 public:
  /// The path was clipped to the frame, and `is_free` is true.
  FarPath(const Path<float>& any_path, const FarClip& any_clip) : path(any_path), clip(any_clip) {}

  // NOLINTNEXTLINE(google-explicit-constructor): what is exact needs the path itself
  operator const Path<float>&() const { return path; }

  /// Returns the path for the kernel. Its sizes include the error of the point.
  ///
  /// P2. Let a path begin at a point that is off by at most r on each axis. The bounds of kernel_bound.hpp hold for the
  ///     exact path if the reach grows by r / (8 eps).
  /// Proof. This is I8 in POSES.md for an exact direction.
  ///
  /// P3. The point is off by at most eps |point| + 2^-150 + 8 v (|start| + |low| + |point|) for the kernel. Here eps is
  ///     2^-24, v is 2^-53, and `low` is the low corner of the frame. The end of a segment is exact.
  /// Proof. The point is rounded to float at last, which is the first part. Before, it is low + ((start - low) + t D).
  ///     With o = (start - low) + t D, the size of t D is at most |start - low| + |o|. The rounding of the difference,
  ///     of D, of the product and of the two sums add up to v (3 |start - low| + 3 |o| + |point|) in first order.
  ///     Since |o| <= |point| + |low|, this is at most v (3 |start| + 6 |low| + 4 |point|).
  SUREHIT_ALWAYS_INLINE [[nodiscard]] KernelPath<float> kernel_path(const GridFrame& frame) const {
    Double4 point;
    for (int axis = 0; axis < 4; ++axis) point[axis] = clip.point[static_cast<std::size_t>(axis)];
    const Float4 start = {path.start[0], path.start[1], path.start[2], 0};
    const Float4 from = to_float(point);
    const Float4 way = direction_of(path.kind, start, Float4{path.toward[0], path.toward[1], path.toward[2], 0});
    const Float4 far = max(absolute(from - frame.float_box_low), absolute(from - frame.float_box_high));
    const Float4 all = absolute(start) + absolute(frame.float_low) + absolute(from);
    const Float4 sizes = max_lanes(absolute(from), absolute(way), far, all);
    KernelPath<float> kernel;
    for (int axis = 0; axis < 3; ++axis) {
      kernel.start[axis] = from[axis];
      kernel.d[axis] = way[axis];
    }
    const float error = clip.is_end ? 0 : sizes[0] / 8 + sizes[3] * 0x1p-28F + std::numeric_limits<float>::min();
    kernel.reach = sizes[2] + error;
    constexpr float largest = KernelBound<float>::largest_size;
    const bool is_small = kernel.reach <= largest / 2 && sizes[0] <= largest / 2 && sizes[1] <= largest;
    kernel.d_size = is_small ? sizes[1] : std::numeric_limits<float>::infinity();
    return kernel;
  }
  /// Returns the reach of the path from its own start.
  [[nodiscard]] float reach_from_start(const KernelPath<float>& kernel) const {
    float way = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      way = std::max(way, std::fabs(path.start[static_cast<Eigen::Index>(axis)] - kernel.start[axis]));
    }
    return (way + kernel.reach) * (1 + 0x1p-20F);
  }
  /// Returns the range for the kernel. No hit is where the range begins or ends, except for the end of a segment.
  [[nodiscard]] PathRange<float> kernel_range() const { return kernel_range(clip.is_end); }
  [[nodiscard]] static PathRange<float> kernel_range(bool is_end) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    return {-infinity, is_end ? 0 : infinity};
  }

  /// Gives the hits of the kernel the parameter of the path. The sums are rounded outward.
  template <typename FirstHits>
  SUREHIT_ALWAYS_INLINE void set_parameter(FirstHits& first) const {
    MovedParameter{clip.moved_t}.set(first);
  }

  const Path<float>& path;  ///< The path as it was given.
  const FarClip& clip;      ///< Where it begins for the kernel.
};

/// Returns an upper bound on the kernel's parameter at the t of a visitor, which may be rounded to nearest. For most
/// paths it is t itself, because the kernel compares it with floats that are t too.
template <typename Scalar, typename AnyPath>
[[nodiscard]] Scalar kernel_limit(const AnyPath&, Scalar t) {
  return t;
}
[[nodiscard]] inline float kernel_limit(const FarPath& path, float t) {
  return MovedParameter{path.clip.moved_t}.limit(t);
}

}  // namespace surehit::detail
