#pragma once

#include <string>

namespace surehit::test {

// The properties of a header that most PLY files have. Variables that are not inline are made in their order in the
// file.
const std::string vertex_lines = "property float x\nproperty float y\nproperty float z\n";
const std::string face_line = "property list uchar int vertex_indices\n";

}  // namespace surehit::test
