#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "surehit/invalid_mesh.hpp"
#include "surehit/triangle.hpp"
#include "surehit/triangle_index_view.hpp"
#include "surehit/vertex_view.hpp"

namespace surehit {

/// The id that no triangle has. In batch output it means a miss. In options it means that no triangle is ignored.
inline constexpr std::uint32_t no_triangle = std::numeric_limits<std::uint32_t>::max();

/// A view of a triangle mesh in memory that the user owns. It copies nothing, and must not outlive its arrays.
///
/// `TriangleMeshViewf(points, triangles)` takes containers, spans, arrays and Eigen matrices. `VertexView` and
/// `TriangleIndexView` say which. The id of a triangle is its index in the mesh, from 0 on.
///
/// A view is not checked when it is made. `find_invalid` checks it, and so does every build.
template <FloatOrDouble Scalar>
class TriangleMeshView {
 public:
  /// Makes a view of no vertices and no triangles.
  TriangleMeshView() = default;
  /// Makes a view of triangles whose indices refer to these vertices.
  TriangleMeshView(const VertexView<Scalar>& vertices, const TriangleIndexView& triangles) noexcept
      : vertices_(vertices), triangles_(triangles) {}

  /// Returns the view of the vertices.
  [[nodiscard]] const VertexView<Scalar>& vertices() const { return vertices_; }
  /// Returns the view of the triangles' indices.
  [[nodiscard]] const TriangleIndexView& triangles() const { return triangles_; }
  /// Returns the number of vertices, used or not.
  [[nodiscard]] std::size_t vertex_count() const { return vertices_.size(); }
  /// Returns the number of triangles.
  [[nodiscard]] std::size_t triangle_count() const { return triangles_.size(); }

  /// Returns a vertex. `index` must be below `vertex_count()`.
  [[nodiscard]] Vector3<Scalar> vertex(std::size_t index) const { return vertices_[index]; }
  /// Returns the index of the vertex at a corner. `which` is 0, 1 or 2 for a, b or c. `triangle` must be below
  /// `triangle_count()`.
  [[nodiscard]] std::uint32_t corner(std::size_t triangle, std::size_t which) const {
    return triangles_.corner(triangle, which);
  }
  /// Returns the corners of a triangle. `index` must be below `triangle_count()`, and the triangle's indices must be in
  /// range.
  [[nodiscard]] Triangle<Scalar> triangle(std::size_t index) const {
    return {vertex(corner(index, 0)), vertex(corner(index, 1)), vertex(corner(index, 2))};
  }

 private:
  VertexView<Scalar> vertices_;
  TriangleIndexView triangles_;
};

/// Returns what makes the mesh invalid, or nothing if the mesh is valid. A build refuses an invalid mesh.
///
/// It returns the first problem in this order:
/// 1. An array is null, is not whole triples, or has a stride that is too small.
/// 2. There are more than 2^32 - 2 triangles.
/// 3. A triangle has an index that is out of range.
/// 4. A vertex, used or not, has a NaN or an infinity.
///
/// A valid mesh may have degenerate triangles, equal triangles, holes and unused vertices. Takes linear time. Allocates
/// only the message of an error, and may throw std::bad_alloc then.
template <FloatOrDouble Scalar>
[[nodiscard]] SUREHIT_API std::optional<InvalidMesh> find_invalid(const TriangleMeshView<Scalar>& mesh);

extern template SUREHIT_API std::optional<InvalidMesh> find_invalid(const TriangleMeshView<float>&);
extern template SUREHIT_API std::optional<InvalidMesh> find_invalid(const TriangleMeshView<double>&);

using TriangleMeshViewf = TriangleMeshView<float>;   ///< A mesh in float.
using TriangleMeshViewd = TriangleMeshView<double>;  ///< A mesh in double.

}  // namespace surehit
