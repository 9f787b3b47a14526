#include "support/one_root_number.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <type_traits>

#include "support/dyadic.hpp"

namespace surehit::test {
namespace {

/// The sign of x + y √d.
int sign_of(const mpz_class& x, const mpz_class& y, const mpz_class& d) {
  const int of_root = sgn(d) == 0 ? 0 : sgn(y);
  const int of_rest = sgn(x);
  if (of_root == 0 || of_root == of_rest) return of_rest;
  if (of_rest == 0) return of_root;
  return of_rest * cmp(x * x, y * y * d);
}

/// The sign of x + y √d + z √e.
int sign_of(const mpz_class& x, const mpz_class& y, const mpz_class& d, const mpz_class& z, const mpz_class& e) {
  const int of_root = sgn(e) == 0 ? 0 : sgn(z);
  const int of_rest = sign_of(x, y, d);
  if (of_root == 0 || of_root == of_rest) return of_rest;
  if (of_rest == 0) return of_root;
  return of_rest * sign_of(x * x + y * y * d - z * z * e, 2 * x * y, d);
}

template <typename Scalar>
using Bits = std::conditional_t<sizeof(Scalar) == 4, std::uint32_t, std::uint64_t>;

template <typename Scalar>
bool is_even(Scalar x) {
  return (std::bit_cast<Bits<Scalar>>(x) & 1) == 0;
}

/// The sign of the exact number less a dyadic one.
int compare(const OneRootNumber& exact, const Dyadic& x) {
  if (x.is_zero()) return exact.sign();
  return exact.compare(x.in_units_of(x.exponent()), x.exponent());
}

/// The sign of the exact number less the middle between two Scalars.
template <typename Scalar>
int compare_middle(const OneRootNumber& exact, Scalar x, Scalar y) {
  return compare(exact, Dyadic(0.5) * (Dyadic(double{x}) + Dyadic(double{y})));
}

mpz_class parse_integer(const std::string& text) {
  mpz_class number;
  if (number.set_str(text, 10) != 0) throw std::invalid_argument(text + " is not a whole number");
  return number;
}

}  // namespace

int OneRootNumber::sign() const { return sign_of(p, q, d); }

int OneRootNumber::compare(const mpz_class& number, long exponent) const {
  const auto shift = static_cast<mp_bitcnt_t>(std::abs(exponent));
  if (exponent >= 0) return sign_of(p - (number << shift) * r, q, d);
  return sign_of((p << shift) - number * r, q << shift, d);
}

int OneRootNumber::compare(const OneRootNumber& other) const {
  return sign_of(p * other.r - other.p * r, q * other.r, d, -other.q * r, other.d);
}

template <typename Scalar>
bool is_nearest(Scalar x, const OneRootNumber& exact) {
  if (!(x >= 0 && x <= 1) || std::signbit(x)) return false;
  const int over = compare_middle(exact, x, std::nextafter(x, Scalar{2}));
  if (over > 0 || (over == 0 && !is_even(x))) return false;
  if (x == 0) return exact.sign() >= 0;
  const int under = compare_middle(exact, x, std::nextafter(x, Scalar{0}));
  return under > 0 || (under == 0 && is_even(x));
}

template <typename Scalar>
Scalar nearest(const OneRootNumber& exact) {
  // The bits of numbers that are not negative have the order of the numbers.
  Bits<Scalar> low = 0;
  auto high = std::bit_cast<Bits<Scalar>>(Scalar{1});
  while (low < high) {
    const Bits<Scalar> middle = low + (high - low + 1) / 2;
    if (compare(exact, Dyadic(double{std::bit_cast<Scalar>(middle)})) >= 0) {
      low = middle;
    } else {
      high = middle - 1;
    }
  }
  const auto below = std::bit_cast<Scalar>(low);
  const Scalar above = std::nextafter(below, Scalar{2});
  const int side = compare_middle(exact, below, above);
  return side < 0 || (side == 0 && is_even(below)) ? below : above;
}

std::string text_of(const QuadraticRoot& root) {
  const OneRootNumber exact = root.number();
  if (mpz_perfect_square_p(exact.d.get_mpz_t()) != 0) {
    mpq_class rational(exact.p + exact.q * sqrt(exact.d), exact.r);
    rational.canonicalize();
    return rational.get_num().get_str() + '/' + rational.get_den().get_str();
  }
  const mpz_class middle = 2 * root.b;
  const mpz_class common = gcd(gcd(root.a, middle), root.c);
  std::string text = root.is_upper ? "upper" : "lower";
  for (const mpz_class& factor : {root.a, middle, root.c}) text += ':' + mpz_class(factor / common).get_str();
  return text;
}

OneRootNumber parse_root(const std::string& text) {
  const auto slash = text.find('/');
  if (slash != std::string::npos) {
    const mpz_class whole = parse_integer(text.substr(slash + 1));
    if (whole <= 0) throw std::invalid_argument(text + " has no positive denominator");
    return {parse_integer(text.substr(0, slash)), 0, 0, whole};
  }
  const auto first = text.find(':');
  const auto second = text.find(':', first + 1);
  const auto third = text.find(':', second + 1);
  const std::string which = text.substr(0, first);
  if ((which != "lower" && which != "upper") || second == std::string::npos || third == std::string::npos) {
    throw std::invalid_argument(text + " is no root");
  }
  const mpz_class a = parse_integer(text.substr(first + 1, second - first - 1));
  const mpz_class b = parse_integer(text.substr(second + 1, third - second - 1));
  const mpz_class c = parse_integer(text.substr(third + 1));
  const mpz_class discriminant = b * b - 4 * a * c;
  if (a <= 0 || discriminant < 0) throw std::invalid_argument(text + " is no root");
  return {-b, which == "upper" ? 1 : -1, discriminant, 2 * a};
}

template bool is_nearest(float, const OneRootNumber&);
template bool is_nearest(double, const OneRootNumber&);
template float nearest(const OneRootNumber&);
template double nearest(const OneRootNumber&);

}  // namespace surehit::test
