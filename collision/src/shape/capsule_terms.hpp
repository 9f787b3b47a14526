#pragma once

#include <cstddef>

#include "shape/capsule_contact.hpp"
#include "shape/sphere_terms.hpp"

namespace surehit::detail {

/// A moving capsule and a triangle, in differences: those of its centre, and the half axis.
template <typename Difference, typename Radius>
struct CapsuleTerms : SphereTerms<Difference, Radius> {
  Vector<Difference> half_axis;  ///< The way from the centre to an end of the core.
};

/// Returns x, or x moved to an end of the core: x - A or x + A.
template <typename X, typename A>
[[nodiscard]] auto moved_to(CorePart core, const Vector<X>& x, const Vector<A>& half_axis) {
  using Sum = decltype(x[0] + half_axis[0]);
  if (core == CorePart::low_end) {
    return Vector<Sum>{x[0] - half_axis[0], x[1] - half_axis[1], x[2] - half_axis[2]};
  }
  if (core == CorePart::high_end) {
    return Vector<Sum>{x[0] + half_axis[0], x[1] + half_axis[1], x[2] + half_axis[2]};
  }
  return Vector<Sum>{x[0], x[1], x[2]};
}

/// Returns e × A, the normal of the parallelogram between an edge and the axis.
template <typename Terms>
[[nodiscard]] auto wall_normal(const Terms& terms, std::size_t edge) {
  return cross(terms.edge[edge], terms.half_axis);
}

/// Returns true if a vector is zero. It is not if one of its components certainly is not.
template <typename Number>
[[nodiscard]] bool is_zero(const Vector<Number>& x, Signs& signs) {
  Signs unheard;
  for (const Number& component : x) {
    if (unheard.of(component) != 0) return false;
  }
  for (const Number& component : x) static_cast<void>(signs.of(component));
  return true;
}

template <typename Terms>
[[nodiscard]] CoreTilt tilt_of(const Terms& terms, Signs& signs) {
  CoreTilt tilt;
  tilt.is_point = is_zero(terms.half_axis, signs);
  tilt.of_plane = signs.of(dot(normal_of(terms), terms.half_axis));
  for (std::size_t edge = 0; edge < 3; ++edge) tilt.is_along[edge] = is_zero(wall_normal(terms, edge), signs);
  return tilt;
}

}  // namespace surehit::detail
