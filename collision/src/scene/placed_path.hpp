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
#include "placement.hpp"
#include "scene/instance_frame.hpp"
#include "scene/placed_lanes.hpp"
#include "support/double4.hpp"
#include "support/exact_difference.hpp"
#include "support/inlining.hpp"
#include "surehit/path.hpp"
#include "walk/grid_traversal.hpp"

namespace surehit::detail {

/// Returns the power of two that brings x into [1, 2). Returns 1 if x is 0. Outside of 2^-1000 to 2^1000, the result is
/// only a power of two.
[[nodiscard]] inline double inverse_power(double x) {
  const std::uint64_t exponent = std::bit_cast<std::uint64_t>(std::fabs(x)) >> 52;
  return x == 0 ? 1 : std::bit_cast<double>((std::uint64_t{2046} - std::min<std::uint64_t>(exponent, 2045)) << 52);
}

/// A path of a scene, in double. All of its numbers are exact, except for an overflow and the inverse.
///
/// Its alignment, and that of a placed path, is that of a vector of four doubles. Code for some instruction sets relies
/// on it, although it is not the alignment that the type has elsewhere.
template <typename Scalar>
struct alignas(32) ScenePath {
  explicit ScenePath(const Path<Scalar>& any_path, const PathRange<Scalar>& any_range, Scalar motion_share = 1)
      : path(any_path), range(any_range), share(motion_share), start(to_double4(any_path.start)) {
    const Double4 toward = to_double4(path.toward);
    if (path.has_end()) {
      const auto [high, low] = exact_difference(toward, start);
      direction = high;
      direction_rest = low;
    } else {
      direction = toward;
      direction_rest = all_lanes(0.0);
    }
    start_size = max_size(start);
    size = max_size(direction);
    const double square = sum_of_three(direction * direction);
    inverse_square = square > 0 ? 1 / square : 0;
  }

  const Path<Scalar>& path;
  const PathRange<Scalar>& range;
  Scalar share;            ///< The share of each motion that a segment sees.
  Double4 start;           ///< The start of the path.
  Double4 direction;       ///< D, rounded.
  Double4 direction_rest;  ///< What `direction` leaves out of D.
  double start_size;       ///< The largest component of `start`.
  double size;             ///< The largest component of `direction`.
  double inverse_square;   ///< The inverse of the square of the length of `direction`, or 0.
};

/// What rounds a hit of a placed path. The members have the meanings of those of `PlacedPath`.
struct CertainPath {
  std::array<double, 3> start, direction;
  double start_error, direction_error, moved_t;
};

/// A path as an instance sees it, in the frame of the mesh. POSES.md derives the errors.
template <typename Scalar>
class alignas(32) PlacedPath {
 public:
  /// What is known of the path and the instance.
  enum class Status : std::uint8_t {
    beside,  ///< The path does not come near the instance.
    near,    ///< The path may meet the instance.
    rough,   ///< The errors are not known. All triangles must be decided exactly.
  };

  // It is inlined into code for the best instruction set.
  SUREHIT_ALWAYS_INLINE PlacedPath(const ScenePath<Scalar>& any_path, const Placement<Scalar>& any_placement,
                                   const InstanceFrame& any_frame)
      : scene_path(any_path), placement(any_placement), frame(&any_frame) {
    status = place();
  }
  /// Places the path with errors as small as they can be.
  struct Carefully {};
  SUREHIT_NOINLINE PlacedPath(const ScenePath<Scalar>& any_path, const Placement<Scalar>& any_placement,
                              const InstanceFrame& any_frame, Carefully)
      : scene_path(any_path), placement(any_placement), frame(&any_frame), status(Status::rough) {
    if (frame->is_usable) status = place_carefully();
    if (status != Status::near) status = place();
  }
  /// Takes a lane of paths that were placed side by side. The lane must be among `PlacedLanes::near`.
  SUREHIT_ALWAYS_INLINE PlacedPath(const ScenePath<Scalar>& any_path, const Placement<Scalar>& any_placement,
                                   const InstanceFrame& any_frame, const PlacedLanes& lanes, std::size_t lane)
      : scene_path(any_path),
        placement(any_placement),
        frame(&any_frame),
        status(Status::near),
        start_error(lanes.start_error[lane]),
        direction_error(lanes.direction_error[lane]),
        direction_size(lanes.direction_size[lane]),
        start_size(lanes.start_size[lane]),
        reach(lanes.reach[lane]) {
    const auto set = [&](Double4& vector, const std::array<PlacedLanes::Lanes, 3>& x) {
      vector = Double4{x[0][lane], x[1][lane], x[2][lane], 0};
    };
    set(moved.start, lanes.start);
    set(moved.direction, lanes.direction);
    set(moved.position_error, lanes.position_error);
    moved.moved_t = lanes.moved_t[lane];
  }

