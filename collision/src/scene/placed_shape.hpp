#pragma once

#include <array>
#include <cstddef>

#include "placement.hpp"
#include "scene/instance_frame.hpp"
#include "surehit/swept_box.hpp"
#include "surehit/swept_capsule.hpp"
#include "surehit/swept_sphere.hpp"
#include "walk/swept_walk.hpp"

namespace surehit::detail {

/// A moving shape as an instance sees it, in double. It is larger than the exact shape, so that it touches all that
/// this does. POSES.md derives by how much.
class PlacedShape {
 public:
  /// The shape must be valid. `share` is that of the motion which the shape sees.
  template <typename Shape, typename Scalar>
  PlacedShape(const Shape& shape, const Placement<Scalar>& placement, const InstanceFrame& frame, Scalar share = 1);

  /// Returns false if the errors are not known. Then each triangle must be decided exactly.
  [[nodiscard]] bool is_usable() const { return is_usable_; }
  /// Returns a box around the shape, in the frame of the mesh (I13).
  [[nodiscard]] const SweptExtents& in_mesh() const { return in_mesh_; }

  /// Returns the shape in the scene, with the placed anchor as the origin (I12).
  template <typename Scalar>
  [[nodiscard]] SweptSphere<double> near_anchor(const SweptSphere<Scalar>& sphere) const;
  template <typename Scalar>
  [[nodiscard]] SweptBox<double> near_anchor(const SweptBox<Scalar>& box) const;
  template <typename Scalar>
  [[nodiscard]] SweptCapsule<double> near_anchor(const SweptCapsule<Scalar>& capsule) const;

  /// Sets coordinate k of corner i of a triangle to `out[(3 i + k) stride + n]`, for each n in [0, count). These are
  /// the corners in the scene, less the placed anchor. Coordinate j of the triangles' corners is at `corners[j
  /// list_count]` and behind it.
  template <typename MeshScalar>
  void place(const MeshScalar* corners, std::size_t list_count, std::size_t count, std::size_t stride,
             double* out) const;

 private:
  bool is_usable_;
  SweptExtents in_mesh_ = {};
  Vector3<double> start_ = Vector3<double>::Zero();  ///< The centre at t = 0, less the placed anchor.
  Vector3<double> end_ = Vector3<double>::Zero();    ///< The centre at t = 1, as the instance sees it.
  double slack_ = 0;                                 ///< More than what centre and corners are off together.
  std::array<Doubles, 3> rows_ = {};                 ///< The pose's matrix.
  Doubles anchor_ = {};                              ///< The anchor in the mesh.
};

}  // namespace surehit::detail
