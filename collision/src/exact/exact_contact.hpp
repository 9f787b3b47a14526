#pragma once

#include <compare>
#include <optional>

#include "contact.hpp"
#include "query/path_range.hpp"
#include "surehit/hit.hpp"
#include "surehit/path.hpp"
#include "surehit/triangle.hpp"

namespace surehit::detail {

/// Where the path, cut to the range, first meets the triangle, by exact integer arithmetic: for all finite input,
/// degenerate triangles, paths in the plane and paths of no length included. The range is not empty.
template <typename Scalar>
[[nodiscard]] std::optional<Contact> exact_contact(const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                                                   const PathRange<Scalar>& range);

/// t, u and v of a contact that is known to exist, each rounded once to nearest. `triangle` and `side` are left as they
/// are.
template <typename Scalar>
void exact_rounding(const Path<Scalar>& path, const Triangle<Scalar>& triangle, const PathRange<Scalar>& range,
                    Hit<Scalar>& hit);

/// Which of two triangles, both known to be met, the path meets first.
template <typename Scalar>
[[nodiscard]] std::strong_ordering exact_order(const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                                               const Triangle<Scalar>& other, const PathRange<Scalar>& range);

/// start + t (toward - start) for a segment, start + t toward for a ray or a line, rounded once to nearest.
template <typename Scalar>
[[nodiscard]] Vector3<Scalar> exact_point(const Path<Scalar>& path, Scalar t);

/// (b - a) × (c - a) times the power of two that brings its largest component into [1/2, 1); zero if it is zero
/// exactly. Each component is rounded once.
template <typename Scalar>
[[nodiscard]] Vector3<double> exact_cross(const Triangle<Scalar>& triangle);

}  // namespace surehit::detail