  const ScenePath<Scalar>& scene_path;
  const Placement<Scalar>& placement;
  const InstanceFrame* frame;  ///< The frame of the instance's mesh.
  Status status;
  MovedPath moved;             ///< The path in the frame of the mesh.
  double start_error = 0;      ///< No component of `moved.start` is off by more than this.
  double direction_error = 0;  ///< No component of `moved.direction` is off by more than this.
  double direction_size = 0;   ///< The largest component of `moved.direction`.
  double start_size = 0;       ///< No component of `moved.start` is larger than this, but for a rounding.
  double reach = 0;            ///< No component of the exact S of any triangle is larger than this.

  /// Returns the same path with errors as small as they can be. Stage 2 decides and rounds more with it.
  [[nodiscard]] PlacedPath refined() const {
    PlacedPath fine = *this;
    if (status == Status::near && !is_fine_) fine.status = fine.place_carefully();
    return fine.status == Status::near ? fine : *this;
  }

  /// Returns what rounds a hit.
  [[nodiscard]] CertainPath certain() const {
    return {{moved.start[0], moved.start[1], moved.start[2]},
            {moved.direction[0], moved.direction[1], moved.direction[2]},
            start_error,
            direction_error,
            moved.moved_t};
  }
  /// Returns the power of two by which the kernel's direction is longer. A t of the kernel counts that much less.
  [[nodiscard]] double kernel_scale() const {
    return direction_size >= 0x1p-30 && direction_size <= 0x1p30 ? 1 : inverse_power(direction_size);
  }
  /// Returns the path for the kernel of the mesh. Its sizes include the errors (I8). Its t is
  /// (t - moved_t) / kernel_scale.
  template <typename MeshScalar>
  [[nodiscard]] KernelPath<MeshScalar> kernel_path() const;
  /// Returns the weights of the range for the kernel. If one of its ends is no MeshScalar, nothing is certain.
  template <typename MeshScalar>
  [[nodiscard]] RangeWeights<MeshScalar> kernel_weights() const;

 private:
  /// Does the same for any range.
  template <typename MeshScalar>
  [[nodiscard]] RangeWeights<MeshScalar> weights_of_range() const;

  SUREHIT_ALWAYS_INLINE Status place() {
    if (!frame->is_usable) return Status::rough;
    if (frame->moves && scene_path.path.has_end()) return place_carefully();
    const auto& rest = frame->near_rest;
    const Double4 from = scene_path.start - frame->placed_anchor - Double4{rest[0], rest[1], rest[2], 0};
    const Double4& way = scene_path.direction;
    const double distance = sum_of_three(absolute(from));
    const double best_t = clamped(-sum_of_three(from * way) * scene_path.inverse_square);
    const double t = rounded(best_t);
    if (!is_moderate(t, distance)) return Status::rough;
    // I5
    const Double4 middle = from + t * way;
    const double margin = frame->radius * (1 + 0x1p-20) + frame->near_slack + 0x1p-500 + distance * 0x1p-44 +
                          2 * std::fabs(t - best_t) * scene_path.size;
    if (sum_of_three(middle * middle) > margin * margin) return Status::beside;
    // I6
    const double middle_error = frame->near_slack + (distance + max_size(middle)) * 0x1p-51;
    if (!(middle_error <= 0x1p-36 * frame->radius)) return place_carefully();
    moved.moved_t = t;
    set_moved(middle, middle_error, way, 0);
    if (reach > 16 * frame->largest_half_size) [[unlikely]]
      return place_carefully();
    return misses_box() ? Status::beside : Status::near;
  }

