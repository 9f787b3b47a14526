#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "questions.hpp"

namespace surehit::test {

/// A mesh, its masks, and what is asked about it.
template <typename Scalar>
class HardMesh {
 public:
  [[nodiscard]] TriangleMeshView<Scalar> view() const { return {vertices, triangles}; }
  [[nodiscard]] Collider<Scalar> collider(const GridOptions& grid = {}) const {
    Collider<Scalar> result;
    if (!result.try_build(view(), {grid, masks})) return {};
    return result;
  }

  std::vector<std::array<Scalar, 3>> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> masks;
  Questions<Scalar> questions;

 protected:
  void add_vertex(const Vector3<Scalar>& vertex) { vertices.push_back({vertex[0], vertex[1], vertex[2]}); }
  /// Adds a triangle that shares no vertex.
  void add_corners(const std::array<Vector3<Scalar>, 3>& corners) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (const Vector3<Scalar>& corner : corners) add_vertex(corner);
    triangles.push_back({first, first + 1, first + 2});
  }
};

}  // namespace surehit::test
