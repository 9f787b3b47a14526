#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "shape/shape_filter.hpp"
#include "support/rounding_flags.hpp"

// What the lanes of the filter need of a shape.

namespace surehit::detail {
namespace {

/// Returns whether the sizes of V5 hold for a step and all other numbers of a shape.
bool are_between(double smallest, double size_of_step, double largest_number, double largest) {
  return (size_of_step == 0 || size_of_step > smallest) && largest_number < largest;
}

template <typename Number>
void convert(const std::array<double, 3>& from, std::array<Number, 3>& to) {
  for (std::size_t i = 0; i < 3; ++i) to[i] = static_cast<Number>(from[i]);
}

}  // namespace

template <typename Scalar>
void ShapeFilter<Scalar>::set(Core any_core, const Vector3<Scalar>& any_start, const Vector3<Scalar>& any_end,
                              const Vector3<Scalar>& any_half, Scalar any_radius) {
  // The inverse of a smaller step might not be finite, in float or in double.
  const double least = std::is_same_v<Scalar, float> ? 0x1p-100 : 0x1p-1000;
  core = any_core;
  const double radius = any_radius;
  double size_of_half = 0;
  double size_of_step = 0;
  double size_of_ends = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    const double half = any_half[axis];
    const double step = double{any_end[axis]} - double{any_start[axis]};
    const double size = std::fabs(step);
    doubles.start[i] = any_start[axis];
    doubles.step[i] = step;
    doubles.half[i] = half;
    doubles.reach[i] = radius + std::fabs(half);
    doubles.inverse_step[i] = size >= least && size <= 0x1p1000 ? 1 / step : std::numeric_limits<double>::quiet_NaN();
    size_of_half = std::max(size_of_half, std::fabs(half));
    size_of_step = std::max(size_of_step, size);
    size_of_ends = std::max({size_of_ends, std::fabs(double{any_start[axis]}), std::fabs(double{any_end[axis]})});
  }
  doubles.grown_radius = radius * (1 + 256 * 0x1p-53);
  doubles.squared_radius = radius * radius * (1 + 16 * 0x1p-53);
  doubles.size_of_step = size_of_step;
  doubles.size = radius + size_of_half;
  const bool is_usable =
      are_between(smallest_double, size_of_step, std::max({radius, size_of_half, size_of_ends}), largest_double);
  doubles.smallest = is_usable ? smallest_double : std::numeric_limits<double>::infinity();
  if constexpr (std::is_same_v<Scalar, float>) {
    fits_float =
        are_between(smallest_float, size_of_step, std::max({radius, size_of_half, size_of_step}), largest_float);
    if (!fits_float) return;
    convert(doubles.start, floats.start);
    convert(doubles.step, floats.step);
    convert(doubles.half, floats.half);
    convert(doubles.reach, floats.reach);
    convert(doubles.inverse_step, floats.inverse_step);
    floats.grown_radius = static_cast<float>(radius * (1 + 256 * 0x1p-24));
    floats.squared_radius = static_cast<float>(radius * radius * (1 + 16 * 0x1p-24));
    floats.size_of_step = static_cast<float>(size_of_step);
    floats.size = static_cast<float>(doubles.size);
    floats.smallest = static_cast<float>(smallest_float);
  }
}

template <typename Scalar>
ShapeFilter<Scalar>::ShapeFilter(const SweptBox<Scalar>& box) {
  set(Core::box, box.start, box.end, box.half_extents, 0);
}
template <typename Scalar>
ShapeFilter<Scalar>::ShapeFilter(const SweptSphere<Scalar>& sphere) {
  set(Core::point, sphere.start, sphere.end, {0, 0, 0}, sphere.radius);
}
template <typename Scalar>
ShapeFilter<Scalar>::ShapeFilter(const SweptCapsule<Scalar>& capsule) {
  set(Core::segment, capsule.start, capsule.end, capsule.half_axis, capsule.radius);
}

template ShapeFilter<float>::ShapeFilter(const SweptBox<float>&);
template ShapeFilter<double>::ShapeFilter(const SweptBox<double>&);
template ShapeFilter<float>::ShapeFilter(const SweptSphere<float>&);
template ShapeFilter<double>::ShapeFilter(const SweptSphere<double>&);
template ShapeFilter<float>::ShapeFilter(const SweptCapsule<float>&);
template ShapeFilter<double>::ShapeFilter(const SweptCapsule<double>&);

}  // namespace surehit::detail
