#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "exact/scaled_double.hpp"
#include "shape/bounded_terms.hpp"
#include "shape/capsule_terms.hpp"
#include "surehit/shape_hit.hpp"
#include "surehit/swept_capsule.hpp"
#include "surehit/triangle.hpp"

namespace surehit::detail {

// What the decisions of moving balls and capsules in double have in common. `Number` is `Sized` or `Bounded`.

/// Sets the terms of a ball, or those of the ball in the middle of a capsule.
template <typename Number, typename Shape, typename AnyTriangle>
void set_terms(SphereTerms<Number, Number>& terms, const Shape& shape, const AnyTriangle& triangle) {
  set_differences<Number>(terms, shape, triangle);
  set_exact(terms.radius, double{shape.radius});
}

/// Sets the terms of a capsule.
template <typename Number, typename Scalar, typename AnyTriangle>
void set_terms(CapsuleTerms<Number, Number>& terms, const SweptCapsule<Scalar>& capsule, const AnyTriangle& triangle) {
  set_terms(static_cast<SphereTerms<Number, Number>&>(terms), capsule, triangle);
  for (std::size_t i = 0; i < 3; ++i) {
    set_exact(terms.half_axis[i], double{capsule.half_axis[static_cast<Eigen::Index>(i)]});
  }
}

/// The smallest and the largest size of some numbers.
class SizeRange {
 public:
  void include(const Sized& x) {
    low_ = std::min(low_, x.size == 0 ? max_sized : x.size);
    high_ = std::max(high_, x.size);
  }
  void include(const Vector<Sized>& x) {
    for (const Sized& component : x) include(component);
  }
  void include(const SphereTerms<Sized, Sized>& terms) {
    for (std::size_t k = 0; k < 3; ++k) {
      include(terms.from_corner[k]);
      include(terms.to_end[k]);
      include(terms.edge[k]);
    }
    include(terms.step);
    include(terms.radius);
  }
  /// Returns whether the premise of Z2 holds.
  [[nodiscard]] bool is_usual() const { return low_ >= min_sized && high_ <= max_sized; }

 private:
  double low_ = max_sized;
  double high_ = 0;
};

/// Returns bounds of c / (√d - b), where c > 0 > b and d ≥ 0.
template <typename Number>
[[nodiscard]] DoubleRange root(const Number& minus_b, const Number& c, const Number& d) {
  return {lower(c) / (upper(minus_b) + std::sqrt(upper(d))) * down,
          upper(c) / (lower(minus_b) + std::sqrt(lower(d))) * up};
}

/// Returns bounds of the t at which a point comes to another point (S3), like `Approach::to_point`.
template <typename Number>
[[nodiscard]] DoubleRange time_to_point(const Vector<Number>& w, const Vector<Number>& step, const Number& radius) {
  const Number b = dot(step, w);
  const Number c = dot(w, w) - radius * radius;
  return root(-b, c, b * b - dot(step, step) * c);
}

/// Returns the same for a line with the direction `e`.
template <typename Number>
[[nodiscard]] DoubleRange time_to_line(const Vector<Number>& w, const Vector<Number>& step, const Vector<Number>& e,
                                       const Number& radius) {
  const Number rr = radius * radius;
  const Vector<Number> f = cross(step, e);
  const Vector<Number> moment = cross(w, e);
  const Number ee = dot(e, e);
  const Number wf = dot(w, f);
  return root(-dot(f, moment), dot(moment, moment) - rr * ee, ee * (rr * dot(f, f) - wf * wf));
}

/// Returns the same for a plane with the normal `n`. It is t = (|h| - r √nn) / |n d| = (h² - r² nn) / (|n d| (|h| + r
/// √nn)).
template <typename Number>
[[nodiscard]] DoubleRange time_to_plane(const Vector<Number>& w, const Vector<Number>& step, const Vector<Number>& n,
                                        const Number& radius) {
  Number height = dot(n, w);
  Number rate = dot(n, step);
  (height.value < 0 ? height : rate) = -(height.value < 0 ? height : rate);
  const Number nn = dot(n, n);
  const Number c = height * height - radius * radius * nn;
  const double r = radius.value;
  return {lower(c) / ((upper(height) + r * std::sqrt(upper(nn)) * up) * up * upper(rate)) * down,
          upper(c) / ((lower(height) + r * std::sqrt(lower(nn)) * down) * down * lower(rate)) * up};
}

/// Returns bounds that hold in spite of underflow, or no bounds if they are not numbers.
[[nodiscard]] inline DoubleRange settled(const DoubleRange& range) {
  if (!(range.lower >= 0x1p-900 && range.upper <= 0x1p900)) return {0, std::numeric_limits<double>::infinity()};
  return range;
}

/// Returns (x + t y) / z, where the result is at least 0 and z is positive.
template <typename Number>
[[nodiscard]] DoubleRange weight_of(const Number& x, const Number& y, const DoubleRange& t, const Number& z) {
  // A smaller t might underflow in a product.
  if (t.upper != 0 && t.lower < 0x1p-900) return {0, std::numeric_limits<double>::infinity()};
  // Each product with an end of t is off by what y is off, and the roundings here.
  const double products[2] = {t.lower * y.value, t.upper * y.value};
  const double error =
      error_of(x) + t.upper * error_of(y) + (std::fabs(x.value) + t.upper * std::fabs(y.value)) * 0x1p-50;
  const double low = std::max(0.0, x.value + std::min(products[0], products[1]) - error * up);
  const double high = x.value + std::max(products[0], products[1]) + error * up;
  return {low * down / upper(z) * down, high * up / lower(z) * up};
}

/// Rounds the weights of b and c at a point of an edge, each by itself. `of_begin` and `of_end` return bounds of those
/// of the corners where the edge begins and where it ends. Returns false if bounds are too wide.
template <typename Scalar, typename OfBegin, typename OfEnd>
[[nodiscard]] bool try_round_edge_weights(std::size_t edge, const OfBegin& of_begin, const OfEnd& of_end,
                                          ShapeHit<Scalar>& hit) {
  if (edge == 0) return try_round(of_end(), hit.u);
  if (edge == 1) return try_round(of_begin(), hit.u) && try_round(of_end(), hit.v);
  return try_round(of_begin(), hit.v);
}

/// Does the same where the corner at the end has the weight (x + t y) / z. The numbers are those of `weight_of`.
template <typename Number, typename Scalar>
[[nodiscard]] bool try_round_edge_weights(std::size_t edge, const Number& x, const Number& y, const DoubleRange& t,
                                          const Number& z, ShapeHit<Scalar>& hit) {
  return try_round_edge_weights(
      edge, [&] { return weight_of(z - x, -y, t, z); }, [&] { return weight_of(x, y, t, z); }, hit);
}

}  // namespace surehit::detail
