#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "exact/scaled_double.hpp"
#include "filter/bounded.hpp"
#include "filter/sized.hpp"
#include "placement.hpp"
#include "shape/sphere_terms.hpp"
#include "surehit/path.hpp"
#include "surehit/triangle.hpp"

namespace surehit::detail {

// What the decisions of all moving shapes in double have in common. `Number` is `Sized` or `Bounded`.

/// Sets `out` to x - y, which is rounded in `Sized` and exact in `Bounded`.
inline void set_difference(Bounded& out, double x, double y) { out = exact(x) - exact(y); }
inline void set_difference(Sized& out, double x, double y) { out = {x - y, std::fabs(x - y)}; }
inline void set_exact(Bounded& out, double x) { out = exact(x); }
inline void set_exact(Sized& out, double x) { out = {x, std::fabs(x)}; }

/// Returns the vector from y to x.
template <typename Number, typename Scalar>
[[nodiscard]] Vector<Number> difference(const Vector3<Scalar>& x, const Vector3<Scalar>& y) {
  Vector<Number> out;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    set_difference(out[i], double{x[axis]}, double{y[axis]});
  }
  return out;
}

/// Sets the differences of a shape's terms.
template <typename Number, typename Terms, typename Shape, typename Scalar>
void set_differences(Terms& terms, const Shape& shape, const Triangle<Scalar>& triangle) {
  const auto& [a, b, c] = triangle;
  const auto of = [](const auto& x, const auto& y) { return difference<Number>(x, y); };
  terms.from_corner = {of(shape.start, a), of(shape.start, b), of(shape.start, c)};
  if constexpr (requires { terms.to_end; }) terms.to_end = {of(shape.end, a), of(shape.end, b), of(shape.end, c)};
  terms.edge = {of(b, a), of(c, b), of(a, c)};
  terms.step = of(shape.end, shape.start);
}

/// Returns the image of a vector of the mesh.
template <typename Number, typename Scalar>
[[nodiscard]] Vector<Number> image_of(const Pose<Scalar>& pose, const Vector<Number>& x) {
  Vector<Number> image;
  for (std::size_t row = 0; row < 3; ++row) {
    const auto entry = [&](Eigen::Index column) {
      Number number;
      set_exact(number, double{pose.linear(static_cast<Eigen::Index>(row), column)});
      return number;
    };
    image[row] = entry(0) * x[0] + entry(1) * x[1] + entry(2) * x[2];
  }
  return image;
}

/// Does the same for a placed triangle. The shape is seen from the instance, so its end is less by its share of the
/// motion.
///
/// Z3. A term of a difference has at most four roundings here: those of a product, of two sums, and of a difference. So
///     no sum of SphereTouch has a term with more than 98 roundings, which Z1 allows. What values lose by underflow is
///     far less than that.
/// Proof. Let each difference have c of them. The longest sum is the square of a (outward·w) - b (outward·D). Each of
///     these factors has 4 c + 7, so the sum has 2 (8 c + 16) + 2. By Z2, no size of a product is below 2^-960, so what
///     a value loses by underflow is less than 2^-100 of its size.
template <typename Number, typename Terms, typename Shape, typename Scalar>
void set_differences(Terms& terms, const Shape& shape, const PlacedTriangle<Scalar>& triangle) {
  const auto& [pose, motion_given, moves] = triangle.placement;
  const auto& [a, b, c] = triangle.local;
  const auto of = [](const auto& x, const auto& y) { return difference<Number>(x, y); };
  const auto less = [](const Vector<Number>& x, const Vector<Number>& y) {
    return Vector<Number>{x[0] - y[0], x[1] - y[1], x[2] - y[2]};
  };
  const Vector3<Scalar> zero = Vector3<Scalar>::Zero();
  const std::array<Vector<Number>, 3> corners = {image_of(pose, of(a, zero)), image_of(pose, of(b, zero)),
                                                 image_of(pose, of(c, zero))};
  const Vector<Number> start = of(shape.start, pose.translation);
  Vector<Number> end = of(shape.end, pose.translation);
  terms.step = of(shape.end, shape.start);
  if (moves) {
    Vector<Number> motion = of(motion_given, zero);
    Number share;
    set_exact(share, double{triangle.share});
    for (Number& x : motion) x = x * share;
    end = less(end, motion);
    terms.step = less(terms.step, motion);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    terms.from_corner[k] = less(start, corners[k]);
    if constexpr (requires { terms.to_end; }) terms.to_end[k] = less(end, corners[k]);
  }
  terms.edge = {image_of(pose, of(b, a)), image_of(pose, of(c, b)), image_of(pose, of(a, c))};
}

/// True if the sums of boxes and capsules are short enough for Z1. Those of placed triangles have more roundings, and
/// only running bounds hold for them.
template <typename AnyTriangle>
inline constexpr bool has_short_sums = true;
template <typename Scalar>
inline constexpr bool has_short_sums<PlacedTriangle<Scalar>> = false;

/// Returns true if no product of a coordinate with an entry of a pose or a share can underflow. Both are at least
/// 2^-64.
template <typename Scalar>
[[nodiscard]] bool has_usual_images(const Triangle<Scalar>&) {
  return true;
}
template <typename Scalar>
[[nodiscard]] bool has_usual_images(const PlacedTriangle<Scalar>& triangle) {
  if constexpr (std::is_same_v<Scalar, float>) return true;
  const auto& [a, b, c] = triangle.local;
  bool is_usual = true;
  for (const Vector3<Scalar>* point : {&a, &b, &c, &triangle.placement.motion}) {
    for (const Scalar x : *point) is_usual &= x == 0 || std::fabs(double{x}) >= 0x1p-500;
  }
  return is_usual;
}

[[nodiscard]] inline double error_of(const Bounded& x) { return x.radius; }
[[nodiscard]] inline double error_of(const Sized& x) { return x.error(); }

/// Returns bounds of a sum, a product or a quotient that is known to be at least 0. Each of its numbers has an error of
/// at most its radius, and 2^-48 covers the few roundings of the bounds themselves.
inline constexpr double down = 1 - 0x1p-48;
inline constexpr double up = 1 + 0x1p-48;

template <typename Number>
[[nodiscard]] double lower(const Number& x) {
  return std::max(0.0, x.value - error_of(x)) * down;
}
template <typename Number>
[[nodiscard]] double upper(const Number& x) {
  return (x.value + error_of(x)) * up;
}

/// Rounds a number. Returns false if its bounds do not decide it.
template <typename Scalar>
[[nodiscard]] bool try_round(const DoubleRange& range, Scalar& rounded) {
  if (!(range.lower >= 0x1p-900 && range.upper <= 0x1p900)) return false;
  rounded = static_cast<Scalar>(range.lower);
  return rounded == static_cast<Scalar>(range.upper);
}

}  // namespace surehit::detail
