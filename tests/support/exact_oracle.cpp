#include "support/exact_oracle.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <type_traits>
#include <utility>

namespace surehit::test {
namespace {

/// A power of two that divides all coordinates of a pair. Coordinates are counted in it as integers.
class Unit {
 public:
  template <typename Scalar>
  Unit(const Path<Scalar>& path, const Triangle<Scalar>& triangle) {
    for (const auto& vector : {path.start, path.toward, triangle.a, triangle.b, triangle.c}) {
      for (const Scalar x : vector) {
        if (x != 0) exponent_ = std::min(exponent_, std::ilogb(x) - (std::numeric_limits<Scalar>::digits - 1));
      }
    }
  }

  template <typename Scalar>
  [[nodiscard]] ExactIntegerVector count(const Vector3<Scalar>& vector) const {
    return {count(double{vector[0]}), count(double{vector[1]}), count(double{vector[2]})};
  }

 private:
  [[nodiscard]] mpz_class count(double x) const {
    if (x == 0) return 0;
    constexpr int digits = std::numeric_limits<double>::digits;
    int exponent = 0;
    const mpz_class significand = std::ldexp(std::frexp(x, &exponent), digits);
    // A float has trailing zeros to shift out.
    const int shift = exponent - digits - exponent_;
    const auto digits_shifted = static_cast<mp_bitcnt_t>(std::abs(shift));
    return shift < 0 ? mpz_class(significand >> digits_shifted) : mpz_class(significand << digits_shifted);
  }

  int exponent_ = std::numeric_limits<double>::max_exponent;
};

template <typename Scalar>
bool is_finite(const Path<Scalar>& path, const Triangle<Scalar>& triangle) {
  return path.start.allFinite() && path.toward.allFinite() && triangle.a.allFinite() && triangle.b.allFinite() &&
         triangle.c.allFinite();
}

/// Whether one coordinate alone keeps path and triangle apart. Comparisons of Scalars are exact, and spare most
/// rationals.
template <typename Scalar>
bool is_apart(const Path<Scalar>& path, const Triangle<Scalar>& triangle) {
  constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    Scalar low = path.start[axis];
    Scalar high = path.start[axis];
    if (path.kind == PathKind::segment) {
      low = std::min(low, path.toward[axis]);
      high = std::max(high, path.toward[axis]);
    } else if (path.toward[axis] != 0) {
      if (path.kind == PathKind::line || path.toward[axis] < 0) low = -infinity;
      if (path.kind == PathKind::line || path.toward[axis] > 0) high = infinity;
    }
    const auto [least, greatest] = std::minmax({triangle.a[axis], triangle.b[axis], triangle.c[axis]});
    if (high < least || greatest < low) return true;
  }
  return false;
}

}  // namespace

template <typename Scalar>
std::optional<ExactContact> exact_contact(const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                                          const QueryOptions<Scalar>& options) {
  if (!is_finite(path, triangle) || is_apart(path, triangle)) return std::nullopt;

  const Unit unit(path, triangle);
  IntegerPair pair{path.kind,
                   unit.count(path.start),
                   unit.count(path.toward),
                   {unit.count(triangle.a), unit.count(triangle.b), unit.count(triangle.c)}};
  if (path.kind == PathKind::segment) {
    for (std::size_t axis = 0; axis < 3; ++axis) pair.direction[axis] -= pair.start[axis];
  }
  QueryOptions<double> in_double;
  in_double.min_t = options.min_t;
  in_double.max_t = options.max_t;
  in_double.culling = options.culling;
  in_double.ignore_start_contact = options.ignore_start_contact;
  in_double.ignore_end_contact = options.ignore_end_contact;
  return first_contact(std::move(pair), in_double);
}

template <typename Scalar>
Scalar nearest(const mpq_class& x) {
  using Limits = std::numeric_limits<Scalar>;
  using Bits = std::conditional_t<sizeof(Scalar) == 4, std::uint32_t, std::uint64_t>;
  constexpr long min_quantum = Limits::min_exponent - Limits::digits;

  const mpq_class magnitude = abs(x);
  if (magnitude == 0) return 0;
  // The bit lengths tell the binary exponent to within one; the power of two itself tells it exactly.
  long exponent = static_cast<long>(mpz_sizeinbase(magnitude.get_num_mpz_t(), 2)) -
                  static_cast<long>(mpz_sizeinbase(magnitude.get_den_mpz_t(), 2));
  const auto over_power_of_two = [&](long power) {
    mpq_class quotient;
    if (power >= 0) {
      mpq_div_2exp(quotient.get_mpq_t(), magnitude.get_mpq_t(), static_cast<mp_bitcnt_t>(power));
    } else {
      mpq_mul_2exp(quotient.get_mpq_t(), magnitude.get_mpq_t(), static_cast<mp_bitcnt_t>(-power));
    }
    return quotient;
  };
  if (over_power_of_two(exponent) < 1) --exponent;

  const long quantum = std::max(exponent - (Limits::digits - 1), min_quantum);
  const Bits infinity = std::bit_cast<Bits>(Limits::infinity());
  Bits bits = infinity;
  if (exponent < Limits::max_exponent) {
    const mpq_class quanta = over_power_of_two(quantum);
    mpz_class whole = quanta.get_num() / quanta.get_den();
    const int against_half = cmp(mpq_class(quanta - whole), mpq_class(1, 2));
    if (against_half > 0 || (against_half == 0 && mpz_odd_p(whole.get_mpz_t()))) ++whole;
    // The leading bit of a normal significand adds the last 1 to the exponent field, and so does a carry out of it.
    bits = static_cast<Bits>((static_cast<Bits>(quantum - min_quantum) << (Limits::digits - 1)) + whole.get_ui());
  }
  const Scalar result = std::bit_cast<Scalar>(std::min(bits, infinity));
  return x < 0 && bits != 0 ? -result : result;
}

template std::optional<ExactContact> exact_contact(const Path<float>&, const Triangle<float>&,
                                                   const QueryOptions<float>&);
template std::optional<ExactContact> exact_contact(const Path<double>&, const Triangle<double>&,
                                                   const QueryOptions<double>&);
template float nearest<float>(const mpq_class&);
template double nearest<double>(const mpq_class&);

}  // namespace surehit::test
