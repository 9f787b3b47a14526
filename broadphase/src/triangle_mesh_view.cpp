#include "surehit/triangle_mesh_view.hpp"

#include <cmath>

namespace surehit {

template <typename Scalar>
std::optional<InvalidMesh> find_invalid(const TriangleMeshView<Scalar>& mesh) {
  using Reason = InvalidMesh::Reason;
  if (mesh.triangle_count() >= no_triangle) {
    return InvalidMesh(Reason::too_many_triangles, mesh.triangle_count(),
                       "mesh has " + std::to_string(mesh.triangle_count()) + " triangles, more than the " +
                           std::to_string(no_triangle - 1) + " that 32-bit ids allow");
  }
  for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      if (mesh.corner(i, corner) >= mesh.vertex_count()) {
        return InvalidMesh(Reason::index_out_of_range, i,
                           "triangle " + std::to_string(i) + ": corner " + "abc"[corner] + " is vertex " +
                               std::to_string(mesh.corner(i, corner)) + ", but the mesh has " +
                               std::to_string(mesh.vertex_count()) + " vertices");
      }
    }
  }
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
    const Vector3<Scalar> vertex = mesh.vertex(i);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      if (!std::isfinite(vertex[axis])) {
        return InvalidMesh(Reason::non_finite_vertex, i,
                           "vertex " + std::to_string(i) + ": " + "xyz"[axis] + " is " + std::to_string(vertex[axis]));
      }
    }
  }
  return std::nullopt;
}

template std::optional<InvalidMesh> find_invalid(const TriangleMeshView<float>&);
template std::optional<InvalidMesh> find_invalid(const TriangleMeshView<double>&);

}  // namespace surehit
