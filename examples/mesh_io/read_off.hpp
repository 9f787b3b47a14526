#pragma once

#include <string_view>

#include "mesh_io/mesh.hpp"

namespace surehit::example {

/// Reads an OFF file in ASCII, with or without its first word, which may be in lower case.
///
/// Vertex normals, colors and texture coordinates (NOFF, COFF, STOFF and their mixtures) are passed over. So are colors
/// of faces, of 1, 3 or 4 numbers, and those of vertices under a plain OFF. Numbers may be parted by any line breaks. A
/// color of a face ends with its line. But in a file that has a line for each vertex and for each face, and a few lines
/// with other numbers of words, those are wrong. Throws InputError.
template <typename Scalar>
[[nodiscard]] Mesh<Scalar> read_off(std::string_view text);

}  // namespace surehit::example
