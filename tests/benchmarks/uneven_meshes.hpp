#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "named_mesh.hpp"

namespace surehit::benchmark {

/// Names the meshes that are built here. They are what games are made of: small things in large surroundings, a
/// triangle far from all others, cubes on whole numbers, and a large terrain.
[[nodiscard]] std::vector<std::string> uneven_mesh_names();

/// Builds the mesh of that name. `detail` is 1, or less for a quick look. Has the same bits on every platform.
[[nodiscard]] NamedMesh uneven_mesh(const std::string& name, float detail);

/// Builds a bumpy ball about the origin, of 12 pieces² triangles. Has the same bits on every platform.
[[nodiscard]] example::Mesh<float> bumpy_ball(double radius, std::uint32_t pieces);

}  // namespace surehit::benchmark
