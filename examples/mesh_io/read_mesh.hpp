#pragma once

#include <string>

#include "mesh_io/mesh.hpp"

namespace surehit::example {

/// Reads an OBJ, PLY, STL or OFF file, told apart by the ending of its name. README.md has the dialects.
///
/// Coordinates are rounded once to the nearest Scalar. Faces of more than three corners are triangulated. Where floats
/// are too coarse for the file, the mesh says so in its warnings.
///
/// Throws InputError in one line that names the file, the line or the element, and what is wrong, for anything that is
/// not wholly understood. The line says so where a file cannot be read in float but in double. The memory taken is
/// bounded by the bytes in the file, not by what they claim.
template <typename Scalar>
[[nodiscard]] Mesh<Scalar> read_mesh(const std::string& path);

}  // namespace surehit::example
