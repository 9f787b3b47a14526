#pragma once

#include <string>

#include "mesh_io/mesh.hpp"

namespace surehit::example {

/// Reads an OBJ, PLY, STL or OFF file, told apart by the ending of its name. Polygons become fans: corner 0 with each
/// following pair. Coordinates are rounded once to the nearest Scalar.
///
/// Throws InputError in one line that names the file, the line or the element, and what is wrong, for anything that is
/// not wholly understood. The memory taken is bounded by the bytes in the file, not by what they claim.
template <typename Scalar>
[[nodiscard]] Mesh<Scalar> read_mesh(const std::string& path);

}  // namespace surehit::example
