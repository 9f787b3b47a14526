#include "shape/exact_sphere.hpp"

#include <array>
#include <cstddef>

#include "shape/exact_approach.hpp"
#include "shape/exact_differences.hpp"
#include "shape/outline.hpp"
#include "shape/sphere_touch.hpp"
#include "support/inlining.hpp"
#include "support/rounding_flags.hpp"

namespace surehit::detail {
namespace {

/// The numbers of bits of the exact terms. A sum of k terms adds k - 1 to the bits of its terms.
template <typename AnyTriangle>
struct SphereBits {
  static constexpr int difference = DifferenceBits<AnyTriangle>::value;
  static constexpr int quadratic = 6 * difference + 8;  ///< For (n·w)² - r² n·n, the longest coefficient.
  static constexpr int volume = 4 * difference + 4;     ///< For n·(w × e) and e·e.
};

template <typename AnyTriangle>
using SphereIntTerms =
    SphereTerms<WideInt<SphereBits<AnyTriangle>::difference>, WideInt<SphereBits<AnyTriangle>::difference>>;
template <typename AnyTriangle>
using SphereRoot = QuadraticRoot<SphereBits<AnyTriangle>::quadratic>;

/// A ball and a triangle in integers. `AnyTriangle` is `Triangle` or `PlacedTriangle`.
template <typename Scalar, typename AnyTriangle>
class ExactSphere {
 public:
  ExactSphere(const SweptSphere<Scalar>& sphere, const AnyTriangle& triangle) {
    BinaryUnit unit;
    include(unit, sphere, triangle);
    unit.include<Scalar>({sphere.radius, 0, 0});
    if (unit.is_empty()) unit.exponent = 0;
    set_differences(terms_, sphere, triangle, unit);
    set_integer(terms_.radius, sphere.radius, unit);
    if (is_zero(normal_of(terms_))) outline_ = outline_without_area(local_corners(triangle));
  }

  [[nodiscard]] std::optional<SphereContact> find(SphereFindings& findings) const {
    const auto comes_before = [&](Feature x, Feature y) { return RootOrder(root(x), root(y)).sign() < 0; };
    std::optional<SphereContact> contact = SphereTouch(terms_, outline_).find(comes_before, findings);
    if (contact && !contact->at_start) {
      const DoubleRange t = root(contact->timed_by).range();
      contact->t_lower = t.lower;
      contact->t_upper = std::min(t.upper, 1.0);
    }
    return contact;
  }

  /// Returns the sign of the step times the normal.
  [[nodiscard]] int sign_along() const { return dot(normal_of(terms_), terms_.step).sign(); }

  /// Returns the equation of the t at which the ball comes to a part (S3).
  [[nodiscard]] SUREHIT_NOINLINE SphereRoot<AnyTriangle> root(Feature part) const {
    constexpr int bits = Bits::quadratic;
    const auto rr = terms_.radius * terms_.radius;
    const auto& d = terms_.step;
    if (part == Feature::face) return root_of_plane<bits>(terms_.from_corner[0], d, rr, normal_of(terms_));
    const auto& w = terms_.from_corner[index_of(part)];
    if (is_corner(part)) return root_of_point<bits>(w, d, rr);
    return root_of_line<bits>(w, d, rr, terms_.edge[index_of(part)]);
  }

  /// Returns the way from the touched point to the centre, times some number.
  [[nodiscard]] Direction direction(const SphereContact& contact) const {
    const Feature part = contact.at_start ? contact.feature : contact.timed_by;
    const auto& d = terms_.step;
    if (part == Feature::face) return direction_of_plane(normal_of(terms_), terms_.from_corner[0]);
    const auto& w = terms_.from_corner[index_of(part)];
    if (is_corner(part)) return contact.at_start ? direction_of(w) : direction_at(root(part), w, d);
    const auto& e = terms_.edge[index_of(part)];
    return contact.at_start ? direction_of(across(w, e)) : direction_at(root(part), across(w, e), across(d, e));
  }

  /// Sets t, u and v of a hit.
  void round(const SphereContact& contact, ShapeHit<Scalar>& hit) const {
    hit.t = 0;
    if (contact.at_start) return round_weights(contact, nullptr, hit);
    const SphereRoot<AnyTriangle> t = root(contact.timed_by);
    hit.t = t.template rounded<Scalar>();
    round_weights(contact, &t, hit);
  }

 private:
  using Bits = SphereBits<AnyTriangle>;
  using Volume = WideInt<Bits::volume>;

