#include "render/id_picture.hpp"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <vector>

#include "command_line/chunked_run.hpp"
#include "command_line/interruption.hpp"
#include "render/frame_colours.hpp"

namespace surehit::example {

Colour colour_of_id(std::uint32_t triangle) {
  // Neighbours in the mesh have numbers that differ little. Their colours must not.
  std::uint32_t bits = triangle + 1;
  for (const std::uint32_t factor : {0x7feb352du, 0x846ca68bu}) {
    bits = (bits ^ bits >> 16) * factor;
    bits ^= bits >> 15;
  }
  const auto part = [&](std::uint32_t shift) { return 0.25f + 0.7f * static_cast<float>(bits >> shift & 255) / 255; };
  return {part(0), part(8), part(16)};
}

Canvas draw_ids(const World& world, const Camera& camera, unsigned threads, RayCounts& counts) {
  Canvas canvas(camera.width(), camera.height(), paper);
  const auto width = static_cast<std::size_t>(camera.width());
  const std::size_t rows = std::max(std::size_t{1}, world.rays_of_a_batch() / width);
  std::mutex mutex;
  const auto start = std::chrono::steady_clock::now();
  const auto draw_rows = [&](std::size_t begin, std::size_t end) {
    stop_if_interrupted();
    std::vector<Rayf> rays;
    for (std::size_t i = begin * width; i < end * width; ++i) {
      rays.push_back(camera.ray(static_cast<int>(i % width), static_cast<int>(i / width)));
    }
    std::vector<Hitf> hits(rays.size());
    RayCounts counts_of_rows;
    counts_of_rows.measure(RayKind::primary, rays.size(), [&] { world.first_hits(rays, hits); });
    for (std::size_t i = 0; i < hits.size(); ++i) {
      if (hits[i].triangle == no_triangle) continue;
      const std::size_t pixel = begin * width + i;
      canvas.at(static_cast<int>(pixel % width), static_cast<int>(pixel / width)) = colour_of_id(hits[i].triangle);
    }
    const std::lock_guard lock(mutex);
    counts += counts_of_rows;
  };
  run_in_chunks("ids", static_cast<std::size_t>(camera.height()), rows, threads, draw_rows, [&] {
    const std::lock_guard lock(mutex);
    return rate_since(start, counts.all());
  });
  return canvas;
}

}  // namespace surehit::example
