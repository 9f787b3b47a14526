#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "support/grid_breaking_meshes.hpp"
#include "support/random.hpp"

namespace surehit::test {

/// Draws segments that come down from one height. One in `share` ends in a vertex of the ground. It begins so near to
/// x = 0 that whole numbers of a device do not hold it, so it is mostly undecided.
inline std::vector<Segmentf> draw_segments_to(const GeneratedMesh<float>& ground, float height, std::size_t count,
                                              std::uint64_t share) {
  Random random(42);
  std::vector<Segmentf> segments;
  for (std::size_t i = 0; i < count; ++i) {
    Vector3f end(random.symmetric<float>(), random.symmetric<float>(), random.unit<float>() - 0.5F);
    Vector3f start(random.symmetric<float>(), random.symmetric<float>(), height);
    if (random.one_in(share)) {
      end = ground.vertices[random.below(ground.vertices.size())];
      start[0] = 0x1p-40F;
    }
    segments.push_back({start, end});
  }
  return segments;
}

}  // namespace surehit::test
