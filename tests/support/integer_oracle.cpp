#include "support/integer_oracle.hpp"

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "support/exact_oracle.hpp"
#include "support/same_bits.hpp"

namespace surehit::test {
namespace {

__extension__ using Int128 = __int128;

/// significand 2^exponent, the significand odd or zero.
struct Dyadic {
  std::int64_t significand = 0;
  int exponent = 0;
};

template <typename Scalar>
Dyadic dyadic(Scalar x) {
  constexpr int digits = std::numeric_limits<Scalar>::digits;
  int exponent = 0;
  const auto significand = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), digits));
  if (significand == 0) return {};
  const int zeros = std::countr_zero(static_cast<std::uint64_t>(significand));
  return {significand >> zeros, exponent - digits + zeros};
}

/// A pair's coordinates, counted in the lowest binary digit that any of them uses.
struct DyadicPair {
  /// The path's start and its end or direction, then the corners.
  std::array<std::array<Dyadic, 3>, 5> points;
  int low = std::numeric_limits<int>::max();
  int high = std::numeric_limits<int>::min();

  template <typename Scalar>
  DyadicPair(const Path<Scalar>& path, const Triangle<Scalar>& triangle) {
    const std::array given = {&path.start, &path.toward, &triangle.a, &triangle.b, &triangle.c};
    for (std::size_t i = 0; i < given.size(); ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const Dyadic& number = points[i][axis] = dyadic((*given[i])[static_cast<Eigen::Index>(axis)]);
        if (number.significand == 0) continue;
        const auto magnitude = static_cast<std::uint64_t>(std::abs(number.significand));
        low = std::min(low, number.exponent);
        high = std::max(high, number.exponent + static_cast<int>(std::bit_width(magnitude)));
      }
    }
  }

  /// All coordinates are below two to this.
  [[nodiscard]] int bits() const { return high > low ? high - low : 0; }
};

/// Let coordinates be below 2^k. Then their differences are below 2^(k+1), and a cross product's components are below
/// 2^(2k+3). A determinant is below 3 · 2^(k+1) · 2^(2k+3) < 2^(3k+6). 127 bits hold this for k up to 40.
constexpr int max_bits_across = 40;
/// In the plane, weights over their common denominator are below 2^(2k+3). The third of them and each bound of t are
/// below 2^(2k+5). What compares two bounds, or puts one into a weight, is below 2^(4k+11).
constexpr int max_bits_in_plane = 29;

/// numerator / denominator, with a positive denominator.
template <typename Integer>
struct Quotient {
  Integer numerator;
  Integer denominator;

  friend bool operator<(const Quotient& x, const Quotient& y) {
    return x.numerator * y.denominator < y.numerator * x.denominator;
  }
};

template <typename Integer>
struct IntegerContact {
  Quotient<Integer> t;
  Quotient<Integer> u = {0, 1};
  Quotient<Integer> v = {0, 1};
  Side side = Side::edge_on;
};

