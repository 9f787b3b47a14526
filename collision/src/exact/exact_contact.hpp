#pragma once

#include <compare>
#include <optional>

#include "contact.hpp"
#include "path_range.hpp"
#include "placement.hpp"
#include "surehit/hit.hpp"
#include "surehit/path.hpp"
#include "surehit/triangle.hpp"

namespace surehit::detail {

/// Returns the first contact of the path with the triangle in the range, by exact integer arithmetic. Returns nothing
/// if there is none. Any finite input is allowed: degenerate triangles, paths in the triangle's plane, paths of length
/// zero. The range must not be empty. Here and below, `AnyTriangle` is `Triangle` or `PlacedTriangle`.
template <typename Scalar, typename AnyTriangle>
[[nodiscard]] std::optional<Contact> exact_contact(const Path<Scalar>& path, const AnyTriangle& triangle,
                                                   const PathRange<Scalar>& range);

/// Does the same if compact integers hold the coordinates, which takes a small part of the time. Returns false if they
/// do not. Then `contact` has no meaning.
template <typename Scalar, typename AnyTriangle>
[[nodiscard]] bool try_compact_contact(const Path<Scalar>& path, const AnyTriangle& triangle,
                                       const PathRange<Scalar>& range, std::optional<Contact>& contact);

/// Sets t, u and v of a hit that is known to exist. Each is rounded once, to nearest. `hit.triangle` and `hit.side`
/// keep their values.
template <typename Scalar, typename AnyTriangle>
void exact_rounding(const Path<Scalar>& path, const AnyTriangle& triangle, const PathRange<Scalar>& range,
                    Hit<Scalar>& hit);

/// Compares the exact t of two triangles. Returns `less` if the path meets `triangle` before `other`. The path must
/// meet both of them.
template <typename Scalar, typename AnyTriangle>
[[nodiscard]] std::strong_ordering exact_order(const Path<Scalar>& path, const AnyTriangle& triangle,
                                               const AnyTriangle& other, const PathRange<Scalar>& range);

/// Returns the point of the path at t, rounded once to nearest. For a segment it is start + t (toward - start). For a
/// ray or a line it is start + t toward.
template <typename Scalar>
[[nodiscard]] Vector3<Scalar> exact_point(const Path<Scalar>& path, Scalar t);

/// Returns (b - a) × (c - a) times a power of two. That power brings the largest component into [1/2, 1). Each
/// component is rounded once. The result is zero only if the exact cross product is zero.
template <typename AnyTriangle>
[[nodiscard]] Vector3<double> exact_cross(const AnyTriangle& triangle);

/// Returns the corners of a placed triangle at t = 0. Each coordinate is rounded once to nearest.
template <typename Scalar>
[[nodiscard]] Triangle<Scalar> exact_corners(const PlacedTriangle<Scalar>& triangle);

}  // namespace surehit::detail
