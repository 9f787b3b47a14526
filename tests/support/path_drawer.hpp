#pragma once

#include <cstdint>

#include "support/random.hpp"
#include "surehit/box.hpp"
#include "surehit/path.hpp"
#include "surehit/triangle_mesh_view.hpp"

namespace surehit::test {

/// Draws paths that pass a mesh where it is hard for a grid. All are finite, however large the mesh is.
template <typename Scalar>
class PathDrawer {
 public:
  /// The mesh has a triangle at least, and outlives the drawer.
  PathDrawer(const TriangleMeshView<Scalar>& mesh, std::uint64_t seed);

  /// A vertex, a point of an edge or a point inside a triangle, as near to it as a Scalar comes.
  [[nodiscard]] Vector3<Scalar> point_on_mesh();
  /// In the mesh's box or up to a quarter of it outside.
  [[nodiscard]] Vector3<Scalar> point_around_mesh();
  /// Any of the kinds, along the segment: a segment, or the ray or line from its start towards its end.
  [[nodiscard]] Path<Scalar> any_kind(const Segment<Scalar>& segment);

  /// Through or past the mesh, from around it: aimed at it or not, ending on it or not, of any length down to zero.
  [[nodiscard]] Path<Scalar> draw();
  /// From `distance` away, towards the mesh and as far behind it.
  [[nodiscard]] Path<Scalar> draw_from_afar(Scalar distance);
  /// Through a point on the mesh or near it, with one or two components of the direction zero.
  [[nodiscard]] Path<Scalar> draw_axis_parallel();

  [[nodiscard]] Random& random() { return random_; }

 private:
  TriangleMeshView<Scalar> mesh_;
  Box<Scalar> box_;
  Random random_;
};

/// Exactly through the origin, with its ends at different distances of up to 2^exponent on either side of it: a far
/// path that is sure to pass where it is meant to.
template <typename Scalar>
[[nodiscard]] Segment<Scalar> far_through_origin(int exponent, Random& random);

}  // namespace surehit::test
