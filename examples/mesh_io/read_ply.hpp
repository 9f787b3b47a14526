#pragma once

#include <string_view>

#include "mesh_io/mesh.hpp"

namespace surehit::example {

/// Reads a PLY file, ASCII or binary in either order of bytes.
///
/// Taken are x, y and z of the element vertex, and the lists vertex_indices (or vertex_index) of the elements face and
/// tristrips; each triangle of a strip is a face. Other elements and properties are passed over. A file may have no
/// faces. Throws InputError.
template <typename Scalar>
[[nodiscard]] Mesh<Scalar> read_ply(std::string_view bytes);

}  // namespace surehit::example
