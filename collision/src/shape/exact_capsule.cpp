#include "shape/exact_capsule.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "shape/bounded_approach.hpp"
#include "shape/capsule_touch.hpp"
#include "shape/exact_approach.hpp"
#include "shape/exact_differences.hpp"
#include "shape/exact_sphere.hpp"
#include "shape/outline.hpp"
#include "support/rounding_flags.hpp"

namespace surehit::detail {
namespace {

/// The numbers of bits of the exact terms. A sum of k terms adds k - 1 to the bits of its terms.
template <typename AnyTriangle>
struct CapsuleBits {
  static constexpr int difference = DifferenceBits<AnyTriangle>::value + 1;  ///< For an end of the core less a corner.
  static constexpr int quadratic = 6 * difference + 8;  ///< For (n·w)² - r² n·n, the longest coefficient.
  static constexpr int volume = 4 * difference + 5;     ///< For n·(w × e) and e·e.
};

template <typename AnyTriangle>
using IntTerms = CapsuleTerms<WideInt<DifferenceBits<AnyTriangle>::value>, WideInt<DifferenceBits<AnyTriangle>::value>>;
template <typename AnyTriangle>
using Root = QuadraticRoot<CapsuleBits<AnyTriangle>::quadratic>;

/// A capsule and a triangle in integers. `AnyTriangle` is `Triangle` or `PlacedTriangle`.
template <typename Scalar, typename AnyTriangle>
class ExactCapsule {
 public:
  ExactCapsule(const SweptCapsule<Scalar>& capsule, const AnyTriangle& triangle)
      : capsule_(capsule), triangle_(triangle) {
    BinaryUnit unit;
    include(unit, capsule, triangle);
    unit.include(capsule.half_axis);
    unit.include<Scalar>({capsule.radius, 0, 0});
    if (unit.is_empty()) unit.exponent = 0;
    set_differences(terms_, capsule, triangle, unit);
    const Vector3<Scalar> zero = {0, 0, 0};
    set_difference(terms_.half_axis, capsule.half_axis, zero, unit);
    set_integer(terms_.radius, capsule.radius, unit);
    if (is_zero(normal_of(terms_))) outline_ = outline_without_area(local_corners(triangle));
  }

  [[nodiscard]] SUREHIT_NOINLINE CoreTilt tilt() const {
    Signs signs;
    return tilt_of(terms_, signs);
  }

  [[nodiscard]] std::optional<CapsuleContact> find(CapsuleFindings& findings) const {
    if (!findings.tilt) {
      findings.tilt = tilt();
      rule_out_parts(findings);
    }
    const auto comes_before = [&](const CapsuleContact& x, const CapsuleContact& y) { return is_before(x, y); };
    std::optional<CapsuleContact> contact = CapsuleTouch(terms_, outline_, *findings.tilt).find(comes_before, findings);
    if (contact && !contact->at_start) set_bounds(*contact);
    return contact;
  }

  /// Returns the equation of the t at which two parts come within the radius (C5).
  [[nodiscard]] SUREHIT_NOINLINE Root<AnyTriangle> root(const CapsuleContact& contact) const {
    const auto rr = terms_.radius * terms_.radius;
    const auto& d = terms_.step;
    constexpr int bits = Bits::quadratic;
    const bool is_inside = contact.core == CorePart::inside;
    if (is_corner(contact.feature)) {
      const std::size_t corner = index_of(contact.feature);
      if (is_inside) return root_of_line<bits>(terms_.from_corner[corner], d, rr, terms_.half_axis);
      return root_of_point<bits>(from_corner(corner, contact.core), d, rr);
    }
    if (is_edge(contact.feature)) {
      const std::size_t edge = index_of(contact.feature);
      const auto& e = terms_.edge[edge];
      if (is_inside) return root_of_plane<bits>(terms_.from_corner[edge], d, rr, cross(e, terms_.half_axis));
      return root_of_line<bits>(from_corner(edge, contact.core), d, rr, e);
    }
    return root_of_plane<bits>(from_corner(0, contact.core), d, rr, normal_of(terms_));
  }

