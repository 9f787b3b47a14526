#pragma once

#include <cstddef>

#include "surehit/path.hpp"
#include "surehit/pose.hpp"
#include "surehit/triangle.hpp"

namespace surehit::detail {

/// Where an instance is, in the numbers that were given. A corner v of its mesh is at linear v + translation + t
/// motion.
template <typename Scalar>
struct Placement {
  Pose<Scalar> pose;                                 ///< The pose at t = 0.
  Vector3<Scalar> motion = Vector3<Scalar>::Zero();  ///< The motion from t = 0 to t = 1.
  bool moves = false;                                ///< True if the motion is not zero.
};

/// A triangle of an instance: the exact image of a triangle of its mesh.
template <typename Scalar>
struct PlacedTriangle {
  Triangle<Scalar> local;              ///< The triangle of the mesh.
  const Placement<Scalar>& placement;  ///< Where the instance is.
  /// The share of the motion that a segment or a shape sees. It is below 1 for a part of a step.
  Scalar share = 1;
};

}  // namespace surehit::detail
