#include "shape/bounded_capsule.hpp"

#include <algorithm>
#include <optional>

#include "shape/bounded_approach.hpp"
#include "shape/capsule_touch.hpp"
#include "shape/exact_capsule.hpp"
#include "support/inlining.hpp"
#include "support/rounding_flags.hpp"

namespace surehit::detail {
namespace {

template <typename Number>
using TermsOf = CapsuleTerms<Number, Number>;

/// Returns whether the premise of Z2 holds.
bool has_usual_sizes(const TermsOf<Sized>& terms) {
  SizeRange range;
  range.include(static_cast<const SphereTerms<Sized, Sized>&>(terms));
  range.include(terms.half_axis);
  return range.is_usual();
}
bool has_usual_sizes(const TermsOf<Bounded>&) { return true; }

template <typename Number>
Vector<Number> from_corner(const TermsOf<Number>& terms, std::size_t corner, CorePart core) {
  return moved_to(core, terms.from_corner[corner], terms.half_axis);
}

/// Returns bounds of the t at which two parts come within the radius (C5).
template <typename Number>
DoubleRange time_of(const TermsOf<Number>& terms, const CapsuleContact& contact) {
  const bool is_inside = contact.core == CorePart::inside;
  if (contact.feature == Feature::face) {
    return time_to_plane(from_corner(terms, 0, contact.core), terms.step, normal_of(terms), terms.radius);
  }
  const std::size_t index = index_of(contact.feature);
  const Vector<Number> w = from_corner(terms, index, contact.core);
  if (is_corner(contact.feature)) {
    if (is_inside) return time_to_line(w, terms.step, terms.half_axis, terms.radius);
    return time_to_point(w, terms.step, terms.radius);
  }
  const Vector<Number>& e = terms.edge[index];
  if (is_inside) return time_to_plane(w, terms.step, cross(e, terms.half_axis), terms.radius);
  return time_to_line(w, terms.step, e, terms.radius);
}

/// Rounds the weights of a contact at the inside of the triangle (C7).
template <typename Number, typename Scalar>
bool try_round_weights_of_face(const TermsOf<Number>& terms, const CapsuleContact& contact, ShapeHit<Scalar>& hit) {
  const DoubleRange t = {contact.t_lower, contact.t_upper};
  const Vector<Number> n = normal_of(terms);
  const Vector<Number> w = from_corner(terms, 0, contact.core);
  // Where the core crosses the triangle, A takes the place of n.
  const Vector<Number>& along = contact.core == CorePart::inside ? terms.half_axis : n;
  Number square = dot(along, n);
  const bool is_negative = square.value < 0;
  if (is_negative) square = -square;
  const auto try_weight = [&](const Vector<Number>& edge, Scalar& weight) {
    Number at_start = dot(along, cross(edge, w));
    Number rate = dot(along, cross(edge, terms.step));
    if (is_negative) {
      at_start = -at_start;
      rate = -rate;
    }
    return try_round(weight_of(at_start, rate, t, square), weight);
  };
  return try_weight(terms.edge[2], hit.u) && try_weight(terms.edge[0], hit.v);
}

/// Rounds the weights of a contact at an edge (C7).
template <typename Number, typename Scalar>
bool try_round_weights_of_edge(const TermsOf<Number>& terms, const CapsuleContact& contact, ShapeHit<Scalar>& hit) {
  const DoubleRange t = {contact.t_lower, contact.t_upper};
  const std::size_t edge = index_of(contact.feature);
  const Vector<Number>& e = terms.edge[edge];
  const bool is_inside = contact.core == CorePart::inside;
  const Vector<Number> along = is_inside ? cross(terms.half_axis, cross(e, terms.half_axis)) : e;
  const Number at_start = dot(along, from_corner(terms, edge, contact.core));
  return try_round_edge_weights(edge, at_start, dot(along, terms.step), t, dot(along, e), hit);
}

/// Rounds the weights of a contact that is not at a corner.
template <typename Number, typename Scalar, typename AnyTriangle>
SUREHIT_NOINLINE bool try_round_weights(const SweptCapsule<Scalar>& capsule, const AnyTriangle& triangle,
                                        const CapsuleContact& contact, ShapeHit<Scalar>& hit) {
  TermsOf<Number> terms;
  set_terms(terms, capsule, triangle);
  if (!has_usual_sizes(terms)) return false;
  return is_edge(contact.feature) ? try_round_weights_of_edge(terms, contact, hit)
                                  : try_round_weights_of_face(terms, contact, hit);
}

/// Returns how the core lies to the parts of a triangle. Sizes never know that it is parallel to a wall. Exact products
/// of floats do, and integers always do.
template <typename Scalar, typename AnyTriangle>
CoreTilt known_tilt(const TermsOf<Bounded>& terms, const SweptCapsule<Scalar>& capsule, const AnyTriangle& triangle) {
  Signs signs;
  CoreTilt tilt = tilt_of(terms, signs);
  if (!signs.is_certain()) tilt = exact_tilt(capsule, triangle);
  return tilt;
}
template <typename Scalar, typename AnyTriangle>
CoreTilt known_tilt(const TermsOf<Sized>& terms, const SweptCapsule<Scalar>& capsule, const AnyTriangle& triangle) {
  Signs signs;
  const CoreTilt tilt = tilt_of(terms, signs);
  if (signs.is_certain()) return tilt;
  TermsOf<Bounded> bounded;
  set_terms(bounded, capsule, triangle);
  return known_tilt(bounded, capsule, triangle);
}

template <typename Number, typename Scalar, typename AnyTriangle>
SUREHIT_NOINLINE Verdict find_contact(const SweptCapsule<Scalar>& capsule, const AnyTriangle& triangle,
                                      CapsuleContact& found, CapsuleFindings& findings) {
  TermsOf<Number> terms;
  set_terms(terms, capsule, triangle);
  if (!has_usual_sizes(terms)) return Verdict::undecided;
  bool has_face = false;
  for (const Number& x : normal_of(terms)) has_face |= x.sign().value_or(0) != 0;
  if (!has_face) return Verdict::undecided;
  if (!findings.tilt) findings.tilt = known_tilt(terms, capsule, triangle);
  constexpr Outline outline;
  bool is_alone = true;
  const auto comes_before = [&](const CapsuleContact&, const CapsuleContact&) { return is_alone = false; };
  CapsuleTouch touch(terms, outline, *findings.tilt);
  const std::optional<CapsuleContact> contact = touch.find(comes_before, findings);
  if (!touch.is_certain() || !(is_alone || touch.is_final())) return Verdict::undecided;
  if (!contact) return Verdict::miss;
  found = *contact;
  if (!found.at_start) {
    const DoubleRange t = settled(time_of(terms, found));
    found.t_lower = t.lower;
    found.t_upper = std::min(t.upper, 1.0);
  }
  return Verdict::hit;
}

}  // namespace

template <typename Scalar, typename AnyTriangle>
Verdict bounded_contact(const SweptCapsule<Scalar>& capsule, const AnyTriangle& triangle, CapsuleContact& found,
                        CapsuleFindings& findings) {
  if constexpr (has_short_sums<AnyTriangle>) {
    const Verdict verdict = find_contact<Sized>(capsule, triangle, found, findings);
    if (verdict != Verdict::undecided) return verdict;
  }
  return find_contact<Bounded>(capsule, triangle, found, findings);
}

template <typename Scalar, typename AnyTriangle>
bool try_round(const SweptCapsule<Scalar>& capsule, const AnyTriangle& triangle, const CapsuleContact& contact,
               ShapeHit<Scalar>& hit) {
  hit.t = static_cast<Scalar>(contact.t_lower);
  if (hit.t != static_cast<Scalar>(contact.t_upper)) return false;
  hit.u = contact.feature == Feature::corner_b ? Scalar{1} : Scalar{0};
  hit.v = contact.feature == Feature::corner_c ? Scalar{1} : Scalar{0};
  if (is_corner(contact.feature)) return true;
  if constexpr (has_short_sums<AnyTriangle>) {
    if (try_round_weights<Sized>(capsule, triangle, contact, hit)) return true;
  }
  return try_round_weights<Bounded>(capsule, triangle, contact, hit);
}

#define SUREHIT_INSTANTIATE(Scalar, AnyTriangle)                                                     \
  template Verdict bounded_contact(const SweptCapsule<Scalar>&, const AnyTriangle&, CapsuleContact&, \
                                   CapsuleFindings&);                                                \
  template bool try_round(const SweptCapsule<Scalar>&, const AnyTriangle&, const CapsuleContact&, ShapeHit<Scalar>&);
SUREHIT_INSTANTIATE(float, Triangle<float>)
SUREHIT_INSTANTIATE(double, Triangle<double>)
SUREHIT_INSTANTIATE(float, PlacedTriangle<float>)
SUREHIT_INSTANTIATE(double, PlacedTriangle<double>)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit::detail
