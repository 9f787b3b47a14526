#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "exact/wide_int.hpp"

namespace surehit::detail {

/// The maximum number of bits of each term of the exact stage. Coordinates are integers here, in units of `BinaryUnit`.
template <typename Scalar>
struct Bits {
  /// A coordinate needs no more, since the unit is at least the smallest denormal.
  static constexpr int coordinate = std::numeric_limits<Scalar>::max_exponent - Decomposed<Scalar>::min_exponent;
  static constexpr int difference = coordinate + 1;   ///< D, E1, E2 and S are differences.
  static constexpr int cross = 2 * difference + 1;    ///< D × E2, S × E1 and the normal sum two products.
  static constexpr int det = difference + cross + 2;  ///< det, T, U and V sum three products.
  static constexpr int weight = det + 1;              ///< W is such a determinant too, but det - U needs one more bit.
  static constexpr int limit = 2 * coordinate;        ///< A limit on t has its own bits, shifted by `t_exponent`.
  static constexpr int parameter = weight;            ///< The numerator and the denominator of any t fit in this.
};

template <int B>
using WideVector = std::array<WideInt<B>, 3>;

/// Sets out = a b - c d.
template <int Out, int A, int B>
[[gnu::noinline]] void set_minor(WideInt<Out>& out, const WideInt<A>& a, const WideInt<B>& b, const WideInt<A>& c,
                                 const WideInt<B>& d) {
  const WideInt<A + B> product = c * d;
  out.set_product(a, b);
  out.add(product, true);
}

template <int Out, int A, int B>
void set_cross(WideVector<Out>& out, const WideVector<A>& x, const WideVector<B>& y) {
  set_minor(out[0], x[1], y[2], x[2], y[1]);
  set_minor(out[1], x[2], y[0], x[0], y[2]);
  set_minor(out[2], x[0], y[1], x[1], y[0]);
}

template <int Out, int A, int B>
[[gnu::noinline]] void set_dot(WideInt<Out>& out, const WideVector<A>& x, const WideVector<B>& y) {
  WideInt<A + B> product;
  out.set_product(x[0], y[0]);
  product.set_product(x[1], y[1]);
  out.add(product);
  product.set_product(x[2], y[2]);
  out.add(product);
}

template <int B>
bool is_zero(const WideVector<B>& x) {
  return x[0].is_zero() && x[1].is_zero() && x[2].is_zero();
}

/// Returns an axis on which x is not zero. The vector must not be zero.
template <int B>
std::size_t nonzero_axis(const WideVector<B>& x) {
  return !x[0].is_zero() ? 0 : !x[1].is_zero() ? 1 : 2;
}

/// The fraction num / den, with den > 0.
template <int B>
struct Ratio {
  WideInt<B> num;
  WideInt<B> den;

  template <int N, int D>
  void set(const WideInt<N>& numerator, const WideInt<D>& denominator) {
    num = numerator;
    den = denominator;
    if (den.sign() < 0) {
      num.negate();
      den.negate();
    }
  }
};

/// Returns the sign of x_num / x_den - y_num / y_den. Both denominators must be positive.
template <int XN, int XD, int YN, int YD>
int compare(const WideInt<XN>& x_num, const WideInt<XD>& x_den, const WideInt<YN>& y_num, const WideInt<YD>& y_den) {
  if (x_num.sign() != y_num.sign()) return x_num.sign() < y_num.sign() ? -1 : 1;
  return x_num.sign() * compare_products(x_num, y_den, y_num, x_den);
}

/// Returns the sign of x - y.
template <int A, int B>
int compare(const Ratio<A>& x, const Ratio<B>& y) {
  return compare(x.num, x.den, y.num, y.den);
}

}  // namespace surehit::detail
