#pragma once

#include "surehit/path.hpp"

namespace surehit {

/// A triangle with its edges and corners: the convex hull of a, b and c, in the mesh's unit of length.
///
/// The corners may coincide or lie on a line. Such a degenerate triangle is the segment or the point that they span.
/// Any finite coordinates are allowed.
template <FloatOrDouble Scalar>
struct Triangle {
  Vector3<Scalar> a;  ///< The corner at which u = v = 0.
  Vector3<Scalar> b;  ///< The corner of weight u.
  Vector3<Scalar> c;  ///< The corner of weight v.
};

using Trianglef = Triangle<float>;   ///< A triangle in float.
using Triangled = Triangle<double>;  ///< A triangle in double.

}  // namespace surehit
