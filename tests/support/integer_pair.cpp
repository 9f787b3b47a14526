#include "support/integer_pair.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace surehit::test {
namespace {

ExactIntegerVector operator-(const ExactIntegerVector& left, const ExactIntegerVector& right) {
  return {left[0] - right[0], left[1] - right[1], left[2] - right[2]};
}

ExactIntegerVector operator+(const ExactIntegerVector& left, const ExactIntegerVector& right) {
  return {left[0] + right[0], left[1] + right[1], left[2] + right[2]};
}

bool is_zero(const ExactIntegerVector& vector) {
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
  explicit Hull(std::array<ExactIntegerVector, 3> corners) : corners_(std::move(corners)) {
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
  [[nodiscard]] std::optional<Contact> first_contact(const ExactIntegerVector& start,
                                                     const ExactIntegerVector& direction, Interval interval) const {
    const ExactIntegerVector& base = corners_[weighted_[0]];
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

  [[nodiscard]] bool contains(const ExactIntegerVector& point) const {
    Interval here;
    here.pin({0, 1});
    return first_contact(point, {}, here).has_value();
  }

  [[nodiscard]] Side side_of_arrival(const ExactIntegerVector& direction) const {
    const mpz_class along = direction[0] * normal_[0] + direction[1] * normal_[1] + direction[2] * normal_[2];
    return along < 0 ? Side::front : along > 0 ? Side::back : Side::edge_on;
  }

 private:
  static ExactIntegerVector normal_of(const ExactIntegerVector& b, const ExactIntegerVector& c) {
    return {b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]};
  }

  std::array<ExactIntegerVector, 3> corners_;
  ExactIntegerVector normal_;
  std::size_t least_ = 0;
  std::size_t greatest_ = 0;
  std::vector<std::size_t> weighted_;
};

Interval parameters(PathKind kind, bool is_point, const QueryOptions<double>& options) {
  Interval interval;
  if (kind != PathKind::line) interval.raise_low({0, 1});
  if (kind == PathKind::segment) interval.lower_high({1, 1});
  if (is_point) interval.pin({0, 1});
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (!(options.min_t <= options.max_t) || options.min_t == infinity || options.max_t == -infinity) {
    interval.clear();
    return interval;
  }
  if (options.min_t != -infinity) interval.raise_low(Ratio(mpq_class(options.min_t)));
  if (options.max_t != infinity) interval.lower_high(Ratio(mpq_class(options.max_t)));
  return interval;
}

bool is_culled(Side side, Culling culling) {
  return (culling == Culling::back && side != Side::front) || (culling == Culling::front && side != Side::back);
}

}  // namespace

std::optional<ExactContact> first_contact(IntegerPair pair, const QueryOptions<double>& options) {
  const Hull hull(std::move(pair.corners));
  const auto& [kind, start, direction, corners] = pair;
  auto contact = hull.first_contact(start, direction, parameters(kind, is_zero(direction), options));
  if (!contact) return std::nullopt;
  const Side side = hull.side_of_arrival(direction);
  if (is_culled(side, options.culling)) return std::nullopt;
  if (options.ignore_start_contact && kind != PathKind::line && hull.contains(start)) return std::nullopt;
  if (options.ignore_end_contact && kind == PathKind::segment && hull.contains(start + direction)) return std::nullopt;
  return ExactContact{contact->t, contact->weights[1], contact->weights[2], side};
}

}  // namespace surehit::test