  /// Returns the way from the touched point to the nearest point of the core, times some number.
  [[nodiscard]] Direction direction(const CapsuleContact& contact) const {
    const bool is_inside = contact.core == CorePart::inside;
    const auto& d = terms_.step;
    const auto to_line = [&](const auto& w, const auto& e) {
      return contact.at_start ? direction_of(across(w, e)) : direction_at(root(contact), across(w, e), across(d, e));
    };
    if (is_corner(contact.feature)) {
      const std::size_t corner = index_of(contact.feature);
      if (is_inside) return to_line(terms_.from_corner[corner], terms_.half_axis);
      const auto w = from_corner(corner, contact.core);
      return contact.at_start ? direction_of(w) : direction_at(root(contact), w, d);
    }
    if (is_edge(contact.feature)) {
      const std::size_t edge = index_of(contact.feature);
      const auto& e = terms_.edge[edge];
      if (!is_inside) return to_line(from_corner(edge, contact.core), e);
      return direction_of_plane(cross(e, terms_.half_axis), terms_.from_corner[edge]);
    }
    if (is_inside) return {};
    return direction_of_plane(normal_of(terms_), from_corner(0, contact.core));
  }

  /// Sets t, u and v of a hit.
  void round(const CapsuleContact& contact, ShapeHit<Scalar>& hit) const {
    hit.t = 0;
    hit.u = contact.feature == Feature::corner_b ? Scalar{1} : Scalar{0};
    hit.v = contact.feature == Feature::corner_c ? Scalar{1} : Scalar{0};
    if (contact.at_start) return round_weights(contact, nullptr, hit);
    const Root<AnyTriangle> t = root(contact);
    hit.t = t.template rounded<Scalar>();
    round_weights(contact, &t, hit);
  }

 private:
  using Bits = CapsuleBits<AnyTriangle>;
  using Volume = WideInt<Bits::volume>;

  /// Doubles with bounds rule out most parts.
  SUREHIT_NOINLINE void rule_out_parts(CapsuleFindings& findings) const {
    CapsuleTerms<Bounded, Bounded> bounded;
    set_terms(bounded, capsule_, triangle_);
    const auto comes_before = [](const CapsuleContact&, const CapsuleContact&) { return false; };
    CapsuleTouch(bounded, outline_, *findings.tilt).find(comes_before, findings);
  }

  [[nodiscard]] auto from_corner(std::size_t corner, CorePart core) const {
    return moved_to(core, terms_.from_corner[corner], terms_.half_axis);
  }
  [[nodiscard]] SUREHIT_NOINLINE bool is_before(const CapsuleContact& x, const CapsuleContact& y) const {
    return RootOrder(root(x), root(y)).sign() < 0;
  }
  SUREHIT_NOINLINE void set_bounds(CapsuleContact& contact) const {
    const DoubleRange t = root(contact).range();
    contact.t_lower = t.lower;
    contact.t_upper = std::min(t.upper, 1.0);
  }

  /// Sets the weights of b and c at the touched point, unless it is a corner (C7).
  void round_weights(const CapsuleContact& contact, const Root<AnyTriangle>* t, ShapeHit<Scalar>& hit) const {
    if (is_edge(contact.feature)) return round_weights_of_edge(contact, t, hit);
    if (contact.feature != Feature::face) return;
    const auto n = normal_of(terms_);
    const auto w = from_corner(0, contact.core);
    const auto& d = terms_.step;
    // Where the core crosses the triangle, A takes the place of n.
    const bool crosses = contact.core == CorePart::inside;
    const auto weight = [&](const auto& edge) {
      if (!crosses) {
        const Volume nn = dot(n, n);
        return rounded_weight<Scalar, Bits::quadratic, Bits::volume>(t, dot(n, cross(edge, w)), dot(n, cross(edge, d)),
                                                                     nn);
      }
      return rounded_quotient<Scalar>(dot(terms_.half_axis, cross(edge, w)), dot(terms_.half_axis, n));
    };
    hit.u = weight(terms_.edge[2]);
    hit.v = weight(terms_.edge[0]);
  }
  SUREHIT_NOINLINE void round_weights_of_edge(const CapsuleContact& contact, const Root<AnyTriangle>* t,
                                              ShapeHit<Scalar>& hit) const {
    const std::size_t edge = index_of(contact.feature);
    const auto& e = terms_.edge[edge];
    Volume at_start;
    Volume rate;
    Volume square;
    if (contact.core == CorePart::inside) {
      const auto m = cross(e, terms_.half_axis);
      const auto across = cross(terms_.half_axis, m);
      at_start = dot(across, terms_.from_corner[edge]);
      rate = dot(across, terms_.step);
      square = dot(m, m);
    } else {
      at_start = dot(e, from_corner(edge, contact.core));
      rate = dot(e, terms_.step);
      square = dot(e, e);
    }
    round_edge_weights(edge, t, at_start, rate, square, hit);
  }

