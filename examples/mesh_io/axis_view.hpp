#pragma once

#include <array>
#include <cmath>
#include <surehit/intersect.hpp>

namespace surehit::example {

/// Points of space as they are seen along one axis, which points towards the eye. Nothing here is rounded.
template <typename Scalar>
class AxisView {
 public:
  using Point = std::array<Scalar, 3>;

  explicit AxisView(std::size_t axis) : axis_(axis) {}

  [[nodiscard]] Scalar x(const Point& point) const { return point[(axis_ + 1) % 3]; }
  [[nodiscard]] Scalar y(const Point& point) const { return point[(axis_ + 2) % 3]; }

  [[nodiscard]] bool coincide(const Point& a, const Point& b) const { return x(a) == x(b) && y(a) == y(b); }

  /// 1 where a, b and c turn left, -1 where they turn right, 0 where they are on one line or coincide.
  [[nodiscard]] int orientation(const Point& a, const Point& b, const Point& c) const {
    // Corners that coincide are often asked about, and edges along an axis: a product without a factor is not rounded.
    const bool left_is_zero = x(a) == x(c) || y(b) == y(c);
    const bool right_is_zero = y(a) == y(c) || x(b) == x(c);
    if ((left_is_zero && right_is_zero) || coincide(a, b)) return 0;
    const double left = (double{x(a)} - double{x(c)}) * (double{y(b)} - double{y(c)});
    const double right = (double{y(a)} - double{y(c)}) * (double{x(b)} - double{x(c)});
    const double size = std::fabs(left) + std::fabs(right);
    const double determinant = left - right;
    if (size > min_size && std::fabs(determinant) > relative_error * size) return determinant > 0 ? 1 : -1;
    return exact_orientation(a, b, c);
  }

 private:
  // Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates" (1997), section 4.2.
  // The determinant is off by less than (3 + 16 e) e times the size, e = 2^-53, as long as nothing underflows. What
  // underflows adds less than 2^-1073, and there is room for that from `min_size` on. What overflows is no number or
  // infinite, and then the comparison fails.
  static constexpr double relative_error = 4 * 0x1p-53;
  static constexpr double min_size = 0x1p-900;

  /// The library decides: a line of sight through a corner meets the triangle, and the side tells how it turns.
  [[nodiscard]] int exact_orientation(const Point& a, const Point& b, const Point& c) const {
    Vector3<Scalar> towards_eye = Vector3<Scalar>::Zero();
    towards_eye[static_cast<Eigen::Index>(axis_)] = 1;
    const auto vector = [](const Point& point) { return Vector3<Scalar>(point[0], point[1], point[2]); };
    const Triangle<Scalar> triangle{vector(a), vector(b), vector(c)};
    const auto hit = intersect(Line<Scalar>{triangle.a, towards_eye}, triangle);
    if (!hit || hit->side == Side::edge_on) return 0;
    return hit->side == Side::back ? 1 : -1;
  }

  std::size_t axis_;
};

}  // namespace surehit::example
