#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <type_traits>

#include "support/double4.hpp"
#include "support/float4.hpp"
#include "support/inlining.hpp"
#include "surehit/triangle_mesh_view.hpp"

namespace surehit::detail {

/// Loads the vertices of a mesh as vectors. Most vertices are loaded together with the number that follows them in
/// memory. So the fourth lane holds some finite number of the mesh. The mesh must outlive this.
template <typename Scalar>
class VertexLanes {
 public:
  using Point = std::conditional_t<std::is_same_v<Scalar, float>, Float4, Double4>;

  explicit VertexLanes(const TriangleMeshView<Scalar>& mesh)
      : mesh_(mesh), vertices_(ViewMemory::of(mesh.vertices()).first) {
    const bool are_dense = mesh.vertices().stride_bytes() == 3 * sizeof(Scalar);
    followed_ = are_dense && mesh.vertex_count() > 0 ? mesh.vertex_count() - 1 : 0;
  }

  /// Loads a vertex.
  SUREHIT_ALWAYS_INLINE void load(std::size_t vertex, Point& point) const {
    if (vertex < followed_) {
      load_whole(vertex, point);
    } else {
      gather(vertex, point);
    }
  }
  /// Loads the corners a, b and c of a triangle.
  SUREHIT_ALWAYS_INLINE void load_corners(std::size_t triangle, Point (&corners)[3]) const {
    const std::size_t vertices[3] = {mesh_.corner(triangle, 0), mesh_.corner(triangle, 1), mesh_.corner(triangle, 2)};
    if (std::max({vertices[0], vertices[1], vertices[2]}) < followed_) {
      for (std::size_t i = 0; i < 3; ++i) load_whole(vertices[i], corners[i]);
    } else {
      for (std::size_t i = 0; i < 3; ++i) gather(vertices[i], corners[i]);
    }
  }

 private:
  SUREHIT_ALWAYS_INLINE void load_whole(std::size_t vertex, Point& point) const {
    std::memcpy(&point, vertices_ + vertex * (3 * sizeof(Scalar)), sizeof point);
  }
  void gather(std::size_t index, Point& point) const {
    const Vector3<Scalar> vertex = mesh_.vertex(index);
    point = Point{vertex[0], vertex[1], vertex[2], vertex[2]};
  }

  const TriangleMeshView<Scalar>& mesh_;
  const std::byte* vertices_;
  std::size_t followed_;  ///< The number of vertices that are followed by another one. Its x is their fourth number.
};

}  // namespace surehit::detail
