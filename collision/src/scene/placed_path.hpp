#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>

#include "filter/kernel_path.hpp"
#include "path_range.hpp"
#include "scene/instance_frame.hpp"
#include "scene/placement.hpp"
#include "support/exact_difference.hpp"
#include "surehit/path.hpp"
#include "walk/grid_traversal.hpp"

namespace surehit::detail {

/// A path of a scene, in double. All of its numbers are exact, except for an overflow.
template <typename Scalar>
struct ScenePath {
  explicit ScenePath(const Path<Scalar>& any_path, const PathRange<Scalar>& any_range, Scalar motion_share = 1)
      : path(any_path), range(any_range), share(motion_share) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<Eigen::Index>(axis);
      start[axis] = path.start[i];
      direction[axis] =
          path.has_end() ? exact_difference(path.toward[i], path.start[i]) : DoublePair{path.toward[i], 0};
    }
  }

  const Path<Scalar>& path;
  const PathRange<Scalar>& range;
  Scalar share;                         ///< The share of each motion that a segment sees.
  Doubles start;                        ///< The start of the path.
  std::array<DoublePair, 3> direction;  ///< D.
};

/// A path as an instance sees it, in the frame of the mesh. POSES.md derives the errors.
template <typename Scalar>
class PlacedPath {
 public:
  /// What is known of the path and the instance.
  enum class Status : std::uint8_t {
    beside,  ///< The path does not come near the instance.
    near,    ///< The path may meet the instance.
    rough,   ///< The errors are not known. All triangles must be decided exactly.
  };

  PlacedPath(const ScenePath<Scalar>& any_path, const Placement<Scalar>& any_placement, const InstanceFrame& frame)
      : scene_path(any_path), placement(any_placement) {
    status = place(frame);
  }

  const ScenePath<Scalar>& scene_path;
  const Placement<Scalar>& placement;
  Status status;
  MovedPath moved;             ///< The path in the frame of the mesh.
  double start_error = 0;      ///< No component of `moved.start` is off by more than this.
  double direction_error = 0;  ///< No component of `moved.direction` is off by more than this.
  double reach = 0;            ///< No component of the exact S of any triangle is larger than this.

  /// Returns the path for the kernel of the mesh. Its sizes include the errors (I8). Its t is not that of the path.
  template <typename MeshScalar>
  [[nodiscard]] KernelPath<MeshScalar> kernel_path() const;

