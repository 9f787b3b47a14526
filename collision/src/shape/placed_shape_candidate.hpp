#pragma once

#include <cstdint>
#include <tuple>

#include "placement.hpp"
#include "shape/shape_contact.hpp"
#include "surehit/scene_shape_options.hpp"
#include "surehit/triangle.hpp"

namespace surehit::detail {

/// A placed triangle that a moving shape touches.
template <typename AnyShape>
struct PlacedShapeCandidate {
  using Shape = AnyShape;
  using AnyTriangle = PlacedTriangle<ScalarOf<Shape>>;
  using Options = SceneShapeQueryOptions<ScalarOf<Shape>>;

  std::uint32_t instance;                       ///< The index of the instance.
  std::uint32_t id;                             ///< The id of the triangle.
  Triangle<ScalarOf<Shape>> local;              ///< The corners of the triangle in the mesh.
  const Placement<ScalarOf<Shape>>* placement;  ///< Where the instance is.
  ContactOf<Shape> contact;                     ///< The contact.
  ScalarOf<Shape> share = 1;                    ///< The share of the motion that the shape sees.

  /// Returns the triangle for those who decide about it.
  [[nodiscard]] AnyTriangle whole_triangle() const { return {local, *placement, share}; }
  /// Returns what decides ties.
  [[nodiscard]] auto ids() const { return std::tie(instance, id); }
  /// Returns true if both contacts are known to have the same exact t.
  [[nodiscard]] bool is_timed_like(const PlacedShapeCandidate& other) const {
    return instance == other.instance && is_timed_by_shared_part(contact) && is_timed_by_shared_part(other.contact) &&
           are_timed_alike(local, contact, other.local, other.contact);
  }
};

}  // namespace surehit::detail