  const SweptCapsule<Scalar>& capsule_;
  const AnyTriangle& triangle_;
  IntTerms<AnyTriangle> terms_;
  Outline outline_;
};

}  // namespace

template <typename Scalar, typename AnyTriangle>
std::optional<CapsuleContact> exact_contact(const SweptCapsule<Scalar>& capsule, const AnyTriangle& triangle,
                                            CapsuleFindings findings) {
  return ExactCapsule<Scalar, AnyTriangle>(capsule, triangle).find(findings);
}

template <typename Scalar, typename AnyTriangle>
CoreTilt exact_tilt(const SweptCapsule<Scalar>& capsule, const AnyTriangle& triangle) {
  return ExactCapsule<Scalar, AnyTriangle>(capsule, triangle).tilt();
}

template <typename Scalar, typename AnyTriangle>
int compare_times(const SweptCapsule<Scalar>& capsule, const AnyTriangle& x_triangle, const CapsuleContact& x,
                  const AnyTriangle& y_triangle, const CapsuleContact& y) {
  if (x.at_start || y.at_start) return static_cast<int>(y.at_start) - static_cast<int>(x.at_start);
  // Each equation has a unit of its own. Its coefficients have one degree, so another unit has the same root.
  const Root<AnyTriangle> x_root = ExactCapsule<Scalar, AnyTriangle>(capsule, x_triangle).root(x);
  const Root<AnyTriangle> y_root = ExactCapsule<Scalar, AnyTriangle>(capsule, y_triangle).root(y);
  return RootOrder(x_root, y_root).sign();
}

template <typename Scalar, typename AnyTriangle>
int compare_time(const SweptCapsule<Scalar>& capsule, const AnyTriangle& triangle, const CapsuleContact& contact,
                 Scalar limit) {
  if (contact.at_start) return limit > 0 ? -1 : 0;
  if (!(limit > 0)) return 1;
  return ExactCapsule<Scalar, AnyTriangle>(capsule, triangle).root(contact).compare(limit);
}

template <typename Scalar, typename AnyTriangle>
int sign_along(const SweptCapsule<Scalar>& capsule, const AnyTriangle& triangle) {
  return sign_along(SweptSphere<Scalar>{capsule.start, capsule.end, capsule.radius}, triangle);
}

template <typename Scalar, typename AnyTriangle>
void round_exactly(const SweptCapsule<Scalar>& capsule, const AnyTriangle& triangle, const CapsuleContact& contact,
                   ShapeHit<Scalar>& hit) {
  ExactCapsule<Scalar, AnyTriangle>(capsule, triangle).round(contact, hit);
}

template <typename Scalar, typename AnyTriangle>
Direction exact_direction(const SweptCapsule<Scalar>& capsule, const AnyTriangle& triangle,
                          const CapsuleContact& contact) {
  return ExactCapsule<Scalar, AnyTriangle>(capsule, triangle).direction(contact);
}

#define SUREHIT_INSTANTIATE(Scalar, AnyTriangle)                                                             \
  template std::optional<CapsuleContact> exact_contact(const SweptCapsule<Scalar>&, const AnyTriangle&,      \
                                                       CapsuleFindings);                                     \
  template CoreTilt exact_tilt(const SweptCapsule<Scalar>&, const AnyTriangle&);                             \
  template int compare_times(const SweptCapsule<Scalar>&, const AnyTriangle&, const CapsuleContact&,         \
                             const AnyTriangle&, const CapsuleContact&);                                     \
  template int compare_time(const SweptCapsule<Scalar>&, const AnyTriangle&, const CapsuleContact&, Scalar); \
  template int sign_along(const SweptCapsule<Scalar>&, const AnyTriangle&);                                  \
  template void round_exactly(const SweptCapsule<Scalar>&, const AnyTriangle&, const CapsuleContact&,        \
                              ShapeHit<Scalar>&);                                                            \
  template Direction exact_direction(const SweptCapsule<Scalar>&, const AnyTriangle&, const CapsuleContact&);
SUREHIT_INSTANTIATE(float, Triangle<float>)
SUREHIT_INSTANTIATE(double, Triangle<double>)
SUREHIT_INSTANTIATE(float, PlacedTriangle<float>)
SUREHIT_INSTANTIATE(double, PlacedTriangle<double>)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit::detail
