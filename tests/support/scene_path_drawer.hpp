#pragma once

#include <cstddef>
#include <vector>

#include "support/random.hpp"
#include "support/scene_drawer.hpp"
#include "support/scene_oracle.hpp"
#include "surehit/instance.hpp"
#include "surehit/path.hpp"
#include "surehit/scene_hit.hpp"
#include "surehit/scene_query_options.hpp"

namespace surehit::test {

/// Draws paths that are hard for a scene. All are finite.
template <typename Scalar>
class ScenePathDrawer {
 public:
  /// Each drawn instance has an id in the oracle. All arguments must outlive the drawer.
  ScenePathDrawer(const DrawnScene<Scalar>& drawn, const SceneOracle<Scalar>& oracle,
                  const std::vector<InstanceId>& ids, Random& random)
      : drawn_(drawn), oracle_(oracle), ids_(ids), random_(random) {}

  /// Returns a path that aims at placed corners, edges or triangles, or lies in the plane of one. Or it is a hard path
  /// of the mesh, placed as the mesh is.
  [[nodiscard]] Path<Scalar> draw();

 private:
  using Point = Vector3<Scalar>;
  /// A placed triangle, and the instance that has it.
  struct Target {
    Triangle<Scalar> triangle;
    Point motion;
    Scalar size;  ///< The largest of its sides, on one axis.
  };

  [[nodiscard]] std::size_t any_instance();
  [[nodiscard]] Target any_target();
  [[nodiscard]] Point point_on(const Triangle<Scalar>& triangle);
  [[nodiscard]] Point point_in_plane_of(const Triangle<Scalar>& triangle);
  [[nodiscard]] Point point_around(const Target& target);
  [[nodiscard]] Path<Scalar> any_kind(const Segment<Scalar>& segment);
  [[nodiscard]] Segment<Scalar> draw_segment(const Target& target);
  [[nodiscard]] Path<Scalar> path_of_mesh();
  /// It may have numbers that are not finite.
  [[nodiscard]] Path<Scalar> any_path();

  const DrawnScene<Scalar>& drawn_;
  const SceneOracle<Scalar>& oracle_;
  const std::vector<InstanceId>& ids_;
  Random& random_;
};

/// Returns options that are hard for a scene and a hit of it. Limits are at the hit's t or beside it.
template <typename Scalar>
[[nodiscard]] SceneQueryOptions<Scalar> draw_scene_options(const SceneHit<Scalar>& hit, Random& random);

}  // namespace surehit::test
