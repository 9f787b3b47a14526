#include "bounded_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel_bound.hpp"

namespace surehit::detail {
namespace {

using BoundedVector = std::array<Bounded, 3>;

template <typename Scalar>
BoundedVector difference(const Vector3<Scalar>& x, const Vector3<Scalar>& y) {
  return {exact(x[0]) - exact(y[0]), exact(x[1]) - exact(y[1]), exact(x[2]) - exact(y[2])};
}

BoundedVector cross(const BoundedVector& x, const BoundedVector& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}

Bounded dot(const BoundedVector& x, const BoundedVector& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }

/// The five numbers whose signs decide, and det.
struct Determinants {
  Bounded det;
  Bounded height;
  Bounded u;
  Bounded v;
  Bounded w;
  Bounded above_first;  ///< T - first det
  Bounded below_last;   ///< last det - T
};

// With det's sign taken out, each of these must be at least zero for a hit. So two of certain and opposite signs are a
// miss, whatever det is: were it zero, a path that meets the triangle would lie in its plane and all of them would
// vanish.
template <typename Scalar>
BoundedContact decide(const Determinants& of, const Path<Scalar>& path, const PathRange<Scalar>& range) {
  BoundedContact result;
  result.u_scaled = of.u;
  result.v_scaled = of.v;
  bool any_positive = false;
  bool any_negative = false;
  bool all_certain = true;
  const auto weigh = [&](const Bounded& x) {
    any_positive |= x.value > x.radius;
    any_negative |= x.value < -x.radius;
    all_certain &= x.value > x.radius || x.value < -x.radius || (x.value == 0 && x.radius == 0);
  };
  weigh(of.u);
  weigh(of.v);
  weigh(of.w);
  const bool has_first = range.first > -PathRange<Scalar>::infinity;
  const bool has_last = range.last < PathRange<Scalar>::infinity;
  if (has_first) weigh(of.above_first);
  if (has_last) weigh(of.below_last);
  if (any_positive && any_negative) {
    result.verdict = Verdict::miss;
    return result;
  }
  const bool front = of.det.value > of.det.radius;
  const bool back = of.det.value < -of.det.radius;
  if (!all_certain || !(front || back)) return result;
  result.by_det = BoundedQuotients(of.det);
  const auto [lower, upper] = result.by_det.of(of.height);
  if (!std::isfinite(lower) || !std::isfinite(upper)) return result;
  const auto vanishes = [](const Bounded& x) { return x.value == 0; };
  result.verdict = Verdict::hit;
  result.contact.t_lower = lower;
  result.contact.t_upper = upper;
  result.contact.side = front ? Side::front : Side::back;
  result.contact.at_start = path.has_start() && range.first == 0 && vanishes(of.above_first);
  result.contact.at_end = path.has_end() && range.last == 1 && vanishes(of.below_last);
  return result;
}

using DoubleVector = std::array<double, 3>;

template <typename Scalar>
DoubleVector double_difference(const Vector3<Scalar>& x, const Vector3<Scalar>& y) {
  return {double{x[0]} - double{y[0]}, double{x[1]} - double{y[1]}, double{x[2]} - double{y[2]}};
}

DoubleVector cross(const DoubleVector& x, const DoubleVector& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}

double dot(const DoubleVector& x, const DoubleVector& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }

double size(const DoubleVector& x) { return std::max({std::fabs(x[0]), std::fabs(x[1]), std::fabs(x[2])}); }

}  // namespace

template <typename Scalar>
BoundedContact double_contact(const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                              const PathRange<Scalar>& range) {
  using Bound = KernelBound<double>;
  const DoubleVector d = path.has_end()
                             ? double_difference<Scalar>(path.toward, path.start)
                             : DoubleVector{double{path.toward[0]}, double{path.toward[1]}, double{path.toward[2]}};
  const DoubleVector e1 = double_difference<Scalar>(triangle.b, triangle.a);
  const DoubleVector e2 = double_difference<Scalar>(triangle.c, triangle.a);
  const DoubleVector s = double_difference<Scalar>(path.start, triangle.a);
  const double d_size = size(d);
  const double e1_size = size(e1);
  const double e2_size = size(e2);
  const double s_size = size(s);
  const double largest = std::max({d_size, e1_size, e2_size, s_size});
  const double first = range.first > -PathRange<Scalar>::infinity ? double{range.first} : 0;
  const double last = range.last < PathRange<Scalar>::infinity ? double{range.last} : 0;
  const double largest_limit = std::max(std::fabs(first), std::fabs(last));
  if (!(largest <= Bound::largest_size && largest_limit <= Bound::largest_limit)) return {};

  const DoubleVector p = cross(d, e2);
  const DoubleVector q = cross(s, e1);
  const double det = dot(e1, p);
  const double height = dot(e2, q);
  const double u = dot(s, p);
  const double v = dot(d, q);
  const double underflow = (1 + largest) * Bound::underflow;
  const double det_size = d_size * e1_size * e2_size;
  const double height_size = s_size * e1_size * e2_size;
  const double u_size = s_size * d_size * e2_size;
  const double v_size = s_size * d_size * e1_size;
  const auto bounded = [&](double value, double sizes) { return Bounded{value, Bound::relative * sizes + underflow}; };
  return decide({bounded(det, det_size), bounded(height, height_size), bounded(u, u_size), bounded(v, v_size),
                 bounded(det - u - v, det_size + u_size + v_size),
                 bounded(height - first * det, height_size + std::fabs(first) * det_size),
                 bounded(last * det - height, height_size + std::fabs(last) * det_size)},
                path, range);
}

template <typename Scalar>
BoundedContact bounded_contact(const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                               const PathRange<Scalar>& range) {
  const BoundedVector d = path.kind == PathKind::segment
                              ? difference<Scalar>(path.toward, path.start)
                              : BoundedVector{exact(path.toward[0]), exact(path.toward[1]), exact(path.toward[2])};
  const BoundedVector e1 = difference<Scalar>(triangle.b, triangle.a);
  const BoundedVector e2 = difference<Scalar>(triangle.c, triangle.a);
  const BoundedVector s = difference<Scalar>(path.start, triangle.a);
  const BoundedVector p = cross(d, e2);
  const BoundedVector q = cross(s, e1);

  Determinants of;
  of.det = dot(e1, p);
  of.height = dot(e2, q);
  of.u = dot(s, p);
  of.v = dot(d, q);
  of.w = of.det - of.u - of.v;
  if (range.first > -PathRange<Scalar>::infinity) of.above_first = of.height - exact(range.first) * of.det;
  if (range.last < PathRange<Scalar>::infinity) of.below_last = exact(range.last) * of.det - of.height;
  return decide(of, path, range);
}

// With n, r_n and d, r_d the values and radii: |N/D - n/d| <= (r_n + |n/d| r_d) / (|d| - r_d). The inverse of d is off
// by u of itself, q = n (1/d) by 2 u |q|, the sums and the other inverse by a few u of themselves, and q - e and q + e
// by u
// (|q| + e), all of which the factor and the term 2^-51 |q| cover. A q that underflows is off by 2^-1075 besides, which
// r_d / (|d| - r_d) may enlarge, so it counts with |q|; 2^-1070 is for what underflows after it. The inverse itself
// must not: beyond `largest_denominator` nothing is told.
constexpr double largest_denominator = 0x1p1000;

BoundedQuotients::BoundedQuotients(const Bounded& denominator)
    : inverse_(1 / denominator.value),
      radius_(denominator.radius),
      greatest_inverse_(std::fabs(denominator.value) <= largest_denominator
                            ? 1 / (std::fabs(denominator.value) - denominator.radius)
                            : std::numeric_limits<double>::infinity()) {}

std::array<double, 2> BoundedQuotients::of(const Bounded& numerator) const {
  if (numerator.value == 0 && numerator.radius == 0) return {0, 0};
  const double quotient = numerator.value * inverse_;
  const double size = std::fabs(quotient);
  const double error = (numerator.radius + (size + 0x1p-1074) * radius_) * greatest_inverse_;
  const double bound = error * radius_growth + size * 0x1p-51 + radius_underflow;
  return {quotient - bound, quotient + bound};
}

template BoundedContact double_contact(const Path<float>&, const Triangle<float>&, const PathRange<float>&);
template BoundedContact double_contact(const Path<double>&, const Triangle<double>&, const PathRange<double>&);
template BoundedContact bounded_contact(const Path<float>&, const Triangle<float>&, const PathRange<float>&);
template BoundedContact bounded_contact(const Path<double>&, const Triangle<double>&, const PathRange<double>&);

}  // namespace surehit::detail
