#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "exact/scaled_double.hpp"
#include "filter/bounded.hpp"
#include "filter/sized.hpp"
#include "shape/sphere_terms.hpp"
#include "surehit/path.hpp"

namespace surehit::detail {

// What the decisions of all moving shapes in double have in common. `Number` is `Sized` or `Bounded`.

/// Returns x - y, which is rounded in `Sized` and exact in `Bounded`.
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
