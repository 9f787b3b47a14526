#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

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

// Sizes above the smallest ones and below the largest ones can be tested in lanes of doubles or floats. The product of
// six sizes is finite.
inline constexpr double smallest_double = 0x1p-150;
inline constexpr double largest_double = 0x1p160;
inline constexpr double smallest_float = 0x1p-18;
inline constexpr double largest_float = 0x1p20;

/// The numbers of a shape that the lanes need.
template <typename Number>
struct ShapeNumbers {
  std::array<Number, 3> start;         ///< The centre at t = 0.
  std::array<Number, 3> step;          ///< The centre at t = 1 less that at t = 0.
  std::array<Number, 3> inverse_step;  ///< One over each component of the step, or NaN.
  std::array<Number, 3> half;          ///< The half extents of a box, or half of a segment. A point has zeros.
  std::array<Number, 3> reach;         ///< How far the shape reaches from its centre on each axis.
  Number grown_radius;                 ///< The radius, and what covers the roundings of its products.
  Number squared_radius;               ///< Its square, likewise.
  Number size_of_step;                 ///< The largest component of the step.
  Number size;                         ///< The radius and the largest component of `half`.
  Number smallest;                     ///< What the sizes of triangles must be above. It is infinite for no triangle.
};

template <typename Scalar>
class ShapeFilter;

/// The triangles [from, last) of a list that a shape has come to.
template <typename Scalar>
struct ShapeList {
  const ShapeFilter<Scalar>* filter;  ///< The filter of the shape.
  const Scalar* corners;              ///< As in `MeshBlocks::corners`.
  std::size_t count;                  ///< The number of triangles in the whole list.
  std::size_t from;
  std::size_t last;
  double limit;  ///< Nothing counts after this t.
};

/// Some triangles of a list that a shape may touch.
struct NearTriangles {
  std::size_t list;     ///< The index of the list.
  std::size_t from;     ///< The triangle that bit 0 stands for.
  std::uint64_t found;  ///< A bit for each triangle.
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

  /// Tests many lists, before any result is used: a processor can predict neither the length of a list nor a result.
  /// Sets `near` to triangles that may be touched, and returns how many elements it has set. It moves `from` of the
  /// lists beyond what it has tested. It has tested all lists if it sets fewer than all elements.
  [[nodiscard]] static std::size_t find_near(std::span<ShapeList<Scalar>> lists, std::span<NearTriangles> near);
  /// Does for some triangles what `find` does for all. It may set as many times as a vector has lanes.
  [[nodiscard]] std::uint64_t find_times(const ShapeList<Scalar>& list, const NearTriangles& near, double limit,
                                         double* enters) const;

  // What the functions for each instruction set need.
  Core core;                     ///< What the core is.
  ShapeNumbers<double> doubles;  ///< For lanes of doubles.
  ShapeNumbers<float> floats;    ///< For lanes of floats, if they fit.
  bool fits_float = false;       ///< True if the sizes are such that the bounds hold in float.

 private:
  /// Sets all members.
  void set(Core any_core, const Vector3<Scalar>& any_start, const Vector3<Scalar>& any_end,
           const Vector3<Scalar>& any_half, Scalar any_radius);
};

/// Returns the lane with the lowest time, among the lanes of these bits. There must be one. If
/// several have it, it is the lowest lane.
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