/// Coordinates and their differences are Narrow, products of them Wide.
template <typename Narrow, typename Wide>
class NarrowPair {
 public:
  NarrowPair(const DyadicPair& pair, PathKind kind)
      : has_start_(kind != PathKind::line), has_end_(kind == PathKind::segment) {
    const auto point = [&](std::size_t i) {
      NarrowVector scaled;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const Dyadic& number = pair.points[i][axis];
        scaled[axis] = number.significand;
        if (number.significand != 0) scaled[axis] <<= static_cast<unsigned>(number.exponent - pair.low);
      }
      return scaled;
    };
    const NarrowVector start = point(0);
    const NarrowVector a = point(2);
    direction_ = has_end_ ? difference(point(1), start) : point(1);
    to_b_ = difference(point(3), a);
    to_c_ = difference(point(4), a);
    from_a_ = difference(start, a);
    normal_ = cross(to_b_, to_c_);
    det_ = -dot(direction_, normal_);
    height_ = dot(from_a_, normal_);
  }

  /// Or the triangle is degenerate.
  [[nodiscard]] bool is_in_plane() const { return det_ == 0 && height_ == 0; }

  [[nodiscard]] std::optional<IntegerContact<Wide>> contact() {
    if (det_ != 0) return contact_across();
    if (height_ != 0) return std::nullopt;
    return normal_ == WideVector{0, 0, 0} ? contact_of_degenerate() : contact_in_plane();
  }

 private:
  using NarrowVector = std::array<Narrow, 3>;
  using WideVector = std::array<Wide, 3>;

  /// constant + rate t
  struct Linear {
    Wide constant;
    Wide rate;
  };

  static NarrowVector difference(const NarrowVector& x, const NarrowVector& y) {
    return {Narrow(x[0] - y[0]), Narrow(x[1] - y[1]), Narrow(x[2] - y[2])};
  }
  static Wide minor(const NarrowVector& x, const NarrowVector& y, std::size_t i, std::size_t j) {
    return Wide(x[i]) * y[j] - Wide(x[j]) * y[i];
  }
  static WideVector cross(const NarrowVector& x, const NarrowVector& y) {
    return {minor(x, y, 1, 2), minor(x, y, 2, 0), minor(x, y, 0, 1)};
  }
  static Wide dot(const NarrowVector& x, const WideVector& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }

  /// Cramer's rule for start - a = u (b - a) + v (c - a) - t direction.
  std::optional<IntegerContact<Wide>> contact_across() {
    Wide u = dot(from_a_, cross(direction_, to_c_));
    Wide v = dot(direction_, cross(from_a_, to_b_));
    const Side side = det_ > 0 ? Side::front : Side::back;
    if (det_ < 0) {
      for (Wide* each : {&height_, &u, &v, &det_}) *each = -*each;
    }
    if (u < 0 || v < 0 || u + v > det_ || (has_start_ && height_ < 0) || (has_end_ && height_ > det_)) return {};
    return IntegerContact<Wide>{{height_, det_}, {u, det_}, {v, det_}, side};
  }

  /// Along the path the weights are linear in t; each of them, where it is not negative, bounds t on one side. Two axes
  /// on which the triangle does not vanish tell them.
  std::optional<IntegerContact<Wide>> contact_in_plane() {
    const std::size_t i = normal_[2] != 0 || normal_[1] != 0 ? 0 : 1;
    const std::size_t j = normal_[2] != 0 ? 1 : 2;
    Wide whole = minor(to_b_, to_c_, i, j);
    Linear u = {minor(from_a_, to_c_, i, j), minor(direction_, to_c_, i, j)};
    Linear v = {minor(to_b_, from_a_, i, j), minor(to_b_, direction_, i, j)};
    if (whole < 0) {
      for (Wide* each : {&whole, &u.constant, &u.rate, &v.constant, &v.rate}) *each = -*each;
    }
    begin_interval();
    keep_nonnegative(u);
    keep_nonnegative(v);
    keep_nonnegative({whole - u.constant - v.constant, -u.rate - v.rate});
    if (is_interval_empty()) return {};
    return IntegerContact<Wide>{*low_, at_first(u, whole), at_first(v, whole)};
  }

  /// The hull of corners on a line is that of the least and the greatest of them, and of equal ones the first counts.
  /// An axis on which these differ, if any, tells the weight of the greatest; the others, where path and hull meet.
  std::optional<IntegerContact<Wide>> contact_of_degenerate() {
    const std::array<NarrowVector, 3> corners = {NarrowVector{0, 0, 0}, to_b_, to_c_};
    const auto least = static_cast<std::size_t>(std::min_element(corners.begin(), corners.end()) - corners.begin());
    const auto greatest = static_cast<std::size_t>(std::max_element(corners.begin(), corners.end()) - corners.begin());
    const NarrowVector span = difference(corners[greatest], corners[least]);
    const NarrowVector from = difference(from_a_, corners[least]);
    const auto told = static_cast<std::size_t>(
        std::find_if(span.begin(), span.end(), [](const Narrow& x) { return x != 0; }) - span.begin());
    begin_interval();
    if (told == span.size()) {
      for (std::size_t axis = 0; axis < 3; ++axis) keep_zero({from[axis], direction_[axis]});
      if (is_interval_empty()) return {};
      return IntegerContact<Wide>{*low_};
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (axis != told) keep_zero({minor(from, span, axis, told), minor(direction_, span, axis, told)});
    }
    Wide whole = span[told];
    Linear weight = {from[told], direction_[told]};
    if (whole < 0) {
      for (Wide* each : {&whole, &weight.constant, &weight.rate}) *each = -*each;
    }
    const Linear rest = {whole - weight.constant, -weight.rate};
    keep_nonnegative(weight);
    keep_nonnegative(rest);
    if (is_interval_empty()) return {};
    IntegerContact<Wide> contact{*low_};
    const auto give = [&](std::size_t corner, const Linear& share) {
      if (corner == 1) contact.u = at_first(share, whole);
      if (corner == 2) contact.v = at_first(share, whole);
    };
    give(greatest, weight);
    give(least, rest);
    return contact;
  }

  void begin_interval() {
    const bool is_point = direction_ == NarrowVector{0, 0, 0};
    if (has_start_ || is_point) low_ = Quotient<Wide>{0, 1};
    if (has_end_) high_ = Quotient<Wide>{1, 1};
    if (is_point) high_ = Quotient<Wide>{0, 1};
  }

  void keep_zero(const Linear& linear) {
    keep_nonnegative(linear);
    keep_nonnegative({-linear.constant, -linear.rate});
  }

  /// Keeps the t at which it is not negative.
  void keep_nonnegative(const Linear& linear) {
    if (linear.rate == 0) {
      is_empty_ = is_empty_ || linear.constant < 0;
    } else if (linear.rate > 0) {
      const Quotient<Wide> bound{-linear.constant, linear.rate};
      if (!low_ || *low_ < bound) low_ = bound;
    } else {
      const Quotient<Wide> bound{linear.constant, -linear.rate};
      if (!high_ || bound < *high_) high_ = bound;
    }
  }

  /// Where it is not empty it has a lower end: a path that is no point cannot stay in what is bounded.
  [[nodiscard]] bool is_interval_empty() const { return is_empty_ || (low_ && high_ && *high_ < *low_); }

  [[nodiscard]] Quotient<Wide> at_first(const Linear& linear, const Wide& whole) const {
    return {linear.constant * low_->denominator + linear.rate * low_->numerator, whole * low_->denominator};
  }

  bool has_start_;
  bool has_end_;
  NarrowVector direction_;
  NarrowVector to_b_;
  NarrowVector to_c_;
  NarrowVector from_a_;
  WideVector normal_;
  Wide det_;
  Wide height_;
  bool is_empty_ = false;
  std::optional<Quotient<Wide>> low_;
  std::optional<Quotient<Wide>> high_;
};

