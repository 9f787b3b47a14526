#pragma once

#include <optional>
#include <string>

#include "mesh_io/mesh.hpp"

namespace surehit::example {

/// Whether floats may be too coarse for the mesh. They are if half a unit in the last place of its largest coordinate
/// is a noticeable part of it, or of one of its triangles. Then `describe_float_loss` tells by the file's own
/// coordinates.
[[nodiscard]] bool may_lose_in_float(const Mesh<float>& mesh);

/// What a mesh loses by being rounded to float, in one line that names the worst coordinate; nothing where that is
/// little. Both are read from the same file.
///
/// It is little if no vertex moves by more than a millionth of the mesh's size. A vertex must also not move by more
/// than a hundredth of the longest side of any of its triangles.
[[nodiscard]] std::optional<std::string> describe_float_loss(const Mesh<float>& rounded, const Mesh<double>& mesh);

}  // namespace surehit::example
