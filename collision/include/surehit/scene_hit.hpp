#pragma once

#include "surehit/hit.hpp"
#include "surehit/hit_filter.hpp"
#include "surehit/instance.hpp"

namespace surehit {

/// Where a path first meets a triangle of a scene. t, u, v, the triangle and the side are as in `Hit`, for the exact
/// image of the triangle. So the side is that of the placed triangle, also where the pose mirrors it.
template <FloatOrDouble Scalar>
struct SceneHit : Hit<Scalar> {
  InstanceId instance = {};  ///< The instance that has the triangle. A miss has a default id.

  /// Returns true if all members are equal.
  friend bool operator==(const SceneHit&, const SceneHit&) = default;
};

using SceneHitf = SceneHit<float>;   ///< A hit in a scene in float.
using SceneHitd = SceneHit<double>;  ///< A hit in a scene in double.

/// Decides which hits of a scene count, see `HitFilter`.
template <FloatOrDouble Scalar>
using SceneHitFilter = HitFilter<Scalar, SceneHit<Scalar>>;

}  // namespace surehit
