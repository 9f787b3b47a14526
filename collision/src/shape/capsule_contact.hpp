#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "shape/shape_contact.hpp"
#include "surehit/shape_hit.hpp"
#include "surehit/swept_capsule.hpp"
#include "surehit/triangle.hpp"
#include "walk/swept_walk.hpp"

namespace surehit::detail {

/// A part of a capsule's core: the segment from centre - half_axis to centre + half_axis.
enum class CorePart : std::uint8_t {
  low_end,   ///< centre - half_axis
  high_end,  ///< centre + half_axis
  inside,    ///< What is between the ends.
  centre,    ///< The centre alone. It counts where the core is parallel to the part of the triangle.
};

/// The number of parts of a core.
inline constexpr std::size_t core_part_count = 4;

/// A contact of a moving capsule with a triangle. It holds what decides which of two hits is first. If they do not
/// touch at the start, t is the root of the equation of the two parts.
struct CapsuleContact {
  double t_lower = 0;                 ///< The exact t is at least this.
  double t_upper = 0;                 ///< The exact t is at most this.
  Feature feature = Feature::face;    ///< The part of the triangle that has the touched point.
  CorePart core = CorePart::low_end;  ///< The part of the core that is nearest to the touched point.
  bool at_start = false;              ///< True if they touch at t = 0.
};

/// How a core lies to the parts of a triangle. Which parts can be nearest to each other depends on it (C2).
struct CoreTilt {
  bool is_point = false;              ///< True if the core is a point.
  int of_plane = 0;                   ///< The sign of n·A. It is 0 if the core is parallel to the triangle.
  std::array<bool, 3> is_along = {};  ///< True for each edge that is parallel to the core.
};

/// What is certain about the parts of a triangle and of a core, if it does not decide whether they touch. Each stage
/// adds to it, and asks only about what is left.
struct CapsuleFindings {
  /// A bit for each part of the triangle with each part of the core.
  using Parts = std::bitset<feature_count * core_part_count>;

  std::optional<CoreTilt> tilt;
  Parts never_entered;  ///< They do not come within the radius later, or are not nearest to each other then.
  Parts never_nearest;  ///< They are not nearest to each other at the start.

  [[nodiscard]] static std::size_t index_of(const CapsuleContact& parts) {
    return core_part_count * static_cast<std::size_t>(parts.feature) + static_cast<std::size_t>(parts.core);
  }
};

template <typename AnyScalar>
struct ShapeTypes<SweptCapsule<AnyScalar>> {
  using Scalar = AnyScalar;
  using Contact = CapsuleContact;
  using Findings = CapsuleFindings;
};

/// Returns true if a capsule can touch something: all numbers are finite, and the radius is not negative.
template <typename Scalar>
[[nodiscard]] bool is_valid(const SweptCapsule<Scalar>& capsule);
/// Returns the box around a capsule, and its way.
template <typename Scalar>
[[nodiscard]] SweptExtents swept_extents(const SweptCapsule<Scalar>& capsule);
/// Returns true if two triangles share the corner or the edge that has the touched point. Neighbours often do. Then the
/// capsule comes to both at the same time, with the same part of its core or not.
template <typename Scalar>
[[nodiscard]] bool are_timed_alike(const Triangle<Scalar>& x_triangle, const CapsuleContact& x,
                                   const Triangle<Scalar>& y_triangle, const CapsuleContact& y);

}  // namespace surehit::detail
