#pragma once

#include <string_view>

#include "mesh_io/mesh.hpp"

namespace surehit::example {

/// A PLY file, ASCII or binary in either order of bytes: x, y and z of the element vertex, and the list vertex_indices
/// (or vertex_index) of the element face. Other elements and properties are passed over. Throws InputError.
template <typename Scalar>
[[nodiscard]] Mesh<Scalar> read_ply(std::string_view bytes);

}  // namespace surehit::example
