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

/// The id that no triangle has: a miss, or nothing to ignore.
inline constexpr std::uint32_t no_triangle = std::numeric_limits<std::uint32_t>::max();

/// A mesh in memory that somebody else owns. It copies nothing and must not outlive its arrays.
///
/// `TriangleMeshViewf(points, triangles)` takes containers, spans, arrays and Eigen matrices, as `VertexView` and
/// `TriangleIndexView` say. A view is not checked when it is made: `find_invalid` checks it, and so does every build.
template <FloatOrDouble Scalar>
class TriangleMeshView {
 public:
  /// No vertices and no triangles.
  TriangleMeshView() = default;
  TriangleMeshView(const VertexView<Scalar>& vertices, const TriangleIndexView& triangles) noexcept
      : vertices_(vertices), triangles_(triangles) {}

  [[nodiscard]] const VertexView<Scalar>& vertices() const { return vertices_; }
  [[nodiscard]] const TriangleIndexView& triangles() const { return triangles_; }
  [[nodiscard]] std::size_t vertex_count() const { return vertices_.size(); }
  [[nodiscard]] std::size_t triangle_count() const { return triangles_.size(); }

  [[nodiscard]] Vector3<Scalar> vertex(std::size_t index) const { return vertices_[index]; }
  /// The index of corner 0, 1 or 2 (a, b, c) of a triangle.
  [[nodiscard]] std::uint32_t corner(std::size_t triangle, std::size_t which) const {
    return triangles_.corner(triangle, which);
  }
  [[nodiscard]] Triangle<Scalar> triangle(std::size_t index) const {
    return {vertex(corner(index, 0)), vertex(corner(index, 1)), vertex(corner(index, 2))};
  }

 private:
  VertexView<Scalar> vertices_;
  TriangleIndexView triangles_;
};

/// The first thing that keeps the mesh from being built, in this order: an array that is null, is not whole triples or
/// has too small a stride; too many triangles; the first triangle with an index out of range; the first vertex, used
/// or not, that is NaN or infinite. Nothing if the mesh is good. Takes linear time.
template <FloatOrDouble Scalar>
[[nodiscard]] SUREHIT_API std::optional<InvalidMesh> find_invalid(const TriangleMeshView<Scalar>& mesh);

extern template SUREHIT_API std::optional<InvalidMesh> find_invalid(const TriangleMeshView<float>&);
extern template SUREHIT_API std::optional<InvalidMesh> find_invalid(const TriangleMeshView<double>&);

using TriangleMeshViewf = TriangleMeshView<float>;
using TriangleMeshViewd = TriangleMeshView<double>;

}  // namespace surehit
