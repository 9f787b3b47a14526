#pragma once

#include <algorithm>

#include "exact/exact_terms.hpp"
#include "exact/root_rounding.hpp"
#include "exact/scaled_double.hpp"
#include "exact/wide_int.hpp"
#include "support/inlining.hpp"

namespace surehit::detail {

/// The lower root of a t² + 2 b t + c, where a > 0 and b² ≥ a c. B is the number of bits of a, b and c.
///
/// Signs of polynomials in the coefficients decide the order of two roots, as for arcs of circles in Devillers,
/// Fronville, Mourrain and Teillaud (2002), "Algebraic methods and arithmetic filtering for exact predicates on circle
/// arcs". SHAPES.md has the lemmas.
template <int B>
struct QuadraticRoot {
  WideInt<B> a;
  WideInt<B> b;
  WideInt<B> c;

  using Discriminant = WideInt<2 * B + 1>;

  /// Returns b² - a c.
  [[nodiscard]] SUREHIT_NOINLINE Discriminant discriminant() const {
    Discriminant result = b * b;
    const WideInt<2 * B> product = a * c;
    result.add(product, true);
    return result;
  }

  /// Returns bounds of a root of a quadratic with b < 0 < c. It is c / (√(b² - a c) - b), a quotient of sums without
  /// cancellation.
  [[nodiscard]] SUREHIT_NOINLINE DoubleRange range() const {
    const ScaledDouble root = sqrt(ScaledDouble::of_magnitude(discriminant()));
    return range_of(ScaledDouble::of_magnitude(c) / (root + ScaledDouble::of_magnitude(b)));
  }

  /// Returns the sign of the root less x = m 2^e, where m ≥ 0 has at most 55 bits and e ≤ 0 (QR1).
  template <typename Scalar>
  [[nodiscard]] SUREHIT_NOINLINE int compare(const Dyadic& x) const {
    constexpr int shift = 1 - Decomposed<Scalar>::min_exponent;
    const int up = std::max(0, -x.exponent);
    const WideInt<55> m = WideInt<55>::shifted(x.significand, 0, false);
    // This is a x + b, and then (a x + b) x + b x + c, times 2^up and 2^2up.
    WideInt<B + shift + 57> slope = a * m;
    WideInt<B + shift> raised = b;
    raised.shift_left(up);
    slope.add(raised);
    if (slope.sign() > 0) return -1;
    WideInt<B + 2 * shift + 113> value;
    slope.add(raised);
    value.set_product(slope, m);
    WideInt<B + 2 * shift> constant = c;
    constant.shift_left(2 * up);
    value.add(constant);
    return value.sign();
  }

  /// Returns the sign of the root less a Scalar in (0, 1].
  template <typename Scalar>
  [[nodiscard]] int compare(Scalar x) const {
    const Decomposed<Scalar> parts(x);
    return compare<Scalar>(Dyadic{parts.significand, parts.exponent});
  }

  /// Returns the root, which must be in (0, 1], rounded once to nearest. It must have b < 0 < c.
  template <typename Scalar>
  [[nodiscard]] Scalar rounded() const {
    return round_between<Scalar>(range(), [&](const Dyadic& x) { return compare<Scalar>(x); });
  }
};

/// Returns the sign of a root less another one (QR2 to QR4).
template <int B>
class RootOrder {
 public:
  RootOrder(const QuadraticRoot<B>& x, const QuadraticRoot<B>& y) : x_(x), y_(y) {
    set_minor(ab_, x.a, y.b, x.b, y.a);
    set_minor(ac_, x.a, y.c, x.c, y.a);
  }

  [[nodiscard]] SUREHIT_NOINLINE int sign() const {
    const int root_of_x = x_.discriminant().sign();
    const int root_of_y = y_.discriminant().sign();
    // The sign of left = ab - y.a √dx, and then that of left + x.a √dy.
    const int left = ab_.sign() <= 0 ? (ab_.sign() < 0 || root_of_x > 0 ? -1 : 0) : root_of_x == 0 ? 1 : sign_of_j();
    if (left >= 0) return left > 0 ? 1 : root_of_y;
    if (root_of_y == 0) return -1;
    // Both parts are not zero, and of opposite signs, so their squares decide. The sign is that of 2 ab √dx - k.
    const int k = -sign_of_k();
    const int root = ab_.sign() * root_of_x;
    if (k == root || root == 0) return k;
    if (k == 0) return root;
    return k * sign_of_resultant();
  }

 private:
  using Minor = WideInt<2 * B + 1>;

  /// Returns the sign of j = x.a y.b² - 2 y.a x.b y.b + y.a² x.c, which is that of ab² - y.a² dx.
  [[nodiscard]] SUREHIT_NOINLINE int sign_of_j() const {
    // It is y.b ab - y.a (y.a... ) in the minors: y.b (x.a y.b - x.b y.a) - y.a (x.b y.b - y.a x.c).
    WideInt<3 * B + 4> result = y_.b * ab_;
    Minor inner = x_.b * y_.b;
    {
      const WideInt<2 * B> product = y_.a * x_.c;
      inner.add(product, true);
    }
    const WideInt<3 * B + 1> product = y_.a * inner;
    result.add(product, true);
    return result.sign();
  }
  /// Returns the sign of k = x.a ac - 2 x.b ab.
  [[nodiscard]] SUREHIT_NOINLINE int sign_of_k() const {
    WideInt<3 * B + 4> result = x_.a * ac_;
    const WideInt<3 * B + 1> product = x_.b * ab_;
    result.add(product, true);
    result.add(product, true);
    return result.sign();
  }
  /// Returns the sign of the resultant ac² - 4 ab bc.
  [[nodiscard]] SUREHIT_NOINLINE int sign_of_resultant() const {
    WideInt<4 * B + 8> result = ac_ * ac_;
    WideInt<4 * B + 4> product;
    {
      Minor bc;
      set_minor(bc, x_.b, y_.c, x_.c, y_.b);
      product.set_product(ab_, bc);
    }
    product.shift_left(2);
    result.add(product, true);
    return result.sign();
  }

  const QuadraticRoot<B>& x_;
  const QuadraticRoot<B>& y_;
  Minor ab_;  ///< x.a y.b - x.b y.a
  Minor ac_;  ///< x.a y.c - x.c y.a
};

}  // namespace surehit::detail