  /// Sets the weights of b and c at the touched point (S7).
  SUREHIT_NOINLINE void round_weights(const SphereContact& contact, const SphereRoot<AnyTriangle>* t,
                                      ShapeHit<Scalar>& hit) const {
    hit.u = contact.feature == Feature::corner_b ? Scalar{1} : Scalar{0};
    hit.v = contact.feature == Feature::corner_c ? Scalar{1} : Scalar{0};
    if (is_corner(contact.feature)) return;
    const auto& d = terms_.step;
    if (is_edge(contact.feature)) {
      const std::size_t edge = index_of(contact.feature);
      const auto& e = terms_.edge[edge];
      round_edge_weights<Scalar, Bits::quadratic, Bits::volume>(edge, t, dot(terms_.from_corner[edge], e), dot(d, e),
                                                                dot(e, e), hit);
      return;
    }
    const auto n = normal_of(terms_);
    const Volume nn = dot(n, n);
    const auto& w = terms_.from_corner[0];
    const auto weight = [&](const auto& edge) {
      return rounded_weight<Scalar, Bits::quadratic, Bits::volume>(t, dot(n, cross(edge, w)), dot(n, cross(edge, d)),
                                                                   nn);
    };
    hit.u = weight(terms_.edge[2]);  // n·(w × (c - a)) is n·(ca × w).
    hit.v = weight(terms_.edge[0]);
  }

  SphereIntTerms<AnyTriangle> terms_;
  Outline outline_;
};

}  // namespace

template <typename Scalar, typename AnyTriangle>
std::optional<SphereContact> exact_contact(const SweptSphere<Scalar>& sphere, const AnyTriangle& triangle,
                                           SphereFindings findings) {
  return ExactSphere<Scalar, AnyTriangle>(sphere, triangle).find(findings);
}

template <typename Scalar, typename AnyTriangle>
int compare_times(const SweptSphere<Scalar>& sphere, const AnyTriangle& x_triangle, const SphereContact& x,
                  const AnyTriangle& y_triangle, const SphereContact& y) {
  if (x.at_start || y.at_start) return static_cast<int>(y.at_start) - static_cast<int>(x.at_start);
  // Each equation has a unit of its own. Its coefficients have one degree, so another unit has the same root.
  const SphereRoot<AnyTriangle> x_root = ExactSphere<Scalar, AnyTriangle>(sphere, x_triangle).root(x.timed_by);
  const SphereRoot<AnyTriangle> y_root = ExactSphere<Scalar, AnyTriangle>(sphere, y_triangle).root(y.timed_by);
  return RootOrder(x_root, y_root).sign();
}

template <typename Scalar, typename AnyTriangle>
int compare_time(const SweptSphere<Scalar>& sphere, const AnyTriangle& triangle, const SphereContact& contact,
                 Scalar limit) {
  if (contact.at_start) return limit > 0 ? -1 : 0;
  if (!(limit > 0)) return 1;
  return ExactSphere<Scalar, AnyTriangle>(sphere, triangle).root(contact.timed_by).compare(limit);
}

template <typename Scalar, typename AnyTriangle>
int sign_along(const SweptSphere<Scalar>& sphere, const AnyTriangle& triangle) {
  return ExactSphere<Scalar, AnyTriangle>(sphere, triangle).sign_along();
}

template <typename Scalar, typename AnyTriangle>
void round_exactly(const SweptSphere<Scalar>& sphere, const AnyTriangle& triangle, const SphereContact& contact,
                   ShapeHit<Scalar>& hit) {
  ExactSphere<Scalar, AnyTriangle>(sphere, triangle).round(contact, hit);
}

template <typename Scalar, typename AnyTriangle>
Direction exact_direction(const SweptSphere<Scalar>& sphere, const AnyTriangle& triangle,
                          const SphereContact& contact) {
  return ExactSphere<Scalar, AnyTriangle>(sphere, triangle).direction(contact);
}

#define SUREHIT_INSTANTIATE(Scalar, AnyTriangle)                                                                       \
  template std::optional<SphereContact> exact_contact(const SweptSphere<Scalar>&, const AnyTriangle&, SphereFindings); \
  template int compare_times(const SweptSphere<Scalar>&, const AnyTriangle&, const SphereContact&, const AnyTriangle&, \
                             const SphereContact&);                                                                    \
  template int compare_time(const SweptSphere<Scalar>&, const AnyTriangle&, const SphereContact&, Scalar);             \
  template int sign_along(const SweptSphere<Scalar>&, const AnyTriangle&);                                             \
  template void round_exactly(const SweptSphere<Scalar>&, const AnyTriangle&, const SphereContact&,                    \
                              ShapeHit<Scalar>&);                                                                      \
  template Direction exact_direction(const SweptSphere<Scalar>&, const AnyTriangle&, const SphereContact&);
SUREHIT_INSTANTIATE(float, Triangle<float>)
SUREHIT_INSTANTIATE(double, Triangle<double>)
SUREHIT_INSTANTIATE(float, PlacedTriangle<float>)
SUREHIT_INSTANTIATE(double, PlacedTriangle<double>)
#undef SUREHIT_INSTANTIATE

}  // namespace surehit::detail
