#pragma once

#include <string_view>

#include "mesh_io/mesh.hpp"

namespace surehit::example {

/// Reads an STL file, ASCII or binary; three vertices a triangle, none of them shared.
///
/// Normals are passed over: the order of the corners says the same. So are colors. In a binary file the attribute of a
/// triangle is a color, or the size of what follows it if that makes the file as long as it is. Bytes after the last
/// triangle are passed over. Throws InputError.
template <typename Scalar>
[[nodiscard]] Mesh<Scalar> read_stl(std::string_view bytes);

}  // namespace surehit::example
