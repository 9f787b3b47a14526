#include "shape/bounded_sphere.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "exact/scaled_double.hpp"
#include "filter/bounded.hpp"
#include "shape/sphere_touch.hpp"
#include "support/rounding_flags.hpp"

namespace surehit::detail {
namespace {

using BoundedTerms = SphereTerms<Bounded, Bounded>;
using BoundedVector = Vector<Bounded>;

template <typename Scalar>
BoundedVector difference(const Vector3<Scalar>& x, const Vector3<Scalar>& y) {
  const auto axis = [&](Eigen::Index i) { return exact(double{x[i]}) - exact(double{y[i]}); };
  return {axis(0), axis(1), axis(2)};
}

template <typename Scalar>
BoundedTerms terms_of(const SweptSphere<Scalar>& sphere, const Triangle<Scalar>& triangle) {
  const auto& [a, b, c] = triangle;
  return {{difference(sphere.start, a), difference(sphere.start, b), difference(sphere.start, c)},
          {difference(sphere.end, a), difference(sphere.end, b), difference(sphere.end, c)},
          {difference(b, a), difference(c, b), difference(a, c)},
          difference(sphere.end, sphere.start),
          exact(double{sphere.radius})};
}

/// Returns bounds of a sum, a product or a quotient that is known to be at least 0. Each of its numbers has an error of
/// at most its radius, and 2^-48 covers the few roundings of the bounds themselves.
constexpr double down = 1 - 0x1p-48;
constexpr double up = 1 + 0x1p-48;

double lower(const Bounded& x) { return std::max(0.0, x.value - x.radius) * down; }
double upper(const Bounded& x) { return (x.value + x.radius) * up; }

/// Returns bounds of c / (√d - b), where c > 0 > b and d ≥ 0.
DoubleRange root(const Bounded& minus_b, const Bounded& c, const Bounded& d) {
  return {lower(c) / (upper(minus_b) + std::sqrt(upper(d))) * down, upper(c) / (lower(minus_b) + std::sqrt(lower(d))) * up};
}

/// Returns bounds of the t at which the ball comes to a part (S3).
DoubleRange time_of(const BoundedTerms& terms, Feature part) {
  const Bounded rr = terms.radius * terms.radius;
  const BoundedVector& d = terms.step;
  if (is_corner(part)) {
    const BoundedVector& w = terms.from_corner[index_of(part)];
    const Bounded b = dot(d, w);
    const Bounded c = dot(w, w) - rr;
    return root(-b, c, b * b - dot(d, d) * c);
  }
  if (is_edge(part)) {
    const BoundedVector& e = terms.edge[index_of(part)];
    const BoundedVector& w = terms.from_corner[index_of(part)];
    const BoundedVector f = cross(d, e);
    const BoundedVector moment = cross(w, e);
    const Bounded ee = dot(e, e);
    const Bounded wf = dot(w, f);
    return root(-dot(f, moment), dot(moment, moment) - rr * ee, ee * (rr * dot(f, f) - wf * wf));
  }
  // t = (|h| - r √nn) / |n d| = (h² - r² nn) / (|n d| (|h| + r √nn))
  const BoundedVector n = normal_of(terms);
  Bounded height = dot(n, terms.from_corner[0]);
  Bounded rate = dot(n, d);
  (height.value < 0 ? height : rate) = -(height.value < 0 ? height : rate);
  const Bounded nn = dot(n, n);
  const Bounded c = height * height - rr * nn;
  const double radius = terms.radius.value;
  return {lower(c) / ((upper(height) + radius * std::sqrt(upper(nn)) * up) * up * upper(rate)) * down,
          upper(c) / ((lower(height) + radius * std::sqrt(lower(nn)) * down) * down * lower(rate)) * up};
}

/// Returns bounds that hold in spite of underflow, or no bounds if they are not numbers.
DoubleRange settled(const DoubleRange& range) {
  if (!(range.lower >= 0x1p-900 && range.upper <= 0x1p900)) return {0, std::numeric_limits<double>::infinity()};
  return range;
}

/// Rounds (x + t y) / z, which is in [0, 1]. Returns false if its bounds do not decide it.
template <typename Scalar>
bool try_round_weight(const Bounded& x, const Bounded& y, const DoubleRange& t, const Bounded& z, Scalar& weight) {
  const Bounded time = {(t.lower + t.upper) / 2, (t.upper - t.lower) * up};
  const Bounded sum = x + time * y;
  const double low = lower(sum) / upper(z) * down;
  const double high = upper(sum) / lower(z) * up;
  if (!(low >= 0x1p-900 && high <= 0x1p900)) return false;
  weight = static_cast<Scalar>(low);
  return weight == static_cast<Scalar>(high);
}

}  // namespace

template <typename Scalar>
Verdict bounded_sphere_contact(const SweptSphere<Scalar>& sphere, const Triangle<Scalar>& triangle,
                               SphereContact& found) {
  const BoundedTerms terms = terms_of(sphere, triangle);
  Signs signs;
  bool has_face = false;
  for (const Bounded& x : normal_of(terms)) has_face |= x.sign().value_or(0) != 0;
  if (!has_face) return Verdict::undecided;
  constexpr Outline outline;
  bool is_alone = true;
  const auto comes_before = [&](Feature, Feature) { return is_alone = false; };
  const std::optional<SphereContact> contact = SphereTouch(terms, outline, signs).find(comes_before);
  if (!signs.is_certain() || !is_alone) return Verdict::undecided;
  if (!contact) return Verdict::miss;
  found = *contact;
  if (!found.at_start) {
    const DoubleRange t = settled(time_of(terms, found.timed_by));
    found.t_lower = t.lower;
    found.t_upper = std::min(t.upper, 1.0);
  }
  return Verdict::hit;
}

template <typename Scalar>
bool try_round(const SweptSphere<Scalar>& sphere, const Triangle<Scalar>& triangle, const SphereContact& contact,
               ShapeHit<Scalar>& hit) {
  hit.t = static_cast<Scalar>(contact.t_lower);
  if (hit.t != static_cast<Scalar>(contact.t_upper)) return false;
  hit.u = contact.feature == Feature::corner_b ? Scalar{1} : Scalar{0};
  hit.v = contact.feature == Feature::corner_c ? Scalar{1} : Scalar{0};
  if (is_corner(contact.feature)) return true;
  const BoundedTerms terms = terms_of(sphere, triangle);
  const DoubleRange t = {contact.t_lower, contact.t_upper};
  if (contact.feature == Feature::face) {
    const BoundedVector n = normal_of(terms);
    const Bounded nn = dot(n, n);
    const auto try_weight = [&](const BoundedVector& edge, Scalar& weight) {
      return try_round_weight(dot(n, cross(edge, terms.from_corner[0])), dot(n, cross(edge, terms.step)), t, nn, weight);
    };
    return try_weight(terms.edge[2], hit.u) && try_weight(terms.edge[0], hit.v);
  }
  const std::size_t edge = index_of(contact.feature);
  const BoundedVector& e = terms.edge[edge];
  const Bounded ee = dot(e, e);
  const Bounded at_start = dot(terms.from_corner[edge], e);
  const Bounded rate = dot(terms.step, e);
  const auto try_toward_end = [&](Scalar& weight) { return try_round_weight(at_start, rate, t, ee, weight); };
  const auto try_toward_start = [&](Scalar& weight) { return try_round_weight(ee - at_start, -rate, t, ee, weight); };
  if (edge == 0) return try_toward_end(hit.u);
  if (edge == 1) return try_toward_start(hit.u) && try_toward_end(hit.v);
  return try_toward_start(hit.v);
}

template Verdict bounded_sphere_contact(const SweptSphere<float>&, const Triangle<float>&, SphereContact&);
template Verdict bounded_sphere_contact(const SweptSphere<double>&, const Triangle<double>&, SphereContact&);
template bool try_round(const SweptSphere<float>&, const Triangle<float>&, const SphereContact&, ShapeHit<float>&);
template bool try_round(const SweptSphere<double>&, const Triangle<double>&, const SphereContact&, ShapeHit<double>&);

}  // namespace surehit::detail
