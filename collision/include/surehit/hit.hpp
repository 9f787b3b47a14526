#pragma once

#include <cstdint>
#include <type_traits>

#include "surehit/attributes.hpp"
#include "surehit/path.hpp"
#include "surehit/triangle.hpp"
#include "surehit/triangle_mesh_view.hpp"

namespace surehit {

/// From where a path arrives, by the triangle's normal (b - a) × (c - a).
enum class Side : std::uint8_t {
  edge_on,  ///< in the triangle's plane; also every contact of a zero-length path or of a degenerate triangle
  front,    ///< from the side that the normal points to
  back,     ///< from the other side
};

/// Where a path first meets a triangle. t, u and v are each the exact value rounded once, to nearest, ties to even.
///
/// A rounded t may lie below the exact one, so that `max_t = hit.t` may lose this very hit: `Collider::max_t_keeping`
/// gives the limit that keeps it. u + v may exceed 1 by rounding. A t that no finite Scalar holds is infinite, and a
/// hit all the same. Zero is +0.
template <FloatOrDouble Scalar>
struct Hit {
  Scalar t = 0;                          ///< parameter of the path
  Scalar u = 0;                          ///< weight of corner b: the point is a + u (b - a) + v (c - a)
  Scalar v = 0;                          ///< weight of corner c
  std::uint32_t triangle = no_triangle;  ///< id in the mesh; `no_triangle` is a miss in batch output
  Side side = Side::edge_on;             ///< from where the path arrives

  friend bool operator==(const Hit&, const Hit&) = default;
};

/// The point of the path at hit.t: start + t (end - start), or origin + t direction, for the rounded t, evaluated
/// exactly and rounded once. It is within half an ulp of the path at hit.t. Since t itself is rounded, it is off the
/// exact contact by up to ulp(t)/2 of the path's length besides, so in general it is not on the triangle. Non-finite
/// input gives NaN.
template <FloatOrDouble Scalar>
[[nodiscard]] SUREHIT_API Vector3<Scalar> point(const std::type_identity_t<Path<Scalar>>& path,
                                                const Hit<Scalar>& hit) noexcept;

/// How far the path's start or origin is from its point at hit.t: |t| |end - start|, or |t| |direction|, in the mesh's
/// unit of length, for the rounded t. It is within one ulp, and infinite where no finite Scalar holds it. Non-finite
/// input gives NaN or infinity.
template <FloatOrDouble Scalar>
[[nodiscard]] SUREHIT_API Scalar distance(const std::type_identity_t<Path<Scalar>>& path,
                                          const Hit<Scalar>& hit) noexcept;

/// The unit vector along (b - a) × (c - a). The cross product is exact before it is scaled, so that each component is
/// within 2 ulp(1) of the true one however thin the triangle is. Zero for a degenerate triangle.
template <FloatOrDouble Scalar>
[[nodiscard]] SUREHIT_API Vector3<Scalar> normal(const Triangle<Scalar>& triangle) noexcept;

/// The same for a triangle of a mesh. The mesh must be valid, and have the triangle.
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

using Hitf = Hit<float>;
using Hitd = Hit<double>;

}  // namespace surehit
