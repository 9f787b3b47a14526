#pragma once

#include "surehit/path.hpp"
#include "surehit/scalar.hpp"

namespace surehit {

/// An axis-parallel box whose centre moves in a straight line during one physics step. For t in [0, 1] it has all
/// points whose difference from start + t (end - start) is at most the half extents on each axis.
///
/// It touches a triangle if they share a point, so a contact in a single point counts. Any finite coordinates and half
/// extents are allowed. With half extents of zero it is a rectangle, a rod, or a point that moves. A point meets what a
/// `Segment` meets. With a negative half extent, a NaN or an infinity, the box touches nothing.
///
/// A box often touches many points of a triangle at once. The touched point of a hit is the one that is nearest to the
/// centre of the box.
template <FloatOrDouble Scalar>
struct SweptBox {
  Vector3<Scalar> start;         ///< The centre at t = 0.
  Vector3<Scalar> end;           ///< The centre at t = 1. It may be the start. Then the box rests there.
  Vector3<Scalar> half_extents;  ///< Half the size on each axis, in the mesh's unit of length.
};

using SweptBoxf = SweptBox<float>;   ///< A moving box in float.
using SweptBoxd = SweptBox<double>;  ///< A moving box in double.

}  // namespace surehit
