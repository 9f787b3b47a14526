#pragma once

#include "surehit/path.hpp"
#include "surehit/scalar.hpp"

namespace surehit {

/// A ball whose centre moves in a straight line during one physics step: all points within `radius` of start + t (end -
/// start), for t in [0, 1].
///
/// It touches a triangle if their distance is zero, so a contact in a single point counts. Any finite coordinates and
/// any finite radius are allowed. With radius 0 it is a point that moves, and meets what a `Segment` meets. With a
/// negative radius, a NaN or an infinity, it touches nothing.
template <FloatOrDouble Scalar>
struct SweptSphere {
  Vector3<Scalar> start;  ///< The centre at t = 0.
  Vector3<Scalar> end;    ///< The centre at t = 1. It may be the start. Then the ball rests there.
  Scalar radius;          ///< The radius, in the mesh's unit of length.
};

using SweptSpheref = SweptSphere<float>;   ///< A moving ball in float.
using SweptSphered = SweptSphere<double>;  ///< A moving ball in double.

}  // namespace surehit
