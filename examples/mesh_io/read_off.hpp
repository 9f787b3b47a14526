#pragma once

#include <string_view>

#include "mesh_io/mesh.hpp"

namespace surehit::example {

/// An OFF file in ASCII. With vertex normals, colors or texture coordinates (NOFF, COFF, STOFF and their mixtures),
/// these are passed over, as colors of faces are. Throws InputError.
template <typename Scalar>
[[nodiscard]] Mesh<Scalar> read_off(std::string_view text);

}  // namespace surehit::example
