#include "shape/bounded_sphere.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <type_traits>

#include "shape/bounded_approach.hpp"
#include "shape/edge_contact.hpp"
#include "shape/face_contact.hpp"
#include "shape/sphere_touch.hpp"
#include "support/inlining.hpp"
#include "support/rounding_flags.hpp"

namespace surehit::detail {
namespace {

template <typename Number>
using SphereTermsOf = SphereTerms<Number, Number>;

template <typename Number, typename Scalar, typename AnyTriangle>
SphereTermsOf<Number> terms_of(const SweptSphere<Scalar>& sphere, const AnyTriangle& triangle) {
  SphereTermsOf<Number> terms;
  set_terms(terms, sphere, triangle);
  return terms;
}

/// Returns whether the premise of Z2 holds.
bool has_usual_sizes(const SphereTermsOf<Sized>& terms) {
  SizeRange range;
  range.include(terms);
  return range.is_usual();
}
bool has_usual_sizes(const SphereTermsOf<Bounded>&) { return true; }

/// Returns bounds of the t at which the ball comes to a part (S3).
template <typename Number>
DoubleRange time_of(const SphereTermsOf<Number>& terms, Feature part) {
  if (part == Feature::face) {
    return time_to_plane(terms.from_corner[0], terms.step, normal_of(terms), terms.radius);
  }
  const Vector<Number>& w = terms.from_corner[index_of(part)];
  if (is_corner(part)) return time_to_point(w, terms.step, terms.radius);
  return time_to_line(w, terms.step, terms.edge[index_of(part)], terms.radius);
}

/// Rounds the weights of a contact that is not at a corner.
template <typename Number, typename Scalar, typename AnyTriangle>
SUREHIT_NOINLINE bool try_round_weights(const SweptSphere<Scalar>& sphere, const AnyTriangle& triangle,
                                        const SphereContact& contact, ShapeHit<Scalar>& hit) {
  const SphereTermsOf<Number> terms = terms_of<Number>(sphere, triangle);
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
  return try_round_edge_weights(edge, dot(terms.from_corner[edge], e), dot(terms.step, e), t, dot(e, e), hit);
}

/// Rounds the weights of a contact inside a triangle or an edge by what knows their bounds at little cost.
bool try_round_simple_weights(const SweptSphere<float>& sphere, const Triangle<float>& triangle,
                              const SphereContact& contact, ShapeHit<float>& hit) {
  const DoubleRange t = {contact.t_lower, contact.t_upper};
  if (contact.feature == Feature::face) {
    const auto [u, v] = FaceContact(sphere, triangle).weights(t);
    return try_round(u, hit.u) && try_round(v, hit.v);
  }
  const std::size_t edge = index_of(contact.feature);
  const DoubleRange share = EdgeContact(sphere, triangle, edge).share(t);
  if (share.upper == 0) return false;
  const DoubleRange rest = {1 - share.upper - 0x1p-52, 1 - share.lower + 0x1p-52};
  return try_round_edge_weights(
      edge, [&] { return rest; }, [&] { return share; }, hit);
}

template <typename Number, typename Scalar, typename AnyTriangle>
SUREHIT_NOINLINE Verdict find_contact(const SweptSphere<Scalar>& sphere, const AnyTriangle& triangle,
                                      SphereContact& found, SphereFindings& findings) {
  const SphereTermsOf<Number> terms = terms_of<Number>(sphere, triangle);
  if (!has_usual_sizes(terms)) return Verdict::undecided;
  bool has_face = false;
  for (const Number& x : normal_of(terms)) has_face |= x.sign().value_or(0) != 0;
  if (!has_face) return Verdict::undecided;
  constexpr Outline outline;
  bool is_alone = true;
  const auto comes_before = [&](Feature, Feature) { return is_alone = false; };
  SphereTouch touch(terms, outline);
  const std::optional<SphereContact> contact = touch.find(comes_before, findings);
  if (!touch.is_certain() || !(is_alone || touch.is_final())) return Verdict::undecided;
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

template <typename Scalar, typename AnyTriangle>
Verdict bounded_contact(const SweptSphere<Scalar>& sphere, const AnyTriangle& triangle, SphereContact& found,
                        SphereFindings& findings) {
  if (has_usual_images(triangle)) {
    const Verdict verdict = find_contact<Sized>(sphere, triangle, found, findings);
    if (verdict != Verdict::undecided) return verdict;
  }
  return find_contact<Bounded>(sphere, triangle, found, findings);
}

template <typename Scalar>
Verdict simple_contact(const SweptSphere<Scalar>& sphere, const Triangle<Scalar>& triangle, double limit,
                       SphereContact& found) {
  DoubleRange t;
  std::optional<std::size_t> passed;
  Verdict verdict = FaceContact(sphere, triangle).find(limit, t, passed);
  Feature feature = Feature::face;
  if (verdict == Verdict::undecided && passed) {
    verdict = EdgeContact(sphere, triangle, *passed).find(limit, t);
    feature = edge_feature(*passed);
  }
  found = {t.lower, t.upper, feature, feature, verdict == Verdict::hit && t.upper == 0};
  return verdict;
}

template <typename Scalar, typename AnyTriangle>
bool try_round(const SweptSphere<Scalar>& sphere, const AnyTriangle& triangle, const SphereContact& contact,
               ShapeHit<Scalar>& hit) {
  hit.t = static_cast<Scalar>(contact.t_lower);
  if (hit.t != static_cast<Scalar>(contact.t_upper)) return false;
  hit.u = contact.feature == Feature::corner_b ? Scalar{1} : Scalar{0};
  hit.v = contact.feature == Feature::corner_c ? Scalar{1} : Scalar{0};
  if (is_corner(contact.feature)) return true;
  if constexpr (std::is_same_v<AnyTriangle, Triangle<float>>) {
    if (try_round_simple_weights(sphere, triangle, contact, hit)) return true;
  }
  return (has_usual_images(triangle) && try_round_weights<Sized>(sphere, triangle, contact, hit)) ||
         try_round_weights<Bounded>(sphere, triangle, contact, hit);
}

template Verdict simple_contact(const SweptSphere<float>&, const Triangle<float>&, double, SphereContact&);
template Verdict simple_contact(const SweptSphere<double>&, const Triangle<double>&, double, SphereContact&);
#define SUREHIT_INSTANTIATE(Scalar, AnyTriangle)                                                                     \
  template Verdict bounded_contact(const SweptSphere<Scalar>&, const AnyTriangle&, SphereContact&, SphereFindings&); \
  template bool try_round(const SweptSphere<Scalar>&, const AnyTriangle&, const SphereContact&, ShapeHit<Scalar>&);
SUREHIT_INSTANTIATE(float, Triangle<float>)
SUREHIT_INSTANTIATE(double, Triangle<double>)
SUREHIT_INSTANTIATE(float, PlacedTriangle<float>)
SUREHIT_INSTANTIATE(double, PlacedTriangle<double>)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit::detail
