#include "shape/bounded_sphere.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "exact/scaled_double.hpp"
#include "filter/bounded.hpp"
#include "shape/sphere_touch.hpp"
#include "support/inlining.hpp"
#include "support/rounding_flags.hpp"

namespace surehit::detail {
namespace {

template <typename Number>
using TermsOf = SphereTerms<Number, Number>;

/// Returns x - y, which is rounded in `Sized` and exact in `Bounded`.
inline void set_difference(Bounded& out, double x, double y) { out = exact(x) - exact(y); }
inline void set_difference(Sized& out, double x, double y) { out = {x - y, std::fabs(x - y)}; }
inline void set_exact(Bounded& out, double x) { out = exact(x); }
inline void set_exact(Sized& out, double x) { out = {x, std::fabs(x)}; }

template <typename Number, typename Scalar>
Vector<Number> difference(const Vector3<Scalar>& x, const Vector3<Scalar>& y) {
  Vector<Number> out;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    set_difference(out[i], double{x[axis]}, double{y[axis]});
  }
  return out;
}

template <typename Number, typename Scalar>
TermsOf<Number> terms_of(const SweptSphere<Scalar>& sphere, const Triangle<Scalar>& triangle) {
  const auto& [a, b, c] = triangle;
  const auto of = [](const auto& x, const auto& y) { return difference<Number>(x, y); };
  Number radius;
  set_exact(radius, double{sphere.radius});
  return {{of(sphere.start, a), of(sphere.start, b), of(sphere.start, c)},
          {of(sphere.end, a), of(sphere.end, b), of(sphere.end, c)},
          {of(b, a), of(c, b), of(a, c)},
          of(sphere.end, sphere.start),
          radius};
}

/// Returns whether the premise of Z2 holds.
bool has_usual_sizes(const TermsOf<Sized>& terms) {
  double low = max_sized;
  double high = 0;
  const auto include = [&](const Sized& x) {
    low = std::min(low, x.size == 0 ? max_sized : x.size);
    high = std::max(high, x.size);
  };
  const auto include_all = [&](const Vector<Sized>& x) { std::for_each(x.begin(), x.end(), include); };
  std::for_each(terms.from_corner.begin(), terms.from_corner.end(), include_all);
  std::for_each(terms.to_end.begin(), terms.to_end.end(), include_all);
  std::for_each(terms.edge.begin(), terms.edge.end(), include_all);
  include_all(terms.step);
  include(terms.radius);
  return low >= min_sized && high <= max_sized;
}
bool has_usual_sizes(const TermsOf<Bounded>&) { return true; }

double error_of(const Bounded& x) { return x.radius; }
double error_of(const Sized& x) { return x.error(); }

/// Returns bounds of a sum, a product or a quotient that is known to be at least 0. Each of its numbers has an error of
/// at most its radius, and 2^-48 covers the few roundings of the bounds themselves.
constexpr double down = 1 - 0x1p-48;
constexpr double up = 1 + 0x1p-48;

template <typename Number>
double lower(const Number& x) {
  return std::max(0.0, x.value - error_of(x)) * down;
}
template <typename Number>
double upper(const Number& x) {
  return (x.value + error_of(x)) * up;
}

/// Returns bounds of c / (√d - b), where c > 0 > b and d ≥ 0.
template <typename Number>
DoubleRange root(const Number& minus_b, const Number& c, const Number& d) {
  return {lower(c) / (upper(minus_b) + std::sqrt(upper(d))) * down,
          upper(c) / (lower(minus_b) + std::sqrt(lower(d))) * up};
}

/// Returns bounds of the t at which the ball comes to a part (S3).
template <typename Number>
DoubleRange time_of(const TermsOf<Number>& terms, Feature part) {
  const Number rr = terms.radius * terms.radius;
  const Vector<Number>& d = terms.step;
  if (is_corner(part)) {
    const Vector<Number>& w = terms.from_corner[index_of(part)];
    const Number b = dot(d, w);
    const Number c = dot(w, w) - rr;
    return root(-b, c, b * b - dot(d, d) * c);
  }
  if (is_edge(part)) {
    const Vector<Number>& e = terms.edge[index_of(part)];
    const Vector<Number>& w = terms.from_corner[index_of(part)];
    const Vector<Number> f = cross(d, e);
    const Vector<Number> moment = cross(w, e);
    const Number ee = dot(e, e);
    const Number wf = dot(w, f);
    return root(-dot(f, moment), dot(moment, moment) - rr * ee, ee * (rr * dot(f, f) - wf * wf));
  }
  // t = (|h| - r √nn) / |n d| = (h² - r² nn) / (|n d| (|h| + r √nn))
  const Vector<Number> n = normal_of(terms);
  Number height = dot(n, terms.from_corner[0]);
  Number rate = dot(n, d);
  (height.value < 0 ? height : rate) = -(height.value < 0 ? height : rate);
  const Number nn = dot(n, n);
  const Number c = height * height - rr * nn;
  const double radius = terms.radius.value;
  return {lower(c) / ((upper(height) + radius * std::sqrt(upper(nn)) * up) * up * upper(rate)) * down,
          upper(c) / ((lower(height) + radius * std::sqrt(lower(nn)) * down) * down * lower(rate)) * up};
}

/// Returns bounds that hold in spite of underflow, or no bounds if they are not numbers.
DoubleRange settled(const DoubleRange& range) {
  if (!(range.lower >= 0x1p-900 && range.upper <= 0x1p900)) return {0, std::numeric_limits<double>::infinity()};
  return range;
}

/// Returns (x + t y) / z, where the result is at least 0 and z is positive.
template <typename Number>
DoubleRange weight_of(const Number& x, const Number& y, const DoubleRange& t, const Number& z) {
  // Each product with an end of t is off by what y is off, and the roundings here.
  const double products[2] = {t.lower * y.value, t.upper * y.value};
  const double error =
      error_of(x) + t.upper * error_of(y) + (std::fabs(x.value) + t.upper * std::fabs(y.value)) * 0x1p-50;
  const double low = std::max(0.0, x.value + std::min(products[0], products[1]) - error * up);
  const double high = x.value + std::max(products[0], products[1]) + error * up;
  return {low * down / upper(z) * down, high * up / lower(z) * up};
}

/// Rounds a number. Returns false if its bounds do not decide it.
template <typename Scalar>
bool try_round(const DoubleRange& range, Scalar& rounded) {
  if (!(range.lower >= 0x1p-900 && range.upper <= 0x1p900)) return false;
  rounded = static_cast<Scalar>(range.lower);
  return rounded == static_cast<Scalar>(range.upper);
}

/// Rounds the weights of a contact that is not at a corner.
template <typename Number, typename Scalar>
SUREHIT_NOINLINE bool try_round_weights(const SweptSphere<Scalar>& sphere, const Triangle<Scalar>& triangle,
                                        const SphereContact& contact, ShapeHit<Scalar>& hit) {
  const TermsOf<Number> terms = terms_of<Number>(sphere, triangle);
  if (!has_usual_sizes(terms)) return false;
  const DoubleRange t = {contact.t_lower, contact.t_upper};
  if (contact.feature == Feature::face) {
    const Vector<Number> n = normal_of(terms);
    const Number nn = dot(n, n);
    const auto try_weight = [&](const Vector<Number>& edge, Scalar& weight) {
      const Number at_start = dot(n, cross(edge, terms.from_corner[0]));
      return try_round(weight_of(at_start, dot(n, cross(edge, terms.step)), t, nn), weight);
    };
    return try_weight(terms.edge[2], hit.u) && try_weight(terms.edge[0], hit.v);
  }
  const std::size_t edge = index_of(contact.feature);
  const Vector<Number>& e = terms.edge[edge];
  const Number ee = dot(e, e);
  const Number at_start = dot(terms.from_corner[edge], e);
  const Number rate = dot(terms.step, e);
  const auto try_toward_end = [&](Scalar& weight) { return try_round(weight_of(at_start, rate, t, ee), weight); };
  const auto try_toward_start = [&](Scalar& weight) {
    return try_round(weight_of(ee - at_start, -rate, t, ee), weight);
  };
  if (edge == 0) return try_toward_end(hit.u);
  if (edge == 1) return try_toward_start(hit.u) && try_toward_end(hit.v);
  return try_toward_start(hit.v);
}

template <typename Number, typename Scalar>
SUREHIT_NOINLINE Verdict find_contact(const SweptSphere<Scalar>& sphere, const Triangle<Scalar>& triangle,
                                      SphereContact& found) {
  const TermsOf<Number> terms = terms_of<Number>(sphere, triangle);
  if (!has_usual_sizes(terms)) return Verdict::undecided;
  Signs signs;
  bool has_face = false;
  for (const Number& x : normal_of(terms)) has_face |= x.sign().value_or(0) != 0;
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

}  // namespace

template <typename Scalar>
Verdict bounded_contact(const SweptSphere<Scalar>& sphere, const Triangle<Scalar>& triangle, SphereContact& found) {
  const Verdict verdict = find_contact<Sized>(sphere, triangle, found);
  return verdict != Verdict::undecided ? verdict : find_contact<Bounded>(sphere, triangle, found);
}

template <typename Scalar>
bool try_round(const SweptSphere<Scalar>& sphere, const Triangle<Scalar>& triangle, const SphereContact& contact,
               ShapeHit<Scalar>& hit) {
  hit.t = static_cast<Scalar>(contact.t_lower);
  if (hit.t != static_cast<Scalar>(contact.t_upper)) return false;
  hit.u = contact.feature == Feature::corner_b ? Scalar{1} : Scalar{0};
  hit.v = contact.feature == Feature::corner_c ? Scalar{1} : Scalar{0};
  if (is_corner(contact.feature)) return true;
  return try_round_weights<Sized>(sphere, triangle, contact, hit) ||
         try_round_weights<Bounded>(sphere, triangle, contact, hit);
}

template Verdict bounded_contact(const SweptSphere<float>&, const Triangle<float>&, SphereContact&);
template Verdict bounded_contact(const SweptSphere<double>&, const Triangle<double>&, SphereContact&);
template bool try_round(const SweptSphere<float>&, const Triangle<float>&, const SphereContact&, ShapeHit<float>&);
template bool try_round(const SweptSphere<double>&, const Triangle<double>&, const SphereContact&, ShapeHit<double>&);

}  // namespace surehit::detail
