#pragma once

#include <cstdint>
#include <type_traits>

#include "surehit/attributes.hpp"
#include "surehit/path.hpp"
#include "surehit/triangle.hpp"
#include "surehit/triangle_mesh_view.hpp"

namespace surehit {

/// The side of a triangle at which a path arrives. The triangle's normal is (b - a) × (c - a).
enum class Side : std::uint8_t {
  edge_on,  ///< The path is in the triangle's plane, or has length zero, or the triangle is degenerate.
  front,    ///< The path arrives from the side to which the normal points.
  back,     ///< The path arrives from the other side.
};

/// Where a path first meets a triangle. t, u and v are the exact values, each rounded once to nearest, ties to even.
///
/// The exact contact is start + t (end - start), or origin + t direction. It is also a + u (b - a) + v (c - a). Where a
/// path and a triangle share more than a point, it is the first shared point within the limits of t. On a degenerate
/// triangle, the weights are those of its two extreme corners, and the third corner has weight 0.
///
/// It is not promised that the rounded numbers give a point on the triangle, or that u + v is at most 1. A rounded t
/// may be below the exact one, so `max_t = hit.t` may lose this hit. `Collider::max_t_keeping` returns the limit that
/// keeps it. A default hit is a miss, and its other members mean nothing.
template <FloatOrDouble Scalar>
struct Hit {
  /// The lowest parameter at which the path meets the triangle. It is in [0, 1] on a segment, in [0, inf] on a ray, and
  /// any number on a line. It is infinite if the exact t is too large for a finite Scalar. Zero is +0.
  Scalar t = 0;
  Scalar u = 0;                          ///< The weight of corner b, in [0, 1]. Zero is +0.
  Scalar v = 0;                          ///< The weight of corner c, in [0, 1]. Zero is +0.
  std::uint32_t triangle = no_triangle;  ///< The triangle's id: its index in the mesh. `no_triangle` means a miss.
  Side side = Side::edge_on;             ///< The side at which the path arrives.

  /// Returns true if all members are equal.
  friend bool operator==(const Hit&, const Hit&) = default;
};

/// Returns the path's point at hit.t: start + t (end - start), or origin + t direction. It is computed exactly for the
/// rounded t. Then each coordinate is rounded once to nearest, so it is within half an ulp.
///
/// It is not promised that the point is on the triangle. In general it is not, because t is rounded. This moves the
/// point by up to ulp(t)/2 of the length of end - start or of the direction. `Collider::last_free_point` returns a
/// point in front of the triangle.
///
/// If the path or hit.t is not finite, all coordinates are NaN. Allocates nothing.
template <FloatOrDouble Scalar>
[[nodiscard]] SUREHIT_API Vector3<Scalar> point(const std::type_identity_t<Path<Scalar>>& path,
                                                const Hit<Scalar>& hit) noexcept;

/// Returns the distance between the path's start or origin and its point at hit.t, in the mesh's unit of length. It is
/// `|t| |end - start|` or `|t| |direction|`, for the rounded t. The error is at most one ulp.
///
/// It is infinite if it is too large for a finite Scalar. If t, the direction, or an end of a segment is not finite, it
/// is NaN or infinity. The origin of a ray or a line does not count. Allocates nothing.
template <FloatOrDouble Scalar>
[[nodiscard]] SUREHIT_API Scalar distance(const std::type_identity_t<Path<Scalar>>& path,
                                          const Hit<Scalar>& hit) noexcept;

/// Returns the unit vector along (b - a) × (c - a). Returns zero for a degenerate triangle. The corners must be finite.
///
/// The cross product is exact before it is scaled. So each component is within 2 ulp(1) of the true one, for triangles
/// of any shape. The length of the result is not exactly 1 in general. Allocates nothing.
template <FloatOrDouble Scalar>
[[nodiscard]] SUREHIT_API Vector3<Scalar> normal(const Triangle<Scalar>& triangle) noexcept;

/// Returns the same for a triangle of a mesh. The mesh must be valid, and `triangle` must be below its
/// `triangle_count()`.
template <FloatOrDouble Scalar>
[[nodiscard]] Vector3<Scalar> normal(const TriangleMeshView<Scalar>& mesh, std::uint32_t triangle) noexcept {
  return normal(mesh.triangle(triangle));
}

#define SUREHIT_EXTERN(Scalar)                                                                         \
  extern template SUREHIT_API Vector3<Scalar> point(const Path<Scalar>&, const Hit<Scalar>&) noexcept; \
  extern template SUREHIT_API Scalar distance(const Path<Scalar>&, const Hit<Scalar>&) noexcept;       \
  extern template SUREHIT_API Vector3<Scalar> normal(const Triangle<Scalar>&) noexcept;
SUREHIT_EXTERN(float)
SUREHIT_EXTERN(double)
#undef SUREHIT_EXTERN

using Hitf = Hit<float>;   ///< A hit in float.
using Hitd = Hit<double>;  ///< A hit in double.

}  // namespace surehit
