#pragma once

#include <cstddef>

#include "surehit/shape_hit.hpp"

namespace surehit::detail {

/// Says which types belong to a moving shape. `Scalar` is that of its numbers. `Contact` holds a contact of the shape
/// with a triangle, and has at least these members: `t_lower` and `t_upper`, doubles between which the exact t is, and
/// `at_start`, which is true if they touch at t = 0. `Findings` is what doubles find out where they do not decide.
/// Integers then need not ask about it again.
template <typename Shape>
struct ShapeTypes;
template <typename Shape>
using ScalarOf = typename ShapeTypes<Shape>::Scalar;
template <typename Shape>
using ContactOf = typename ShapeTypes<Shape>::Contact;
template <typename Shape>
using FindingsOf = typename ShapeTypes<Shape>::Findings;

/// The number of parts of a triangle that `Feature` names.
inline constexpr std::size_t feature_count = static_cast<std::size_t>(Feature::corner_c) + 1;

/// The findings about a shape of which integers ask everything again.
struct NoFindings {};

/// True if most contacts of a shape with a triangle can be decided at little cost.
template <typename Shape>
inline constexpr bool has_simple_contacts = false;

/// Returns true if the t of a contact follows from a corner or an edge of the triangle. Where it is in the mesh, it
/// then is the same for all triangles that share this part, wherever the mesh is placed.
template <typename Contact>
[[nodiscard]] constexpr bool is_timed_by_shared_part(const Contact&) {
  return true;
}

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