  /// Returns true if the path misses the mesh's box in its range (I10).
  SUREHIT_ALWAYS_INLINE [[nodiscard]] bool misses_box() const {
    const Double4 offset = moved.start - frame->anchor;
    const Double4 grown = frame->half_size + moved.position_error + (start_size + 3 * frame->half_size) * 0x1p-45;
    const Long4 moves = absolute(moved.direction) >= 0x1p-500;
    const Double4 inverse = 1 / choose(moves, moved.direction, all_lanes(1.0));
    const Double4 middle_time = -offset * inverse;
    const Double4 half_time = grown * absolute(inverse);
    const auto outward = [](double t, double share) { return t + std::fabs(t) * share; };
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const Double4 enters = choose(moves, middle_time - half_time, all_lanes(-infinity));
    const Double4 leaves = choose(moves, middle_time + half_time, all_lanes(infinity));
    const double first = outward(double{scene_path.range.first} - moved.moved_t, -0x1p-50);
    const double last = outward(double{scene_path.range.last} - moved.moved_t, 0x1p-50);
    return std::max({first, enters[0], enters[1], enters[2]}) > std::min({last, leaves[0], leaves[1], leaves[2]});
  }

  /// A path before it is brought into the frame of the mesh, in pairs of doubles.
  struct World {
    Double4 way;          ///< D, less the motion.
    Double4 way_rest;     ///< What `way` leaves out.
    double way_error;     ///< No component of the sum of both is off by more than this.
    Double4 middle;       ///< The point at `moved_t`, less the placed anchor.
    double middle_error;  ///< No component of it is off by more than this, besides its rounding.
  };

  /// Does the same with pairs of doubles. Paths that move against the instance need this. So do instances far from the
  /// scene's origin, and poses that are nearly singular.
  SUREHIT_NOINLINE Status place_carefully() {
    is_fine_ = true;
    World world;
    set_way(world);
    const Double4 from = scene_path.start - frame->placed_anchor;
    const double distance = sum_of_three(absolute(from));
    const double square = sum_of_three(world.way * world.way);
    const double best_t = clamped(square > 0 ? -sum_of_three(from * world.way) / square : 0);
    const double t = rounded(best_t);
    if (!is_moderate(t, distance) || !(square <= 0x1p1000)) return Status::rough;
    // I5
    const Double4 off = from + t * world.way;
    const double way_size = max_size(world.way);
    const double margin = frame->radius * (1 + 0x1p-20) + frame->anchor_slack + 0x1p-500 + distance * 0x1p-44 +
                          2 * std::fabs(t - best_t) * way_size + 3 * std::fabs(t) * world.way_error;
    if (sum_of_three(off * off) > margin * margin) return Status::beside;
    moved.moved_t = t;
    set_middle(world);
    set_moved(world.middle, world.middle_error, world.way, world.way_error);
    if (reach > 16 * frame->largest_half_size) return move_again(world);
    return reach <= 0x1p400 && direction_error <= 0x1p400 ? Status::near : Status::rough;
  }

  /// Moves the start to where the path is nearest to the anchor in the frame of the mesh. A pose that is nearly
  /// singular can bring a near point far away.
  SUREHIT_NOINLINE Status move_again(World& world) {
    const Double4& direction = moved.direction;
    const double length = sum_of_three(direction * direction);
    const double back = sum_of_three((moved.start - frame->anchor) * direction);
    const double t = clamped(moved.moved_t - (length > 0 ? back / length : 0));
    if (!(std::fabs(t) <= 0x1p500 && length <= 0x1p1000)) return Status::rough;
    // I5
    const double speed = std::sqrt(length);
    const double margin = 2 * start_error + speed * std::fabs(t) * 0x1p-50 +
                          reach * (0x1p-36 + (length > 0 ? 8 * direction_error / speed : 0));
    moved.moved_t = t;
    set_middle(world);
    set_moved(world.middle, world.middle_error, world.way, world.way_error);
    const Double4 offset = moved.start - frame->anchor;
    const double radius = std::sqrt(sum_of_three(frame->half_size * frame->half_size));
    const double limit = radius * (1 + 0x1p-20) + margin + 2 * start_error;
    if (sum_of_three(offset * offset) > limit * limit) return Status::beside;
    return reach <= 0x1p400 && direction_error <= 0x1p400 ? Status::near : Status::rough;
  }

