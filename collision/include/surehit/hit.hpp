#pragma once

#include <cstdint>

#include "surehit/path.hpp"
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
/// A rounded t may lie below the exact one, so that using it as the next `max_t` may lose this very hit. u + v may
/// exceed 1 by rounding. A t that no finite Scalar holds is infinite, and a hit all the same. Zero is +0.
template <typename Scalar>
struct Hit {
  Scalar t = 0;                          ///< parameter of the path
  Scalar u = 0;                          ///< weight of corner b: the point is a + u (b - a) + v (c - a)
  Scalar v = 0;                          ///< weight of corner c
  std::uint32_t triangle = no_triangle;  ///< id in the mesh; `no_triangle` is a miss in batch output
  Side side = Side::edge_on;             ///< from where the path arrives

  friend bool operator==(const Hit&, const Hit&) = default;
};

/// The point of the path at hit.t: start + t (end - start), or origin + t direction, for the rounded t, evaluated
/// exactly and rounded once. It is within half an ulp of the path at hit.t; since t itself is rounded, it is off the
/// exact contact by up to ulp(t)/2 of the path's length besides, so in general it is not on the triangle. Non-finite
/// input gives NaN.
template <typename Scalar>
[[nodiscard]] Vector3<Scalar> point(const Segment<Scalar>& segment, const Hit<Scalar>& hit) noexcept;
template <typename Scalar>
[[nodiscard]] Vector3<Scalar> point(const Ray<Scalar>& ray, const Hit<Scalar>& hit) noexcept;
template <typename Scalar>
[[nodiscard]] Vector3<Scalar> point(const Line<Scalar>& line, const Hit<Scalar>& hit) noexcept;

/// The unit vector along (b - a) × (c - a) of a triangle of the mesh. The cross product is exact before it is scaled,
/// so that each component is within 2 ulp(1) of the true one however thin the triangle is. Zero for a degenerate
/// triangle.
template <typename Scalar>
[[nodiscard]] Vector3<Scalar> normal(const TriangleMeshView<Scalar>& mesh, std::uint32_t triangle) noexcept;

using Hitf = Hit<float>;
using Hitd = Hit<double>;

}  // namespace surehit
