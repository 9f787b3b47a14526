#include "render/free_points.hpp"

#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace surehit::example {

void free_points(const World& world, std::span<const Rayf> rays, std::span<const Medium> media,
                 std::span<const Hitf> hits, std::span<Vector3f> points) {
  std::vector<std::size_t> waiting(rays.size());
  std::iota(waiting.begin(), waiting.end(), std::size_t{0});
  std::vector<Segmentf> ways;
  std::vector<Medium> media_of_ways;
  std::vector<std::uint8_t> blocked;
  for (float ulps = 1; !waiting.empty(); ulps *= 2) {
    ways.clear();
    media_of_ways.clear();
    std::vector<std::size_t> asked;
    for (const std::size_t i : waiting) {
      const float ulp = std::nextafter(hits[i].t, std::numeric_limits<float>::infinity()) - hits[i].t;
      const float t = hits[i].t - ulps * ulp;
      points[i] = rays[i].origin;
      if (!(t > 0) || !std::isfinite(t)) continue;
      points[i] = point(rays[i], Hitf{.t = t});
      asked.push_back(i);
      ways.push_back({rays[i].origin, points[i]});
      media_of_ways.push_back(media[i]);
    }
    blocked.resize(ways.size());
    world.any_hits(ways, media_of_ways, blocked);
    waiting.clear();
    for (std::size_t k = 0; k < asked.size(); ++k) {
      if (blocked[k] != 0) waiting.push_back(asked[k]);
    }
  }
}

}  // namespace surehit::example
