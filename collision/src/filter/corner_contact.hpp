#pragma once

#include "contact.hpp"
#include "path_range.hpp"
#include "surehit/path.hpp"
#include "surehit/triangle.hpp"
#include "verdict.hpp"

namespace surehit::detail {

/// What is known of a path that begins or ends at a corner of a triangle.
template <typename Scalar>
struct CornerContact {
  Verdict verdict = Verdict::undecided;  ///< The other members have a meaning only for a hit.
  Contact contact = {};                  ///< The contact. Both bounds of t are the exact t.
  Scalar u = 0;                          ///< The exact weight of corner b.
  Scalar v = 0;                          ///< The exact weight of corner c.
};

/// The second stage for a path that begins or ends at a corner of the triangle, as paths between vertices of a mesh do.
/// It compares coordinates, and needs no more than the sign of one determinant in double. It is undecided about all
/// other pairs, and about a triangle that is a segment or a point.
template <typename Scalar>
[[nodiscard]] CornerContact<Scalar> corner_contact(const Path<Scalar>& path, const Triangle<Scalar>& triangle,
                                                   const PathRange<Scalar>& range);

}  // namespace surehit::detail
