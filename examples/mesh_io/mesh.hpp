#pragma once

#include <array>
#include <cstdint>
#include <surehit/triangle_mesh_view.hpp>
#include <vector>

namespace surehit::example {

/// A mesh that owns its arrays.
template <typename Scalar>
struct Mesh {
  std::vector<std::array<Scalar, 3>> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  /// Lasts until either array changes.
  [[nodiscard]] TriangleMeshView<Scalar> view() const {
    return {vertices.empty() ? nullptr : vertices.front().data(), vertices.size(),
            triangles.empty() ? nullptr : triangles.front().data(), triangles.size()};
  }
};

}  // namespace surehit::example