  [[nodiscard]] double clamped(double t) const {
    return std::min(std::max(t, double{scene_path.range.first}), double{scene_path.range.last});
  }
  /// Rounds the t to which the start is moved, so that the ends of most ranges have a float as their distance from it.
  /// For a segment, it becomes a multiple of 2^-20, and otherwise a float.
  [[nodiscard]] double rounded(double t) const {
    constexpr double unit = 0x1.8p32;  // The last place of numbers of this size is 2^-20.
    if (scene_path.path.has_end()) return (t + unit) - unit;
    return std::fabs(t) < 0x1p100 ? double{static_cast<float>(t)} : t;
  }
  /// Returns false if a product might overflow, or lose too much by underflow.
  [[nodiscard]] bool is_moderate(double t, double distance) const {
    const bool has_moderate_size = scene_path.size == 0 || (scene_path.size >= 0x1p-400 && scene_path.size <= 0x1p499);
    return has_moderate_size && std::fabs(t) <= 0x1p500 && distance <= 0x1p500;
  }

  /// Sets the direction (I4).
  void set_way(World& world) const {
    world.way = scene_path.direction;
    world.way_rest = scene_path.direction_rest;
    world.way_error = 0;
    if (!frame->moves || !scene_path.path.has_end()) return;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double high = world.way[axis];
      const double motion = placement.motion[static_cast<Eigen::Index>(axis)];
      const double product = motion * scene_path.share;
      const DoublePair sum = exact_difference(high, product);
      const double low = world.way_rest[axis] + (sum[1] - std::fma(motion, scene_path.share, -product));
      const double error = (std::fabs(high) + std::fabs(product)) * 0x1p-100 + 0x1p-1000;
      const DoublePair whole = exact_difference(sum[0], -low);
      world.way[axis] = whole[0];
      world.way_rest[axis] = whole[1];
      world.way_error = std::max(world.way_error, error);
    }
  }

  /// Sets the point at `moved_t` (I6).
  void set_middle(World& world) const {
    const double t = moved.moved_t;
    const auto [high, low] = exact_difference(scene_path.start, frame->placed_anchor);
    const Double4 step = t * world.way;
    Double4 step_rest = all_lanes(0.0);
    for (std::size_t axis = 0; axis < 3; ++axis) step_rest[axis] = std::fma(t, world.way[axis], -step[axis]);
    const auto [sum, sum_rest] = exact_difference(high, -step);
    const Double4 rest = sum_rest + low + step_rest + t * world.way_rest;
    world.middle = sum + (rest - frame->placed_anchor_rest);
    world.middle_error = max_lane(absolute(high) + absolute(step)) * 0x1p-98 + std::fabs(t) * world.way_error +
                         frame->largest_placed_anchor_error + 0x1p-990;
  }

  /// Brings the path into the frame of the mesh, and bounds the errors (I7).
  SUREHIT_ALWAYS_INLINE void set_moved(const Double4& middle, double middle_error, const Double4& way,
                                       double way_error) {
    constexpr double eps = 0x1p-53;
    Double4 offset = middle;
    Double4 direction = way;
    if (frame->is_turned) {
      const auto& columns = frame->inverse;
      offset = columns[0] * middle[0] + columns[1] * middle[1] + columns[2] * middle[2];
      direction = columns[0] * way[0] + columns[1] * way[1] + columns[2] * way[2];
    }
    const Double4 start = frame->anchor + offset;
    const double offset_size = max_size(offset);
    direction_size = max_size(direction);
    start_size = frame->anchor_size + offset_size;
    const double share = frame->inverse_error + 8 * eps;
    const double start_share = share * max_size(middle) + 2 * middle_error;
    const double direction_share = share * max_size(way) + 2 * way_error;
    const double rounding = eps * (start_size + 2 * offset_size) + 0x1p-900;
    start_error = frame->largest_row_size * start_share + rounding;
    direction_error = frame->largest_row_size * direction_share + 0x1p-900;
    reach = (offset_size + frame->largest_half_size) * (1 + 0x1p-40) + start_error;
    const double speed = direction_size - direction_error;
    // Inside the box, t is at most this far from `moved_t`. A path that hardly moves is decided exactly.
    const double time =
        speed > 0 ? (offset_size + start_error + 2 * frame->largest_half_size) / speed : still_time(way);
    const Double4 position_error =
        frame->row_size * (start_share + time * direction_share) + (rounding + time * 0x1p-900);
    moved.start = start;
    moved.direction = direction;
    moved.position_error = position_error;
  }
  /// Returns the time for a path that may stand still in the frame of the mesh.
  static double still_time(const Double4& way) {
    return max_size(way) > 0 ? std::numeric_limits<double>::infinity() : 0;
  }

