#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "support/grid_breaking_meshes.hpp"
#include "support/random.hpp"

namespace surehit::test {

/// Draws segments that come down from one height. One in `share` ends in a vertex of the ground, and is mostly
/// undecided.
inline std::vector<Segmentf> draw_segments_to(const GeneratedMesh<float>& ground, float height, std::size_t count,
                                              std::uint64_t share) {
  Random random(42);
  std::vector<Segmentf> segments;
  for (std::size_t i = 0; i < count; ++i) {
    Vector3f end(random.symmetric<float>(), random.symmetric<float>(), random.unit<float>() - 0.5F);
    if (random.one_in(share)) end = ground.vertices[random.below(ground.vertices.size())];
    segments.push_back({{random.symmetric<float>(), random.symmetric<float>(), height}, end});
  }
  return segments;
}

}  // namespace surehit::test
