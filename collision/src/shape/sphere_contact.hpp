#pragma once

#include <cstddef>
#include <cstdint>

#include "surehit/shape_hit.hpp"

namespace surehit::detail {

/// A contact of a moving ball with a triangle. It holds what decides which of two hits is first.
struct SphereContact {
  double t_lower = 0;               ///< The exact t is at least this.
  double t_upper = 0;               ///< The exact t is at most this.
  Feature feature = Feature::face;  ///< The part of the triangle that has the touched point.
  /// The part whose equation has t as a root. It differs from `feature` where the ball touches an edge or a corner in
  /// the moment when it also touches the plane.
  Feature timed_by = Feature::face;
  bool at_start = false;  ///< True if they touch at t = 0. Then the equation is not used.
};

[[nodiscard]] constexpr Feature edge_feature(std::size_t edge) {
  return static_cast<Feature>(static_cast<std::size_t>(Feature::edge_ab) + edge);
}
[[nodiscard]] constexpr Feature corner_feature(std::size_t corner) {
  return static_cast<Feature>(static_cast<std::size_t>(Feature::corner_a) + corner);
}
[[nodiscard]] constexpr bool is_edge(Feature feature) {
  return feature >= Feature::edge_ab && feature <= Feature::edge_ca;
}
[[nodiscard]] constexpr bool is_corner(Feature feature) { return feature >= Feature::corner_a; }
/// Returns the number of an edge, or that of a corner.
[[nodiscard]] constexpr std::size_t index_of(Feature feature) {
  return static_cast<std::size_t>(feature) -
         static_cast<std::size_t>(is_corner(feature) ? Feature::corner_a : Feature::edge_ab);
}

}  // namespace surehit::detail
