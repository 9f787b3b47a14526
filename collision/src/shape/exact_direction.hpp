#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "exact/quadratic_root.hpp"
#include "exact/root_rounding.hpp"
#include "exact/scaled_double.hpp"
#include "shape/sphere_terms.hpp"
#include "support/inlining.hpp"
#include "surehit/path.hpp"

namespace surehit::detail {

/// A number as its sign and its size.
struct SignedSize {
  int sign = 0;
  ScaledDouble size;
};

/// A vector of any length.
///
/// Let eps be 2^-53.
///
/// N1. A component is off by at most 9 eps of itself.
/// Proof. The size of an integer is off by 2 eps, and a root by half of what its square is off, and eps. Numbers are
///     only added if they have the same sign. So p + q √d is off by 5 eps for the product, and eps for the sum. If p
///     and q √d have opposite signs, it is a quotient of an integer and such a sum: 2 + 6 + 1 eps.
using Direction = std::array<SignedSize, 3>;

template <int Bits>
[[nodiscard]] Direction direction_of(const Vector<WideInt<Bits>>& x) {
  Direction direction;
  for (std::size_t i = 0; i < 3; ++i) direction[i] = {x[i].sign(), ScaledDouble::of_magnitude(x[i])};
  return direction;
}

/// Returns the direction of x + t y at a root t.
template <int Root, int X, int Y>
[[nodiscard]] SUREHIT_NOINLINE Direction direction_at(const QuadraticRoot<Root>& t, const Vector<WideInt<X>>& x,
                                                      const Vector<WideInt<Y>>& y) {
  // t is (-b - √d) / a, so this is (a x - b y - y √d) / a.
  constexpr int bits = Root + std::max(X, Y) + 1;
  RootNumber<bits, Y, 2 * Root + 1, 1> component;
  component.d = t.discriminant();
  Direction direction;
  for (std::size_t i = 0; i < 3; ++i) {
    component.p = t.a * x[i];
    {
      const auto product = t.b * y[i];
      component.p.add(product, true);
    }
    component.q = negated(y[i]);
    direction[i] = {sign_with_root(component.p, component.q, component.d), component.size()};
  }
  return direction;
}

/// Returns the direction of n, or that of -n if w is on the other side of the plane across n.
template <typename N, typename W>
[[nodiscard]] Direction direction_of_plane(const Vector<N>& n, const Vector<W>& w) {
  const int side = dot(n, w).sign();
  Direction direction = direction_of(n);
  for (SignedSize& component : direction) component.sign *= side;
  return direction;
}

/// Returns x less its part along e, times e·e.
template <typename X, typename E>
[[nodiscard]] auto across(const Vector<X>& x, const Vector<E>& e) {
  return cross(e, cross(x, e));
}

/// Returns the unit vector of a direction, or zero if it has no length.
///
/// N2. Each component is off by less than 12 eps, which is 6 ulp(1) in double.
/// Proof. Let n be a component of the exact result. By N1, the vector turns by what moves n by at most 2 n (1 - n²) 9
/// eps,
///     less than 7 eps. The sum of squares, the root and the quotient are 3.5 eps, as in `normal`. What underflows is
///     below 2^-1000.
template <typename Scalar>
[[nodiscard]] Vector3<Scalar> unit_of(const Direction& direction) {
  int exponent = 0;
  bool is_zero = true;
  for (const SignedSize& x : direction) {
    if (x.sign == 0) continue;
    exponent = is_zero ? x.size.exponent : std::max(exponent, x.size.exponent);
    is_zero = false;
  }
  if (is_zero) return Vector3<Scalar>::Zero();
  std::array<double, 3> x;
  for (std::size_t i = 0; i < 3; ++i) {
    const int below = std::max(direction[i].size.exponent - exponent, -2000);
    x[i] = direction[i].sign * std::ldexp(direction[i].size.value, below);
  }
  const double length = std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
  return {static_cast<Scalar>(x[0] / length), static_cast<Scalar>(x[1] / length), static_cast<Scalar>(x[2] / length)};
}

}  // namespace surehit::detail