 private:
  [[gnu::always_inline]] Status place(const InstanceFrame& frame) {
    constexpr double eps = 0x1p-53;
    if (!frame.is_usable) return Status::rough;
    const bool moves = placement.moves && scene_path.path.has_end();
    Doubles from;       // The start, less the placed anchor.
    Doubles way;        // D, less the motion.
    Doubles way_rest;   // What `way` leaves out.
    Doubles way_error;  // The sum of both is off by at most this.
    double along = 0;
    double length = 0;
    double distance = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      from[axis] = scene_path.start[axis] - frame.placed_anchor[axis];
      auto [high, low] = scene_path.direction[axis];
      way_error[axis] = 0;
      if (moves) {  // I4
        const double motion = placement.motion[static_cast<Eigen::Index>(axis)];
        const double product = motion * scene_path.share;
        const DoublePair sum = exact_difference(high, product);
        low += sum[1] - std::fma(motion, scene_path.share, -product);
        way_error[axis] = (std::fabs(high) + std::fabs(product)) * 0x1p-100 + 0x1p-1000;
        high = sum[0] + low;
        low = (sum[0] - high) + low;
      }
      way[axis] = high;
      way_rest[axis] = low;
      along -= from[axis] * high;
      length += high * high;
      distance += std::fabs(from[axis]);
    }
    // I5
    double t = length > 0 ? along / length : 0;
    t = std::min(std::max(t, double{scene_path.range.first}), double{scene_path.range.last});
    if (!(std::fabs(t) <= 0x1p500 && length <= 0x1p1000 && distance <= 0x1p500)) return Status::rough;
    Doubles center;        // The point of the path at t, less the placed anchor.
    Doubles center_error;  // It is off by at most this, besides its rounding.
    double square = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {  // I6
      const auto [high, low] = exact_difference(scene_path.start[axis], frame.placed_anchor[axis]);
      const double step = t * way[axis];
      const DoublePair sum = exact_difference(high, -step);
      const double rest = sum[1] + low + std::fma(t, way[axis], -step) + t * way_rest[axis];
      center[axis] = sum[0] + (rest - frame.placed_anchor_rest[axis]);
      center_error[axis] = (std::fabs(high) + std::fabs(step)) * 0x1p-98 + std::fabs(t) * way_error[axis] +
                           frame.placed_anchor_error[axis] + 0x1p-990;
      square += center[axis] * center[axis];
    }
    const double margin = frame.radius * (1 + 0x1p-20) + distance * 0x1p-44;
    if (square > margin * margin) return Status::beside;
    // I7
    const double share = frame.inverse_error + 8 * eps;
    moved.moved_t = t;
    Doubles offset;
    double largest_start = 0;
    Doubles errors;
    Doubles direction_errors;
    std::size_t fastest = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Doubles& row = frame.inverse[axis];
      double size = 0, rest = 0, way_size = 0, way_errors = 0;
      offset[axis] = row[0] * center[0] + row[1] * center[1] + row[2] * center[2];
      moved.direction[axis] = row[0] * way[0] + row[1] * way[1] + row[2] * way[2];
      for (std::size_t column = 0; column < 3; ++column) {
        const double entry = std::fabs(row[column]);
        size += entry * std::fabs(center[column]);
        rest += entry * center_error[column];
        way_size += entry * std::fabs(way[column]);
        way_errors += entry * way_error[column];
      }
      moved.start[axis] = frame.anchor[axis] + offset[axis];
      errors[axis] =
          share * size + 2 * rest + eps * (std::fabs(moved.start[axis]) + std::fabs(offset[axis])) + 0x1p-900;
      direction_errors[axis] = share * way_size + 2 * way_errors + 0x1p-900;
      start_error = std::max(start_error, errors[axis]);
      direction_error = std::max(direction_error, direction_errors[axis]);
      reach = std::max(reach, (std::fabs(offset[axis]) + frame.half_size[axis]) * (1 + 0x1p-40));
      largest_start = std::max(largest_start, std::fabs(moved.start[axis]));
      if (std::fabs(moved.direction[axis]) > std::fabs(moved.direction[fastest])) fastest = axis;
    }
    reach += start_error;
    const double speed = std::fabs(moved.direction[fastest]) - direction_errors[fastest];
    // Inside the box, t is at most this far from `moved_t`. A path that hardly moves is decided exactly.
    const double time = speed > 0
                            ? (std::fabs(offset[fastest]) + errors[fastest] + 2 * frame.half_size[fastest]) / speed
                        : length > 0 ? std::numeric_limits<double>::infinity()
                                     : 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      moved.position_error[axis] = errors[axis] + (time > 0 ? time * direction_errors[axis] : 0);
    }
    return reach <= 0x1p400 && direction_error <= 0x1p400 ? Status::near : Status::rough;
  }
};

template <typename Scalar>
template <typename MeshScalar>
KernelPath<MeshScalar> PlacedPath<Scalar>::kernel_path() const {
  constexpr double mesh_eps = std::numeric_limits<MeshScalar>::epsilon() / 2;
  constexpr bool is_rounded = std::is_same_v<MeshScalar, float>;
  KernelPath<MeshScalar> kernel;
  const double largest =
      std::max({std::fabs(moved.direction[0]), std::fabs(moved.direction[1]), std::fabs(moved.direction[2])});
  // The direction may have any length here. Its largest component becomes 1 to 2.
  const double scale = largest > 0 ? std::ldexp(1.0, -std::ilogb(largest)) : 1;
  double start_size = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    kernel.start[axis] = static_cast<MeshScalar>(moved.start[axis]);
    kernel.d[axis] = static_cast<MeshScalar>(moved.direction[axis] * scale);
    start_size = std::max(start_size, std::fabs(moved.start[axis]));
  }
  // I8
  const double start_off = start_error + (is_rounded ? mesh_eps * start_size + 0x1p-149 : 0);
  const double direction_off = direction_error * scale + (is_rounded ? 2 * mesh_eps + 0x1p-149 : 0);
  const double full_reach = (reach + start_off + start_off / (8 * mesh_eps)) * (1 + 0x1p-20);
  const double d_size = (std::min(largest * scale, 2.0) + direction_off / (8 * mesh_eps)) * (1 + 0x1p-20);
  kernel.reach = static_cast<MeshScalar>(full_reach);
  constexpr double max_size = double{KernelBound<MeshScalar>::largest_size} / 2;
  const bool is_small = start_size <= max_size && full_reach <= max_size && d_size <= max_size;
  kernel.d_size = is_small ? static_cast<MeshScalar>(d_size) : std::numeric_limits<MeshScalar>::infinity();
  return kernel;
}

}  // namespace surehit::detail
