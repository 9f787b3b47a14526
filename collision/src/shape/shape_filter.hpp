#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "surehit/swept_box.hpp"
#include "surehit/swept_capsule.hpp"
#include "surehit/swept_sphere.hpp"

namespace surehit::detail {

/// What a moving shape consists of: all points that are at most the radius from its core.
enum class Core : std::uint8_t {
  point,    ///< The centre.
  box,      ///< A box whose faces are along the axes.
  segment,  ///< A segment with the centre in its middle.
};

/// Finds out which triangles of a list a moving shape may touch, many of them at once. What it leaves out is certainly
/// not touched.
template <typename Scalar>
class ShapeFilter {
 public:
  explicit ShapeFilter(const SweptBox<Scalar>& box);
  explicit ShapeFilter(const SweptSphere<Scalar>& sphere);
  explicit ShapeFilter(const SweptCapsule<Scalar>& capsule);

  static constexpr std::size_t max_count = 64;  ///< The maximum number of triangles in a call.
  /// The times of a call. The shape does not touch triangle i of the call before `enters[i]`.
  using Times = std::array<double, max_count + 16>;

  /// Returns a bit for each of the triangles [from, from + max_count) of a list that the shape may touch before or at
  /// t = `limit`. The list has `count` triangles with the layout of `MeshBlocks::corners`.
  [[nodiscard]] std::uint64_t find(const Scalar* corners, std::size_t count, std::size_t from, double limit,
                                   Times& enters) const;

  static constexpr double smallest_float = 0x1p-20;  ///< Sizes above this can be tested in float,
  static constexpr double largest_float = 0x1p20;    ///< if they are below this.

  // What the functions for each instruction set need.
  Core core;                           ///< What the core is.
  std::array<double, 3> start;         ///< The centre at t = 0.
  std::array<double, 3> end;           ///< The centre at t = 1.
  std::array<double, 3> step;          ///< The difference of the two, rounded.
  std::array<double, 3> inverse_step;  ///< One over each component of the step, or NaN.
  std::array<double, 3> half;          ///< The half extents of a box, or half of a segment. A point has zeros.
  double radius;                       ///< The radius.
  double size_of_half;                 ///< The largest component of `half`.
  double size_of_step;                 ///< The largest component of the step.
  bool is_usable;                      ///< True if the sizes of these numbers are such that the bounds hold.
  bool fits_float;                     ///< The same for bounds in float.

 private:
  /// Sets all members.
  void set(Core any_core, const Vector3<Scalar>& any_start, const Vector3<Scalar>& any_end,
           const Vector3<Scalar>& any_half, Scalar any_radius);
};

/// Returns the lane with the lowest time, among the lanes of these bits. There must be one. Of several, it is the
/// lowest lane.
template <typename Times>
[[nodiscard]] std::size_t first_to_enter(std::uint64_t lanes, const Times& enters) {
  auto first = static_cast<std::size_t>(std::countr_zero(lanes));
  for (lanes &= lanes - 1; lanes != 0; lanes &= lanes - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
    if (enters[lane] < enters[first]) first = lane;
  }
  return first;
}

}  // namespace surehit::detail