/// Nothing where the quotient is too near the middle of two floats for a double to tell. Two conversions and a division
/// err by half an ulp each, together by less than 2^-51 of the quotient, which is no less than 2^-127.
std::optional<bool> rounds_to(const Quotient<Int128>& exact, float answer) {
  const double quotient = static_cast<double>(exact.numerator) / static_cast<double>(exact.denominator);
  const double slack = std::abs(quotient) * 0x1p-50;
  const auto low = static_cast<float>(quotient - slack);
  if (low != static_cast<float>(quotient + slack)) return std::nullopt;
  return same_bits(low, answer);
}

template <typename Scalar>
std::optional<bool> rounds_to(const Quotient<mpz_class>& exact, Scalar answer) {
  return same_bits(nearest<Scalar>(mpq_class(exact.numerator, exact.denominator)), answer);
}

template <typename Integer, typename Scalar>
std::optional<bool> agree(const std::optional<IntegerContact<Integer>>& contact,
                          const std::optional<Hit<Scalar>>& answer) {
  if (!contact || !answer) return contact.has_value() == answer.has_value();
  if (answer->side != contact->side || answer->triangle != 0) return false;
  const auto t = rounds_to(contact->t, answer->t);
  const auto u = rounds_to(contact->u, answer->u);
  const auto v = rounds_to(contact->v, answer->v);
  if (!t || !u || !v) return std::nullopt;
  return *t && *u && *v;
}

}  // namespace

template <typename Scalar>
bool is_right(const Path<Scalar>& path, const Triangle<Scalar>& triangle, const std::optional<Hit<Scalar>>& answer) {
  const DyadicPair dyadic(path, triangle);
  if constexpr (sizeof(Scalar) == sizeof(float)) {
    if (dyadic.bits() <= max_bits_across) {
      NarrowPair<std::int64_t, Int128> pair(dyadic, path.kind);
      if (!pair.is_in_plane() || dyadic.bits() <= max_bits_in_plane) {
        if (const auto agreement = agree(pair.contact(), answer)) return *agreement;
      }
    }
  }
  return *agree(NarrowPair<mpz_class, mpz_class>(dyadic, path.kind).contact(), answer);
}

template bool is_right(const Path<float>&, const Triangle<float>&, const std::optional<Hit<float>>&);
template bool is_right(const Path<double>&, const Triangle<double>&, const std::optional<Hit<double>>&);

}  // namespace surehit::test
