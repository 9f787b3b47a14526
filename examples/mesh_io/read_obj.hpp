#pragma once

#include <string_view>

#include "mesh_io/mesh.hpp"

namespace surehit::example {

/// A Wavefront OBJ file: `v` and `f`, with indices from 1 or, negative, back from the newest vertex. What gives points
/// no other place and adds no surface (normals, groups, materials, lines) is passed over. Throws InputError.
template <typename Scalar>
[[nodiscard]] Mesh<Scalar> read_obj(std::string_view text);

}  // namespace surehit::example
