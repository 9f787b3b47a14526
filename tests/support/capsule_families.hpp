#pragma once

#include <array>
#include <cstdint>
#include <ostream>
#include <string>

#include "support/random.hpp"
#include "surehit/swept_capsule.hpp"
#include "surehit/triangle.hpp"

namespace surehit::test {

/// Kinds of moving capsules and triangles that are hard in different ways.
enum class CapsuleFamily : std::uint8_t {
  general,
  upright_at_walls,  ///< The axis is parallel to the triangle and to one of its edges, or one ulp beside.
  lying_on_floors,   ///< The axis is parallel to the triangle, or one ulp beside.
  tangent,           ///< grazes a face, an edge or a corner in whole numbers, turned by rational angles
  beside_tangent,    ///< the same with one number moved by one ulp
  in_plane,          ///< slides in the triangle's plane, or at the height of the radius above it
  starts_touching,
  starts_across,       ///< The core crosses the triangle at the start.
  starts_at_distance,  ///< begins at a distance of exactly the radius
  small_steps,         ///< a thousandth of the triangle's size and less
  small_radii,
  huge_radii,
  short_axes,
  long_axes,
  far_away,
  slivers,
  degenerate_triangles,
  at_rest,
  no_radius,
  no_axis,
  small_integers,
  mixed_magnitudes,  ///< from the least denormal to the largest number
  inside,            ///< The whole triangle is in the capsule: at the start, at the end or on the way.
};

inline constexpr std::array all_capsule_families = {
    CapsuleFamily::general,
    CapsuleFamily::upright_at_walls,
    CapsuleFamily::lying_on_floors,
    CapsuleFamily::tangent,
    CapsuleFamily::beside_tangent,
    CapsuleFamily::in_plane,
    CapsuleFamily::starts_touching,
    CapsuleFamily::starts_across,
    CapsuleFamily::starts_at_distance,
    CapsuleFamily::small_steps,
    CapsuleFamily::small_radii,
    CapsuleFamily::huge_radii,
    CapsuleFamily::short_axes,
    CapsuleFamily::long_axes,
    CapsuleFamily::far_away,
    CapsuleFamily::slivers,
    CapsuleFamily::degenerate_triangles,
    CapsuleFamily::at_rest,
    CapsuleFamily::no_radius,
    CapsuleFamily::no_axis,
    CapsuleFamily::small_integers,
    CapsuleFamily::mixed_magnitudes,
    CapsuleFamily::inside,
};

[[nodiscard]] std::string name_of(CapsuleFamily family);
inline void PrintTo(CapsuleFamily family, std::ostream* out) { *out << name_of(family); }

template <typename Scalar>
struct CapsulePair {
  SweptCapsule<Scalar> capsule;
  Triangle<Scalar> triangle;
};

/// The next finite pair of a family. Call it in the default floating-point environment: it then draws the same
/// everywhere.
template <typename Scalar>
[[nodiscard]] CapsulePair<Scalar> draw_capsule_pair(CapsuleFamily family, Random& random);

}  // namespace surehit::test
