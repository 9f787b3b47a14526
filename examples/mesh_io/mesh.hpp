#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <surehit/triangle_mesh_view.hpp>
#include <vector>

namespace surehit::example {

/// The warning for a mesh of nothing.
inline constexpr const char* no_triangles = "the mesh has no triangles, so nothing is ever hit";

/// A mesh that owns its arrays.
template <typename Scalar>
struct Mesh {
  std::vector<std::array<Scalar, 3>> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /// The face of the file that each triangle was cut from, from 0. Empty where every triangle is a face.
  std::vector<std::uint32_t> faces;
  /// What the file's user should know although it was read: a line each, without the file's name.
  std::vector<std::string> warnings;

  /// Valid until an array changes.
  [[nodiscard]] TriangleMeshView<Scalar> view() const { return {vertices, triangles}; }

  [[nodiscard]] std::uint32_t face_of(std::uint32_t triangle) const {
    return faces.empty() ? triangle : faces[triangle];
  }

  [[nodiscard]] std::size_t face_count() const {
    return faces.empty() ? triangles.size() : std::size_t{faces.back()} + 1;
  }
};

}  // namespace surehit::example
