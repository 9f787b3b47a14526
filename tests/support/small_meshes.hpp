#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "support/random.hpp"
#include "surehit/path.hpp"
#include "surehit/triangle_mesh_view.hpp"

namespace surehit::test {

/// A mesh of 1 to 64 triangles, and paths that are hard for it.
template <typename Scalar>
struct SmallMesh {
  std::vector<Vector3<Scalar>> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Path<Scalar>> paths;

  [[nodiscard]] TriangleMeshView<Scalar> view() const { return {vertices, triangles}; }
};

/// Where a small mesh comes from: one of the pair families, every triangle with a path of its own, or vertices on a
/// lattice, where ties abound.
inline constexpr std::size_t small_mesh_kind_count = 17;
[[nodiscard]] std::string name_of_small_mesh(std::size_t kind);

/// The next mesh of a kind. Call it in the default floating-point environment.
template <typename Scalar>
[[nodiscard]] SmallMesh<Scalar> draw_small_mesh(std::size_t kind, Random& random);

}  // namespace surehit::test
