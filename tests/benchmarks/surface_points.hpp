#pragma once

#include <functional>
#include <surehit/triangle_mesh_view.hpp>
#include <vector>

#include "support/random.hpp"

namespace surehit::benchmark {

/// Draws points of a mesh's surface, each part of it as often as its area says.
class SurfacePoints {
 public:
  using Choice = std::function<bool(const Trianglef&)>;

  /// Takes the triangles that are chosen, or all if those have no area together. The mesh outlives the points.
  SurfacePoints(const TriangleMeshViewf& mesh, const Choice& chosen);

  [[nodiscard]] Vector3d draw(test::Random& random) const;

 private:
  TriangleMeshViewf mesh_;
  std::vector<double> area_up_to_;  ///< of the chosen triangles up to each one, itself included
};

/// Draws a point of a triangle, all points alike.
[[nodiscard]] Vector3d draw_in_triangle(const Trianglef& triangle, test::Random& random);
/// Three coordinates in [0, 1).
[[nodiscard]] Vector3d draw_in_unit_cube(test::Random& random);
/// In the ball of radius 1 around the origin.
[[nodiscard]] Vector3d draw_in_unit_ball(test::Random& random);
/// Returns a vector of length 1. All directions are alike.
[[nodiscard]] Vector3d draw_direction(test::Random& random);

}  // namespace surehit::benchmark
