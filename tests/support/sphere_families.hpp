#pragma once

#include <array>
#include <cstdint>
#include <ostream>
#include <string>

#include "support/random.hpp"
#include "surehit/swept_sphere.hpp"
#include "surehit/triangle.hpp"

namespace surehit::test {

/// Kinds of moving balls and triangles that are hard in different ways.
enum class SphereFamily : std::uint8_t {
  general,
  tangent,         ///< grazes a face, an edge or a corner in whole numbers, turned by rational angles
  beside_tangent,  ///< the same with one number moved by one ulp
  in_plane,        ///< slides in the triangle's plane, or at the height of the radius above it
  starts_touching,
  starts_at_distance,  ///< begins at a distance of exactly the radius
  small_steps,         ///< a thousandth of the triangle's size and less
  small_radii,
  huge_radii,
  far_away,
  slivers,
  degenerate_triangles,
  at_rest,
  no_radius,
  small_integers,
  mixed_magnitudes,  ///< from the least denormal to the largest number
  inside,            ///< The whole triangle is in the ball: at the start, at the end or on the way.
};

inline constexpr std::array all_sphere_families = {
    SphereFamily::general,          SphereFamily::tangent,         SphereFamily::beside_tangent,
    SphereFamily::in_plane,         SphereFamily::starts_touching, SphereFamily::starts_at_distance,
    SphereFamily::small_steps,      SphereFamily::small_radii,     SphereFamily::huge_radii,
    SphereFamily::far_away,         SphereFamily::slivers,         SphereFamily::degenerate_triangles,
    SphereFamily::at_rest,          SphereFamily::no_radius,       SphereFamily::small_integers,
    SphereFamily::mixed_magnitudes, SphereFamily::inside,
};

[[nodiscard]] std::string name_of(SphereFamily family);
inline void PrintTo(SphereFamily family, std::ostream* out) { *out << name_of(family); }

template <typename Scalar>
struct SpherePair {
  SweptSphere<Scalar> sphere;
  Triangle<Scalar> triangle;
};

/// The next finite pair of a family. Call it in the default floating-point environment: it then draws the same
/// everywhere.
template <typename Scalar>
[[nodiscard]] SpherePair<Scalar> draw_sphere_pair(SphereFamily family, Random& random);

}  // namespace surehit::test