  bool is_fine_ = false;  ///< True if the path was placed carefully.
};

template <typename Scalar>
template <typename MeshScalar>
SUREHIT_ALWAYS_INLINE inline KernelPath<MeshScalar> PlacedPath<Scalar>::kernel_path() const {
  constexpr double mesh_eps = std::numeric_limits<MeshScalar>::epsilon() / 2;
  constexpr bool is_rounded = std::is_same_v<MeshScalar, float>;
  constexpr double smallest = is_rounded ? 0x1p-149 : 0;
  const double scale = kernel_scale();
  const double way_size = direction_size * scale;
  // I8
  const double start_off = start_error + (is_rounded ? mesh_eps * start_size + smallest : 0);
  const double direction_off = direction_error * scale + (is_rounded ? mesh_eps * way_size + smallest : 0);
  const double full_reach = (reach + start_off + start_off * (1 / (8 * mesh_eps))) * (1 + 0x1p-20);
  const double d_size = (way_size + direction_off * (1 / (8 * mesh_eps))) * (1 + 0x1p-20);
  constexpr double max_size = double{KernelBound<MeshScalar>::largest_size} / 4;
  const bool is_small = std::max({start_size, full_reach, d_size}) <= max_size;
  const double known_size = is_small ? d_size : std::numeric_limits<double>::infinity();
  KernelPath<MeshScalar> kernel;
  if constexpr (is_rounded) {
    kernel.set(to_float(with_fourth(moved.start, full_reach)),
               to_float(with_fourth(moved.direction * scale, known_size)));
  } else {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      kernel.start[axis] = moved.start[axis];
      kernel.d[axis] = moved.direction[axis] * scale;
    }
    kernel.reach = full_reach;
    kernel.d_size = known_size;
  }
  return kernel;
}

template <typename Scalar>
template <typename MeshScalar>
SUREHIT_ALWAYS_INLINE inline RangeWeights<MeshScalar> PlacedPath<Scalar>::kernel_weights() const {
  const PathRange<Scalar>& range = scene_path.range;
  const bool is_whole = scene_path.path.has_end() && range.first == 0 && range.last == 1;
  if (is_whole && kernel_scale() == 1 && rounded(moved.moved_t) == moved.moved_t) {
    // `moved_t` is a multiple of 2^-20, and so is its distance from 1.
    return RangeWeights<MeshScalar>::of_part(static_cast<MeshScalar>(-moved.moved_t),
                                             static_cast<MeshScalar>(1 - moved.moved_t));
  }
  return weights_of_range<MeshScalar>();
}

template <typename Scalar>
template <typename MeshScalar>
SUREHIT_NOINLINE RangeWeights<MeshScalar> PlacedPath<Scalar>::weights_of_range() const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  bool is_exact = true;
  // Returns the number for the kernel of an end of the range. If it is none, the range has no such end.
  const auto end_of = [&](double t, double none) {
    const DoublePair difference = exact_difference(t, moved.moved_t);
    const double end = difference[0] / kernel_scale();
    const bool is_moderate = end == 0 || (std::fabs(end) >= 0x1p-900 && std::fabs(end) <= 0x1p100);
    if (difference[1] == 0 && is_moderate && double{static_cast<MeshScalar>(end)} == end) {
      return static_cast<MeshScalar>(end);
    }
    is_exact &= std::isinf(t);
    return static_cast<MeshScalar>(none);
  };
  const PathRange<Scalar>& range = scene_path.range;
  RangeWeights<MeshScalar> weights(PathRange<MeshScalar>(end_of(range.first, -infinity), end_of(range.last, infinity)));
  weights.decides &= is_exact;
  return weights;
}

}  // namespace surehit::detail
