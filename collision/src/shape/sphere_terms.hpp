#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "exact/wide_int.hpp"
#include "filter/bounded.hpp"
#include "filter/sized.hpp"
#include "shape/sphere_contact.hpp"

namespace surehit::detail {

/// Vectors of any numbers with +, - and *. Each operation of exact integers returns a longer type.
template <typename Number>
using Vector = std::array<Number, 3>;

template <typename A, typename B>
[[nodiscard]] auto dot(const Vector<A>& x, const Vector<B>& y) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

template <typename A, typename B>
[[nodiscard]] auto cross(const Vector<A>& x, const Vector<B>& y) {
  return Vector<decltype(x[0] * y[0] - x[0] * y[0])>{x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2],
                                                     x[0] * y[1] - x[1] * y[0]};
}

/// A moving ball and a triangle, in differences. Edge k goes from corner k to the next one.
template <typename Difference, typename Radius>
struct SphereTerms {
  std::array<Vector<Difference>, 3> from_corner;  ///< The start less each corner.
  std::array<Vector<Difference>, 3> to_end;       ///< The end less each corner.
  std::array<Vector<Difference>, 3> edge;         ///< The edges.
  Vector<Difference> step;                        ///< The end less the start.
  Radius radius;                                  ///< The radius. It is not negative.
};

/// Returns the triangle's normal, which is as long as twice its area.
template <typename Terms>
[[nodiscard]] auto normal_of(const Terms& terms) {
  return cross(terms.edge[0], terms.edge[1]);
}

[[nodiscard]] inline Bounded negated(const Bounded& x) { return -x; }
[[nodiscard]] inline Sized negated(const Sized& x) { return -x; }
template <int Bits>
[[nodiscard]] WideInt<Bits> negated(WideInt<Bits> x) {
  x.negate();
  return x;
}

/// Asks numbers for their signs, and notes if one is not certain. An uncertain sign counts as 0, and what follows from
/// it has no meaning.
class Signs {
 public:
  template <typename Number>
  requires requires(const Number& x) { x.value; }
  [[nodiscard]] int of(const Number& x) {
    const std::optional<int> sign = x.sign();
    is_certain_ &= sign.has_value();
    return sign.value_or(0);
  }
  template <int Bits>
  [[nodiscard]] int of(const WideInt<Bits>& x) {
    return x.sign();
  }
  /// Returns the sign of x + y √d, where d must not be negative.
  template <typename X, typename Y, typename D>
  [[nodiscard]] int with_root(const X& x, const Y& y, const D& d) {
    const int of_x = of(x);
    const int of_root = of(y) * of(d);
    if (of_x == of_root || of_root == 0) return of_x;
    if (of_x == 0) return of_root;
    return of_x * of(x * x - y * y * d);
  }
  /// Returns the sign of x √c - y √d, where c and d must not be negative.
  template <typename X, typename C, typename Y, typename D>
  [[nodiscard]] int of_roots(const X& x, const C& c, const Y& y, const D& d) {
    const int first = of(x) * of(c);
    const int second = of(y) * of(d);
    if (first != second) return first < second ? -1 : 1;
    return first == 0 ? 0 : first * of(x * x * c - y * y * d);
  }
  /// Returns true if all signs were certain.
  [[nodiscard]] bool is_certain() const { return is_certain_; }

 private:
  bool is_certain_ = true;
};

}  // namespace surehit::detail
