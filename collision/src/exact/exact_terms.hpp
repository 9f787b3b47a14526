#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "exact/compact_int.hpp"
#include "exact/wide_int.hpp"
#include "support/inlining.hpp"

namespace surehit::detail {

/// The integers for any coordinates.
template <typename Scalar>
struct AnySize {
  /// A coordinate needs no more bits, since the unit is at least the smallest denormal.
  static constexpr int coordinate = std::numeric_limits<Scalar>::max_exponent - Decomposed<Scalar>::min_exponent;
  template <int B>
  using Int = WideInt<B>;
};

/// The integers for any coordinates of placed triangles. These are sums of products with the entries of a pose, and of
/// a motion with a share of at most 1. The entries are between 2^-64 and 2^64. POSES.md derives the sizes (I16).
template <typename Scalar>
struct PlacedSize {
  static constexpr int max_exponent = std::numeric_limits<Scalar>::max_exponent + 66;
  static constexpr int min_exponent =
      Decomposed<Scalar>::min_exponent +
      std::min(-63 - std::numeric_limits<Scalar>::digits, Decomposed<Scalar>::min_exponent);
  static constexpr int coordinate = max_exponent - min_exponent;
  template <int B>
  using Int = WideInt<B>;
};

/// The integers for coordinates that are not too far from each other in size. Most coordinates of a game are.
struct CompactSize {
  static constexpr int coordinate = 40;  ///< The most bits with which every term fits in 127 bits.
  template <int B>
  using Int = CompactInt<B>;
};

/// The maximum number of bits of each term of the exact stage. Coordinates are integers here, in units of `BinaryUnit`.
/// `Size` is one of the three above.
template <typename Size>
struct Bits {
  static constexpr int coordinate = Size::coordinate;
  static constexpr int difference = coordinate + 1;   ///< D, E1, E2 and S are differences.
  static constexpr int cross = 2 * difference + 1;    ///< D × E2, S × E1 and the normal sum two products.
  static constexpr int det = difference + cross + 2;  ///< det, T, U and V sum three products.
  static constexpr int weight = det + 1;              ///< W is such a determinant too, but det - U needs one more bit.
  static constexpr int parameter = weight;            ///< The numerator and the denominator of any t fit in this.
};

template <typename Int>
using IntVector = std::array<Int, 3>;

/// Sets out = a b - c d.
template <int Out, int A, int B>
SUREHIT_NOINLINE void set_minor(WideInt<Out>& out, const WideInt<A>& a, const WideInt<B>& b, const WideInt<A>& c,
                                const WideInt<B>& d) {
  const WideInt<A + B> product = c * d;
  out.set_product(a, b);
  out.add(product, true);
}
template <int Out, int A, int B>
void set_minor(CompactInt<Out>& out, const CompactInt<A>& a, const CompactInt<B>& b, const CompactInt<A>& c,
               const CompactInt<B>& d) {
  out.set_product(a, b);
  out.add(c * d, true);
}

template <typename Out, typename A, typename B>
void set_cross(IntVector<Out>& out, const IntVector<A>& x, const IntVector<B>& y) {
  set_minor(out[0], x[1], y[2], x[2], y[1]);
  set_minor(out[1], x[2], y[0], x[0], y[2]);
  set_minor(out[2], x[0], y[1], x[1], y[0]);
}

template <int Out, int A, int B>
SUREHIT_NOINLINE void set_dot(WideInt<Out>& out, const IntVector<WideInt<A>>& x, const IntVector<WideInt<B>>& y) {
  WideInt<A + B> product;
  out.set_product(x[0], y[0]);
  product.set_product(x[1], y[1]);
  out.add(product);
  product.set_product(x[2], y[2]);
  out.add(product);
}
template <int Out, int A, int B>
void set_dot(CompactInt<Out>& out, const IntVector<CompactInt<A>>& x, const IntVector<CompactInt<B>>& y) {
  out = x[0] * y[0];
  out.add(x[1] * y[1]);
  out.add(x[2] * y[2]);
}

template <typename Int>
bool is_zero(const IntVector<Int>& x) {
  return x[0].is_zero() && x[1].is_zero() && x[2].is_zero();
}

/// Returns an axis on which x is not zero. The vector must not be zero.
template <typename Int>
std::size_t nonzero_axis(const IntVector<Int>& x) {
  return !x[0].is_zero() ? 0 : !x[1].is_zero() ? 1 : 2;
}

/// The fraction num / den, with den > 0.
template <typename Int>
struct Ratio {
  Int num;
  Int den;

  template <typename N, typename D>
  void set(const N& numerator, const D& denominator) {
    num = numerator;
    den = denominator;
    if (den.sign() < 0) {
      num.negate();
      den.negate();
    }
  }
};

/// Returns the sign of x_num / x_den - y_num / y_den. Both denominators must be positive.
template <typename XN, typename XD, typename YN, typename YD>
int compare(const XN& x_num, const XD& x_den, const YN& y_num, const YD& y_den) {
  if (x_num.sign() != y_num.sign()) return x_num.sign() < y_num.sign() ? -1 : 1;
  return x_num.sign() * compare_products(x_num, y_den, y_num, x_den);
}

/// Returns the sign of x - y.
template <typename A, typename B>
int compare(const Ratio<A>& x, const Ratio<B>& y) {
  return compare(x.num, x.den, y.num, y.den);
}

}  // namespace surehit::detail
