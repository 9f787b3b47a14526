#pragma once

#include "surehit/path.hpp"
#include "surehit/scalar.hpp"

namespace surehit {

/// A capsule whose centre c moves in a straight line during one physics step. It has all points within `radius` of its
/// core, which is the segment from c - half_axis to c + half_axis. At t, c is start + t (end - start), for t in [0, 1].
/// The capsule does not turn.
///
/// It touches a triangle if their distance is zero, so a contact in a single point counts. Any finite numbers are
/// allowed. With a half axis of zero, it is a ball, and hits what a `SweptSphere` hits, with the same bits. With radius
/// 0, it is a segment that moves. With a negative radius, a NaN or an infinity, it touches nothing.
///
/// If the core is parallel to the part of the triangle that it touches, several points of the triangle may be equally
/// near. The hit then has the one that is nearest to the capsule's centre. On a floor, this is the point below the
/// centre, or the point of the triangle's outline that is next to it.
template <FloatOrDouble Scalar>
struct SweptCapsule {
  Vector3<Scalar> start;      ///< The centre at t = 0.
  Vector3<Scalar> end;        ///< The centre at t = 1. It may be the start. Then the capsule rests there.
  Vector3<Scalar> half_axis;  ///< The way from the centre to an end of the core, in either direction.
  Scalar radius;              ///< The radius, in the mesh's unit of length.
};

using SweptCapsulef = SweptCapsule<float>;   ///< A moving capsule in float.
using SweptCapsuled = SweptCapsule<double>;  ///< A moving capsule in double.

}  // namespace surehit
