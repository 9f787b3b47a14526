#pragma once

#include <algorithm>
#include <array>
#include <bit>
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

/// Returns the power of two that brings x into [1, 2). Returns 1 if x is 0. Outside of 2^-1000 to 2^1000, the result is
/// only a power of two.
[[nodiscard]] inline double inverse_power(double x) {
  const std::uint64_t exponent = std::bit_cast<std::uint64_t>(std::fabs(x)) >> 52;
  return x == 0 ? 1 : std::bit_cast<double>((std::uint64_t{2046} - std::min<std::uint64_t>(exponent, 2045)) << 52);
}

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

  // It is inlined into code for the best instruction set, which has a fused operation.
  [[gnu::always_inline]] PlacedPath(const ScenePath<Scalar>& any_path, const Placement<Scalar>& any_placement,
                                    const InstanceFrame& frame)
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
  /// The path before it is brought into the frame of the mesh.
  struct World {
    Doubles from;         ///< The start, less the placed anchor, rounded.
    Doubles way;          ///< D, less the motion.
    Doubles way_rest;     ///< What `way` leaves out.
    Doubles way_error;    ///< The sum of both is off by at most this.
    Doubles middle;       ///< The point at `moved_t`, less the placed anchor.
    Doubles error;        ///< It is off by at most this, besides its rounding.
    double length = 0;    ///< The square of the length of `way`.
    double distance = 0;  ///< The distance from the start to the placed anchor. Its parts on the axes are added.
  };

  [[gnu::always_inline]] Status place(const InstanceFrame& frame) {
    if (!frame.is_usable) return Status::rough;
    World world;
    const double along = set_way(frame, world);
    // I5
    const double t = clamped(world.length > 0 ? along / world.length : 0);
    if (!(std::fabs(t) <= 0x1p500 && world.length <= 0x1p1000 && world.distance <= 0x1p500)) return Status::rough;
    double square = 0;
    double margin = frame.radius * (1 + 0x1p-20) + frame.anchor_slack + world.distance * 0x1p-44;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double off = world.from[axis] + t * world.way[axis];
      square += off * off;
      margin += std::fabs(t) * world.way_error[axis];
    }
    if (square > margin * margin) return Status::beside;
    moved.moved_t = t;
    set_middle(frame, world);
    set_moved(frame, world);
    if (reach > 16 * frame.largest_half_size) [[unlikely]]
      return move_again(frame, world);
    return reach <= 0x1p400 && direction_error <= 0x1p400 ? Status::near : Status::rough;
  }

  /// Moves the start to where the path is nearest to the anchor in the frame of the mesh. A pose that is nearly
  /// singular can bring a near point far away.
  [[gnu::noinline]] Status move_again(const InstanceFrame& frame, World& world) {
    double back = 0;
    double length = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double way = moved.direction[axis];
      back += (moved.start[axis] - frame.anchor[axis]) * way;
      length += way * way;
    }
    const double t = clamped(moved.moved_t - (length > 0 ? back / length : 0));
    if (!(std::fabs(t) <= 0x1p500 && length <= 0x1p1000)) return Status::rough;
    // I5
    const double speed = std::sqrt(length);
    const double margin = 2 * start_error + speed * std::fabs(t) * 0x1p-50 +
                          reach * (0x1p-36 + (length > 0 ? 8 * direction_error / speed : 0));
    moved.moved_t = t;
    set_middle(frame, world);
    set_moved(frame, world);
    double square = 0;
    double radius = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double offset = moved.start[axis] - frame.anchor[axis];
      square += offset * offset;
      radius += frame.half_size[axis] * frame.half_size[axis];
    }
    const double limit = std::sqrt(radius) * (1 + 0x1p-20) + margin + 2 * start_error;
    if (square > limit * limit) return Status::beside;
    return reach <= 0x1p400 && direction_error <= 0x1p400 ? Status::near : Status::rough;
  }

  [[nodiscard]] double clamped(double t) const {
    return std::min(std::max(t, double{scene_path.range.first}), double{scene_path.range.last});
  }

  /// Sets the direction and the two distances. Returns the product of the direction and the way to the anchor.
  [[gnu::always_inline]] double set_way(const InstanceFrame& frame, World& world) const {
    const bool moves = frame.moves && scene_path.path.has_end();
    double along = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      world.from[axis] = scene_path.start[axis] - frame.placed_anchor[axis];
      auto [high, low] = scene_path.direction[axis];
      world.way_error[axis] = 0;
      if (moves) {  // I4
        const double motion = placement.motion[static_cast<Eigen::Index>(axis)];
        const double product = motion * scene_path.share;
        const DoublePair sum = exact_difference(high, product);
        low += sum[1] - std::fma(motion, scene_path.share, -product);
        world.way_error[axis] = (std::fabs(high) + std::fabs(product)) * 0x1p-100 + 0x1p-1000;
        const DoublePair whole = exact_difference(sum[0], -low);
        high = whole[0];
        low = whole[1];
      }
      world.way[axis] = high;
      world.way_rest[axis] = low;
      along -= world.from[axis] * high;
      world.length += high * high;
      world.distance += std::fabs(world.from[axis]);
    }
    return along;
  }

  /// Sets the point at `moved_t` (I6).
  [[gnu::always_inline]] void set_middle(const InstanceFrame& frame, World& world) const {
    const double t = moved.moved_t;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto [high, low] = exact_difference(scene_path.start[axis], frame.placed_anchor[axis]);
      const double step = t * world.way[axis];
      const DoublePair sum = exact_difference(high, -step);
      const double rest = sum[1] + low + std::fma(t, world.way[axis], -step) + t * world.way_rest[axis];
      world.middle[axis] = sum[0] + (rest - frame.placed_anchor_rest[axis]);
      world.error[axis] = (std::fabs(high) + std::fabs(step)) * 0x1p-98 + std::fabs(t) * world.way_error[axis] +
                          frame.placed_anchor_error[axis] + 0x1p-990;
    }
  }

  /// Brings the path into the frame of the mesh, and bounds the errors (I7).
  [[gnu::always_inline]] void set_moved(const InstanceFrame& frame, const World& world) {
    constexpr double eps = 0x1p-53;
    const double share = frame.inverse_error + 8 * eps;
    Doubles offset;
    Doubles errors;
    Doubles direction_errors;
    std::size_t fastest = 0;
    start_error = direction_error = reach = 0;
    double middle_size = 0, middle_error = 0, way_size = 0, way_error = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      middle_size = std::max(middle_size, std::fabs(world.middle[axis]));
      middle_error = std::max(middle_error, world.error[axis]);
      way_size = std::max(way_size, std::fabs(world.way[axis]));
      way_error = std::max(way_error, world.way_error[axis]);
    }
    const double start_share = share * middle_size + 2 * middle_error;
    const double direction_share = share * way_size + 2 * way_error;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Doubles& row = frame.inverse[axis];
      offset[axis] = row[0] * world.middle[0] + row[1] * world.middle[1] + row[2] * world.middle[2];
      moved.direction[axis] = row[0] * world.way[0] + row[1] * world.way[1] + row[2] * world.way[2];
      moved.start[axis] = frame.anchor[axis] + offset[axis];
      errors[axis] = frame.row_size[axis] * start_share +
                     eps * (std::fabs(moved.start[axis]) + std::fabs(offset[axis])) + 0x1p-900;
      direction_errors[axis] = frame.row_size[axis] * direction_share + 0x1p-900;
      start_error = std::max(start_error, errors[axis]);
      direction_error = std::max(direction_error, direction_errors[axis]);
      reach = std::max(reach, (std::fabs(offset[axis]) + frame.half_size[axis]) * (1 + 0x1p-40));
      if (std::fabs(moved.direction[axis]) > std::fabs(moved.direction[fastest])) fastest = axis;
    }
    reach += start_error;
    const double speed = std::fabs(moved.direction[fastest]) - direction_errors[fastest];
    // Inside the box, t is at most this far from `moved_t`. A path that hardly moves is decided exactly.
    const double time = speed > 0
                            ? (std::fabs(offset[fastest]) + errors[fastest] + 2 * frame.half_size[fastest]) / speed
                        : world.length > 0 ? std::numeric_limits<double>::infinity()
                                           : 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      moved.position_error[axis] = errors[axis] + (time > 0 ? time * direction_errors[axis] : 0);
    }
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
  const double scale = inverse_power(largest);
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
