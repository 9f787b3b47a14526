#pragma once

#include <cstdint>
#include <type_traits>

#include "surehit/attributes.hpp"
#include "surehit/scalar.hpp"
#include "surehit/triangle.hpp"
#include "surehit/triangle_mesh_view.hpp"

namespace surehit {

/// A part of a triangle.
enum class Feature : std::uint8_t {
  face,      ///< The inside of the triangle.
  edge_ab,   ///< The inside of the edge from a to b.
  edge_bc,   ///< The inside of the edge from b to c.
  edge_ca,   ///< The inside of the edge from c to a.
  corner_a,  ///< Corner a.
  corner_b,  ///< Corner b.
  corner_c,  ///< Corner c.
};

/// Where a moving shape first touches a triangle. t, u and v are the exact values, each rounded once to nearest, ties
/// to even.
///
/// The touched point is a + u (b - a) + v (c - a): the triangle's point that is nearest to the shape at the exact t. On
/// a triangle without area, the weights are those of its two extreme corners, and the third corner has weight 0. If it
/// is a point, the first corner is touched.
///
/// It is not promised that the shape at the rounded t touches the triangle, or that it does not reach into it. A
/// default hit is a miss, and its other members mean nothing.
template <FloatOrDouble Scalar>
struct ShapeHit {
  Scalar t = 0;                          ///< The lowest parameter at which they touch, in [0, 1]. Zero is +0.
  Scalar u = 0;                          ///< The weight of corner b, in [0, 1]. Zero is +0.
  Scalar v = 0;                          ///< The weight of corner c, in [0, 1]. Zero is +0.
  std::uint32_t triangle = no_triangle;  ///< The triangle's id: its index in the mesh. `no_triangle` means a miss.
  Feature feature = Feature::face;       ///< The part of the triangle that has the touched point.
  bool started_touching = false;         ///< True if they touch at t = 0 already.

  /// Returns true if all members are equal.
  friend bool operator==(const ShapeHit&, const ShapeHit&) = default;
};

using ShapeHitf = ShapeHit<float>;   ///< A hit of a moving shape in float.
using ShapeHitd = ShapeHit<double>;  ///< A hit of a moving shape in double.

}  // namespace surehit
