#include "bounded_contact.hpp"

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

}  // namespace

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

  BoundedContact result;
  result.det = dot(e1, p);
  result.height = dot(e2, q);
  result.u_scaled = dot(s, p);
  result.v_scaled = dot(d, q);

  // With det's sign taken out, each of these must be at least zero for a hit. So two of certain and opposite signs are
  // a miss, whatever det is: were it zero, a path that meets the triangle would lie in its plane and all of them would
  // vanish.
  std::array<std::optional<int>, 5> signs = {
      result.u_scaled.sign(), result.v_scaled.sign(), (result.det - result.u_scaled - result.v_scaled).sign(), {}, {}};
  std::size_t count = 3;
  const bool has_first = range.first > -PathRange<Scalar>::infinity;
  const bool has_last = range.last < PathRange<Scalar>::infinity;
  std::optional<int> above_first;
  std::optional<int> below_last;
  if (has_first) signs[count++] = above_first = (result.height - exact(range.first) * result.det).sign();
  if (has_last) signs[count++] = below_last = (exact(range.last) * result.det - result.height).sign();

  bool any_positive = false;
  bool any_negative = false;
  bool all_certain = true;
  for (std::size_t i = 0; i < count; ++i) {
    any_positive |= signs[i] == 1;
    any_negative |= signs[i] == -1;
    all_certain &= signs[i].has_value();
  }
  const std::optional<int> side = result.det.sign();
  if (any_positive && any_negative) {
    result.verdict = Verdict::miss;
  } else if (all_certain && side && *side != 0) {
    const auto [lower, upper] = bounded_quotient(result.height, result.det);
    if (!std::isfinite(lower) || !std::isfinite(upper)) return result;
    result.verdict = Verdict::hit;
    result.contact.t_lower = lower;
    result.contact.t_upper = upper;
    result.contact.side = *side > 0 ? Side::front : Side::back;
    result.contact.at_start = path.has_start() && range.first == 0 && above_first == 0;
    result.contact.at_end = path.has_end() && range.last == 1 && below_last == 0;
  }
  return result;
}

// With n, r_n and d, r_d the values and radii: |N/D - n/d| <= (r_n + |n/d| r_d) / (|d| - r_d). The computed q = n/d is
// off by u |q| more, the sums and the quotient by a few u of themselves, and q - e and q + e by u (|q| + e), all of
// which the factor and the term 2^-51 |q| cover. A q that underflows is off by 2^-1075 besides, which r_d / (|d| - r_d)
// may enlarge, so it counts with |q|; 2^-1070 is for what underflows after it.
std::array<double, 2> bounded_quotient(const Bounded& numerator, const Bounded& denominator) {
  const double quotient = numerator.value / denominator.value;
  if (numerator.value == 0 && numerator.radius == 0) return {0, 0};
  const double size = std::fabs(quotient);
  const double error = (numerator.radius + (size + 0x1p-1074) * denominator.radius) /
                       (std::fabs(denominator.value) - denominator.radius);
  const double bound = error * radius_growth + size * 0x1p-51 + radius_underflow;
  return {quotient - bound, quotient + bound};
}

template BoundedContact bounded_contact(const Path<float>&, const Triangle<float>&, const PathRange<float>&);
template BoundedContact bounded_contact(const Path<double>&, const Triangle<double>&, const PathRange<double>&);

}  // namespace surehit::detail
