#pragma once

#include "surehit/path.hpp"

namespace surehit {

/// The closed convex hull of three corners: a triangle with its edges and corners. Corners may coincide or lie on a
/// line.
template <FloatOrDouble Scalar>
struct Triangle {
  Vector3<Scalar> a;
  Vector3<Scalar> b;
  Vector3<Scalar> c;
};

using Trianglef = Triangle<float>;
using Triangled = Triangle<double>;

}  // namespace surehit
