#pragma once

#include <string>

#include "mesh_io/mesh.hpp"

namespace surehit::example {

/// Reads a mesh file, and prints its warnings in the program's name. `up` is the mesh's upward axis, "y" or "z". A mesh
/// with y up is turned until z is up. Throws InputError.
[[nodiscard]] Mesh<float> read_with_z_up(const char* program, const std::string& path, const std::string& up);

}  // namespace surehit::example
