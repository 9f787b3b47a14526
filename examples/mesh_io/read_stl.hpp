#pragma once

#include <string_view>

#include "mesh_io/mesh.hpp"

namespace surehit::example {

/// An STL file, ASCII or binary; three vertices a triangle, none of them shared. Normals are passed over: the order of
/// the corners says the same. Throws InputError.
template <typename Scalar>
[[nodiscard]] Mesh<Scalar> read_stl(std::string_view bytes);

}  // namespace surehit::example
