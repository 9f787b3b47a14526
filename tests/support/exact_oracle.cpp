#include "support/exact_oracle.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace surehit::test {
namespace {

using IntegerVector = std::array<mpz_class, 3>;

/// A power of two that divides all coordinates of a pair. Coordinates are counted in it as integers. Neither t nor a
/// weight depends on the unit. Rationals would lose time, because each of their sums and products is reduced by common
/// divisors.
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
  [[nodiscard]] IntegerVector count(const Vector3<Scalar>& vector) const {
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

IntegerVector operator-(const IntegerVector& left, const IntegerVector& right) {
  return {left[0] - right[0], left[1] - right[1], left[2] - right[2]};
}

bool is_zero(const IntegerVector& vector) {
  return std::all_of(vector.begin(), vector.end(), [](const mpz_class& x) { return x == 0; });
}

/// Not reduced until it is asked for: to compare, two products are enough.
class Ratio {
 public:
  Ratio(mpz_class numerator, mpz_class denominator)
      : numerator_(std::move(numerator)), denominator_(std::move(denominator)) {
    if (denominator_ < 0) {
      numerator_ = -numerator_;
      denominator_ = -denominator_;
    }
  }
  explicit Ratio(const mpq_class& x) : numerator_(x.get_num()), denominator_(x.get_den()) {}

  [[nodiscard]] const mpz_class& numerator() const { return numerator_; }
  [[nodiscard]] const mpz_class& denominator() const { return denominator_; }
  [[nodiscard]] mpq_class reduced() const {
    mpq_class x(numerator_, denominator_);
    x.canonicalize();
    return x;
  }
  friend bool operator<(const Ratio& left, const Ratio& right) {
    return left.numerator_ * right.denominator_ < right.numerator_ * left.denominator_;
  }

 private:
  mpz_class numerator_;
  mpz_class denominator_;
};

/// A linear function of t.
struct Linear {
  mpz_class constant;
  mpz_class rate;

  [[nodiscard]] Ratio root() const { return {-constant, rate}; }
  /// Its value at t, over the divisor.
  [[nodiscard]] Ratio over(const mpz_class& divisor, const Ratio& t) const {
    return {constant * t.denominator() + rate * t.numerator(), divisor * t.denominator()};
  }
};

/// A closed interval of parameters; an end that is not there is infinite.
class Interval {
 public:
  void raise_low(const Ratio& bound) {
    if (!low_ || *low_ < bound) low_ = bound;
  }
  void lower_high(const Ratio& bound) {
    if (!high_ || bound < *high_) high_ = bound;
  }
  void pin(const Ratio& value) {
    raise_low(value);
    lower_high(value);
  }
  /// Keeps the t for which the function is not negative.
  void keep_nonnegative(const Linear& function) {
    if (function.rate == 0) {
      empty_ = empty_ || function.constant < 0;
    } else if (function.rate > 0) {
      raise_low(function.root());
    } else {
      lower_high(function.root());
    }
  }
  void clear() { empty_ = true; }
  [[nodiscard]] bool is_empty() const { return empty_ || (low_ && high_ && *high_ < *low_); }
  [[nodiscard]] const Ratio& low() const { return *low_; }

 private:
  std::optional<Ratio> low_;
  std::optional<Ratio> high_;
  bool empty_ = false;
};

/// One coordinate's equation: the sum of weights[i] w[i] equals right.constant + right.rate t.
struct Equation {
  std::vector<mpz_class> weights;
  Linear right;
};

/// Gauss-Jordan elimination without division: brings the weights' coefficients to a diagonal matrix of positive numbers
/// in the first equations, and to zero in those behind. The columns of the coefficients are independent of each other.
void eliminate(std::array<Equation, 3>& equations, std::size_t weight_count) {
  for (std::size_t column = 0; column < weight_count; ++column) {
    const auto pivot = std::find_if(equations.begin() + static_cast<std::ptrdiff_t>(column), equations.end(),
                                    [&](const Equation& equation) { return equation.weights[column] != 0; });
    std::swap(*pivot, equations[column]);
    Equation& chosen = equations[column];
    if (chosen.weights[column] < 0) {
      for (mpz_class& weight : chosen.weights) weight = -weight;
      chosen.right = {-chosen.right.constant, -chosen.right.rate};
    }
    // Positive, so the diagonal of the equations before stays so.
    const mpz_class& divisor = chosen.weights[column];
    for (std::size_t row = 0; row < equations.size(); ++row) {
      if (row == column || equations[row].weights[column] == 0) continue;
      const mpz_class factor = equations[row].weights[column];
      const auto combine = [&](mpz_class& term, const mpz_class& of_chosen) {
        term = divisor * term - factor * of_chosen;
      };
      for (std::size_t i = 0; i < weight_count; ++i) combine(equations[row].weights[i], chosen.weights[i]);
      combine(equations[row].right.constant, chosen.right.constant);
      combine(equations[row].right.rate, chosen.right.rate);
    }
  }
}

/// The convex hull of those of the triangle's corners that carry weight: three, two or one.
class Hull {
 public:
  explicit Hull(std::array<IntegerVector, 3> corners) : corners_(std::move(corners)) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (corners_[i] < corners_[least_]) least_ = i;
      if (corners_[i] > corners_[greatest_]) greatest_ = i;
    }
    normal_ = normal_of(corners_[1] - corners_[0], corners_[2] - corners_[0]);
    if (!is_zero(normal_)) {
      weighted_ = {0, 1, 2};
    } else if (least_ != greatest_) {
      weighted_ = {least_, greatest_};
    } else {
      weighted_ = {least_};
    }
  }

