#pragma once

#include <cstddef>

#include "shape/box_terms.hpp"
#include "shape/shape_contact.hpp"
#include "surehit/swept_box.hpp"
#include "surehit/triangle.hpp"
#include "walk/swept_walk.hpp"

namespace surehit::detail {

/// A contact of a moving box with a triangle. It holds what decides which of two hits is first.
struct BoxContact {
  double t_lower = 0;  ///< The exact t is at least this.
  double t_upper = 0;  ///< The exact t is at most this.
  /// The axis of the side that the centre passes at t (B1). If there are several, it is any of them. It is
  /// `axis_count` if none is known for certain.
  std::size_t timed_by = axis_count;
  bool is_above = false;  ///< True if the centre passes this side from above.
  bool at_start = false;  ///< True if they touch at t = 0. Then no side is passed.
};

template <typename AnyScalar>
struct ShapeTypes<SweptBox<AnyScalar>> {
  using Scalar = AnyScalar;
  using Contact = BoxContact;
  using Findings = NoFindings;
};

/// Returns the part of a triangle on which these corners have a weight that is not zero.
[[nodiscard]] constexpr Feature feature_with(bool has_a, bool has_b, bool has_c) {
  if (has_a && has_b) return has_c ? Feature::face : Feature::edge_ab;
  if (has_c && (has_a || has_b)) return has_b ? Feature::edge_bc : Feature::edge_ca;
  return has_a ? Feature::corner_a : has_b ? Feature::corner_b : Feature::corner_c;
}

/// Returns true if a box can touch something: all numbers are finite, and no half extent is negative.
template <typename Scalar>
[[nodiscard]] bool is_valid(const SweptBox<Scalar>& box);
/// Returns a box, and its way.
template <typename Scalar>
[[nodiscard]] SweptExtents swept_extents(const SweptBox<Scalar>& box);
/// The t of the other axes follows from where a triangle begins or ends in the scene, or from its plane.
[[nodiscard]] constexpr bool is_timed_by_shared_part(const BoxContact& contact) {
  return contact.timed_by > normal_axis && contact.timed_by < axis_count;
}
/// Returns true if the same t follows for two triangles from the corners and edges that they share. Neighbours often
/// share an edge, and the triangles of a flat floor share their height.
template <typename Scalar>
[[nodiscard]] bool are_timed_alike(const Triangle<Scalar>& x_triangle, const BoxContact& x,
                                   const Triangle<Scalar>& y_triangle, const BoxContact& y);

}  // namespace surehit::detail
