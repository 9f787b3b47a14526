#pragma once

#include "surehit/hit_filter.hpp"
#include "surehit/instance.hpp"
#include "surehit/shape_hit.hpp"

namespace surehit {

/// Where a moving shape first touches a triangle of a scene. The members of `ShapeHit` are those of the exact image of
/// the triangle, in the scene.
template <FloatOrDouble Scalar>
struct SceneShapeHit : ShapeHit<Scalar> {
  InstanceId instance = {};  ///< The instance that has the triangle. A miss has a default id.

  /// Returns true if all members are equal.
  friend bool operator==(const SceneShapeHit&, const SceneShapeHit&) = default;
};

using SceneShapeHitf = SceneShapeHit<float>;   ///< A hit of a moving shape in a scene in float.
using SceneShapeHitd = SceneShapeHit<double>;  ///< A hit of a moving shape in a scene in double.

/// Decides which hits of moving shapes in a scene count, see `HitFilter`.
template <FloatOrDouble Scalar>
using SceneShapeHitFilter = HitFilter<Scalar, SceneShapeHit<Scalar>>;

}  // namespace surehit
