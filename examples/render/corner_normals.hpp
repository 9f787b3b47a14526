#pragma once

#include <array>
#include <vector>

#include "mesh_io/mesh.hpp"

namespace surehit::example {

/// Returns unit normals at the corners of each triangle, for a mesh whose file has none.
///
/// At a corner, it is the mean of the normals of all triangles that share the vertex, by their areas. Triangles that
/// are inclined by more than about 40 degrees do not count: there is an edge to be seen.
[[nodiscard]] std::vector<std::array<Vector3f, 3>> corner_normals(const Mesh<float>& mesh);

}  // namespace surehit::example
