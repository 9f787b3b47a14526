#pragma once

#include <string_view>

#include "mesh_io/mesh.hpp"

namespace surehit::example {

/// Reads a Wavefront OBJ file: `v` and `f`, with indices from 1 or, negative, back from the newest vertex.
///
/// A fourth number of a vertex is its weight w: the point is (x/w, y/w, z/w), each number and each quotient rounded to
/// nearest. Six or seven numbers are a point and its color. What moves no point and adds no surface (colors, normals,
/// groups, materials, lines) is passed over. Throws InputError.
template <typename Scalar>
[[nodiscard]] Mesh<Scalar> read_obj(std::string_view text);

}  // namespace surehit::example