  struct Contact {
    mpq_class t;
    std::array<mpq_class, 3> weights;
  };

  /// The least t of the interval at which start + t direction lies in the hull.
  ///
  /// Every point of the hull is corner 0 plus the weighted spans from corner 0 to the others. Solving for the weights
  /// leaves them as linear functions of t, which each cut the interval, and equations in t alone, which pin it.
  [[nodiscard]] std::optional<Contact> first_contact(const IntegerVector& start, const IntegerVector& direction,
                                                     Interval interval) const {
    const IntegerVector& base = corners_[weighted_[0]];
    const std::size_t span_count = weighted_.size() - 1;
    std::array<Equation, 3> equations;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t i = 1; i <= span_count; ++i) {
        equations[axis].weights.emplace_back(corners_[weighted_[i]][axis] - base[axis]);
      }
      equations[axis].right = {start[axis] - base[axis], direction[axis]};
    }
    eliminate(equations, span_count);

    for (std::size_t i = span_count; i < equations.size(); ++i) {
      const Linear& zero = equations[i].right;
      if (zero.rate != 0) {
        interval.pin(zero.root());
      } else if (zero.constant != 0) {
        interval.clear();
      }
    }
    if (interval.is_empty()) return std::nullopt;

    // The weight of corner 0 is what the others leave of 1: all of them over one divisor.
    mpz_class divisor = 1;
    Linear remainder{1, 0};
    for (std::size_t i = 0; i < span_count; ++i) {
      const mpz_class& own = equations[i].weights[i];
      const Linear& weight = equations[i].right;
      interval.keep_nonnegative(weight);
      remainder = {remainder.constant * own - divisor * weight.constant, remainder.rate * own - divisor * weight.rate};
      divisor *= own;
    }
    interval.keep_nonnegative(remainder);
    if (interval.is_empty()) return std::nullopt;

    const Ratio& t = interval.low();
    Contact contact{t.reduced(), {}};
    for (std::size_t i = 0; i < span_count; ++i) {
      contact.weights[weighted_[i + 1]] = equations[i].right.over(equations[i].weights[i], t).reduced();
    }
    contact.weights[weighted_[0]] = remainder.over(divisor, t).reduced();
    return contact;
  }

  [[nodiscard]] bool contains(const IntegerVector& point) const {
    Interval here;
    here.pin({0, 1});
    return first_contact(point, {}, here).has_value();
  }

  [[nodiscard]] Side side_of_arrival(const IntegerVector& direction) const {
    const mpz_class along = direction[0] * normal_[0] + direction[1] * normal_[1] + direction[2] * normal_[2];
    return along < 0 ? Side::front : along > 0 ? Side::back : Side::edge_on;
  }

 private:
  static IntegerVector normal_of(const IntegerVector& b, const IntegerVector& c) {
    return {b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]};
  }

  std::array<IntegerVector, 3> corners_;
  IntegerVector normal_;
  std::size_t least_ = 0;
  std::size_t greatest_ = 0;
  std::vector<std::size_t> weighted_;
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

template <typename Scalar>
Interval parameters(const Path<Scalar>& path, bool is_point, const QueryOptions<Scalar>& options) {
  Interval interval;
  if (path.has_start()) interval.raise_low({0, 1});
  if (path.has_end()) interval.lower_high({1, 1});
  if (is_point) interval.pin({0, 1});
  constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
  if (!(options.min_t <= options.max_t) || options.min_t == infinity || options.max_t == -infinity) {
    interval.clear();
    return interval;
  }
  if (options.min_t != -infinity) interval.raise_low(Ratio(mpq_class(double{options.min_t})));
  if (options.max_t != infinity) interval.lower_high(Ratio(mpq_class(double{options.max_t})));
  return interval;
}

bool is_culled(Side side, Culling culling) {
  return (culling == Culling::back && side != Side::front) || (culling == Culling::front && side != Side::back);
}

}  // namespace

template <typename Scalar>
std::optional<ExactContact> exact_contact(const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                                          const QueryOptions<Scalar>& options) {
  if (!is_finite(path, triangle) || is_apart(path, triangle)) return std::nullopt;

  const Unit unit(path, triangle);
  const IntegerVector start = unit.count(path.start);
  const IntegerVector toward = unit.count(path.toward);
  const IntegerVector direction = path.kind == PathKind::segment ? toward - start : toward;
  const Hull hull({unit.count(triangle.a), unit.count(triangle.b), unit.count(triangle.c)});
  auto contact = hull.first_contact(start, direction, parameters(path, is_zero(direction), options));
  if (!contact) return std::nullopt;
  const Side side = hull.side_of_arrival(direction);
  if (is_culled(side, options.culling)) return std::nullopt;
  if (options.ignore_start_contact && path.has_start() && hull.contains(start)) return std::nullopt;
  if (options.ignore_end_contact && path.has_end() && hull.contains(toward)) return std::nullopt;
  return ExactContact{contact->t, contact->weights[1], contact->weights[2], side};
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
