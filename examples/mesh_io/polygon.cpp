#include "mesh_io/polygon.hpp"

#include <limits>
#include <string>

#include "mesh_io/input_error.hpp"

namespace surehit::example {

std::uint32_t checked_corner(std::int64_t index, std::uint64_t vertex_count) {
  if (index < 0 || static_cast<std::uint64_t>(index) >= vertex_count) {
    throw InputError("vertex index " + std::to_string(index) + " is out of range, there are " +
                     std::to_string(vertex_count) + " vertices");
  }
  if (index > std::numeric_limits<std::uint32_t>::max()) {
    throw InputError("a vertex index is beyond 32 bits");
  }
  return static_cast<std::uint32_t>(index);
}

void append_fan(const std::vector<std::uint32_t>& corners, std::vector<std::array<std::uint32_t, 3>>& triangles) {
  if (corners.size() < 3) {
    throw InputError("a face needs 3 corners or more, not " + std::to_string(corners.size()));
  }
  for (std::size_t i = 2; i < corners.size(); ++i) triangles.push_back({corners[0], corners[i - 1], corners[i]});
}

}  // namespace surehit::example
