#pragma once

#include <cstdint>
#include <type_traits>

#include "surehit/attributes.hpp"
#include "surehit/scalar.hpp"
#include "surehit/swept_shape.hpp"
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
/// The touched point is a + u (b - a) + v (c - a): the triangle's point that is nearest to the shape at the exact t. A
/// box may contain several points of it, and several may be as near to a capsule. Then it is the one that is nearest to
/// the shape's centre. On a triangle without area, the weights are those of its two extreme corners, and the third
/// corner has weight 0. If it is a point, the first corner is touched.
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

/// Returns the touched point of a triangle, a + u (b - a) + v (c - a).
///
/// u and v are rounded once, and each of them adds at most half an ulp of 1 times its edge. The sum adds at most 4 ulp
/// of the largest coordinate of the triangle. The corners must be finite. Allocates nothing.
template <FloatOrDouble Scalar>
[[nodiscard]] SUREHIT_API Vector3<Scalar> contact_point(const Triangle<Scalar>& triangle,
                                                        const ShapeHit<Scalar>& hit) noexcept;

/// Returns the unit normal of the contact of a moving shape with a triangle. It leads from the triangle toward the
/// shape at the exact t.
///
/// - For a ball, it leads from the touched point to the centre.
/// - For a capsule, it leads from the touched point to the nearest point of the core.
/// - For a box, it is across the plane that separates the two at t. Where several planes do, those along its faces come
///   first, and then that of the triangle. If they touch at the start, the shortest way out of the triangle leads along
///   it.
///
/// Where the centre or the core is on the triangle, it is the triangle's normal, or its opposite if the shape moves
/// along the normal. It is zero if they do not touch, or if nothing tells a direction.
///
/// Each component is within 8 ulp(1) of the true one in double, and within 1 in float. Decides the pair again,
/// which takes up to some ten microseconds. Allocates nothing. Uses as much stack as a query of a moving shape.
template <FloatOrDouble Scalar>
[[nodiscard]] SUREHIT_API Vector3<Scalar> contact_normal(const std::type_identity_t<SweptShape<Scalar>>& shape,
                                                         const Triangle<Scalar>& triangle) noexcept;

#define SUREHIT_EXTERN(Scalar)                                                                 \
  extern template SUREHIT_API Vector3<Scalar> contact_point(const Triangle<Scalar>&,           \
                                                            const ShapeHit<Scalar>&) noexcept; \
  extern template SUREHIT_API Vector3<Scalar> contact_normal(const SweptShape<Scalar>&,        \
                                                             const Triangle<Scalar>&) noexcept;
SUREHIT_EXTERN(float)
SUREHIT_EXTERN(double)
#undef SUREHIT_EXTERN

using ShapeHitf = ShapeHit<float>;   ///< A hit of a moving shape in float.
using ShapeHitd = ShapeHit<double>;  ///< A hit of a moving shape in double.

}  // namespace surehit
