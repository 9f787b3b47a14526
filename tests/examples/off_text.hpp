#pragma once

#include <cstdint>
#include <string>

#include "sample_polygons.hpp"

namespace surehit::test {

/// The lines of four vertices.
inline const std::string square = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

/// Returns a file of one face.
inline std::string text_of(const SampleFace& face) {
  std::string text = "OFF\n" + std::to_string(face.vertices.size()) + " 1 0\n";
  for (const auto& [x, y, z] : face.vertices) {
    text += std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
  }
  text += std::to_string(face.corners.size());
  for (const std::uint32_t corner : face.corners) text += " " + std::to_string(corner);
  return text + "\n";
}

}  // namespace surehit::test
