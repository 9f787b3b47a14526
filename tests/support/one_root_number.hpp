#pragma once

#include <gmpxx.h>

#include <string>

namespace surehit::test {

/// The number (p + q √d) / r in whole numbers, with d ≥ 0 and r > 0. Comparisons of such numbers are exact.
struct OneRootNumber {
  mpz_class p = 0;
  mpz_class q = 0;
  mpz_class d = 0;
  mpz_class r = 1;

  /// Returns (constant + rate x) / whole, for a positive `whole`.
  [[nodiscard]] OneRootNumber linear(const mpz_class& constant, const mpz_class& rate, const mpz_class& whole) const {
    return {constant * r + rate * p, rate * q, d, whole * r};
  }
  /// Returns the sign of this number.
  [[nodiscard]] int sign() const;
  /// Returns the sign of the difference to a number 2^exponent.
  [[nodiscard]] int compare(const mpz_class& number, long exponent) const;
  /// Returns the sign of the difference to another such number.
  [[nodiscard]] int compare(const OneRootNumber& other) const;
};

/// Returns whether x is the Scalar nearest to a number in [0, 1], ties to even. Zero must be +0.
template <typename Scalar>
[[nodiscard]] bool is_nearest(Scalar x, const OneRootNumber& exact);

/// Returns the Scalar nearest to a number in [0, 1], ties to even.
template <typename Scalar>
[[nodiscard]] Scalar nearest(const OneRootNumber& exact);

/// A root of a x² + 2 b x + c, with a > 0 and b² ≥ a c.
struct QuadraticRoot {
  mpz_class a = 1;
  mpz_class b = 0;
  mpz_class c = 0;
  bool is_upper = false;

  [[nodiscard]] OneRootNumber number() const { return {-b, is_upper ? 1 : -1, b * b - a * c, a}; }
};

/// Returns a root as text that says it exactly: `P/Q` if it is rational, and else `lower:A:B:C` or `upper:A:B:C` for
/// that root of A x² + B x + C. The whole numbers have no common factor, and Q and A are positive.
[[nodiscard]] std::string text_of(const QuadraticRoot& root);

/// Returns the number that such a text says. Throws std::invalid_argument if it says none.
[[nodiscard]] OneRootNumber parse_root(const std::string& text);

}  // namespace surehit::test
