#include "surehit/triangle_mesh_view.hpp"

#include <cmath>

namespace surehit {

namespace {

/// Returns what is wrong with the arrays of a mesh, or nothing. It reads no element.
template <typename Scalar>
std::optional<InvalidMesh> find_invalid_array(const TriangleMeshView<Scalar>& mesh) {
  using Reason = InvalidMesh::Reason;
  const detail::TripleArray& vertices = detail::ViewMemory::of(mesh.vertices());
  const detail::TripleArray& triangles = detail::ViewMemory::of(mesh.triangles());
  if (vertices.first == nullptr && vertices.count != 0) {
    return InvalidMesh(Reason::missing_array, vertices.count,
                       "the array of " + std::to_string(vertices.count) + " vertices is null");
  }
  if (triangles.first == nullptr && triangles.count != 0) {
    return InvalidMesh(Reason::missing_array, triangles.count,
                       "the array of " + std::to_string(triangles.count) + " triangles is null");
  }
  if (vertices.left_over != 0) {
    return InvalidMesh(Reason::incomplete_vertex, vertices.count,
                       "vertex " + std::to_string(vertices.count) + " has " + std::to_string(vertices.left_over) +
                           " of 3 coordinates");
  }
  if (triangles.left_over != 0) {
    return InvalidMesh(Reason::incomplete_triangle, triangles.count,
                       "triangle " + std::to_string(triangles.count) + " has " + std::to_string(triangles.left_over) +
                           " of 3 indices");
  }
  if (vertices.stride < 3 * sizeof(Scalar)) {
    return InvalidMesh(Reason::vertex_stride_too_small, vertices.stride,
                       "vertices of " + std::to_string(3 * sizeof(Scalar)) + " bytes lie " +
                           std::to_string(vertices.stride) + " bytes apart");
  }
  const std::size_t triangle_size = 3 * mesh.triangles().index_size();
  if (triangles.stride < triangle_size) {
    return InvalidMesh(Reason::triangle_stride_too_small, triangles.stride,
                       "triangles of " + std::to_string(triangle_size) + " bytes lie " +
                           std::to_string(triangles.stride) + " bytes apart");
  }
  return std::nullopt;
}

}  // namespace

template <FloatOrDouble Scalar>
std::optional<InvalidMesh> find_invalid(const TriangleMeshView<Scalar>& mesh) {
  using Reason = InvalidMesh::Reason;
  if (std::optional<InvalidMesh> invalid = find_invalid_array(mesh)) return invalid;
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

template SUREHIT_API std::optional<InvalidMesh> find_invalid(const TriangleMeshView<float>&);
template SUREHIT_API std::optional<InvalidMesh> find_invalid(const TriangleMeshView<double>&);

}  // namespace surehit
