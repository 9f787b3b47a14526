#include "render/shaded_picture.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>
#include <vector>

#include "command_line/chunked_run.hpp"
#include "command_line/interruption.hpp"
#include "render/tracer.hpp"

namespace surehit::example {
namespace {

/// The light of a pixel as sRGB shows it, or nearly so. Platforms agree on roots, and not on other powers.
Colour shown(const Light& light) {
  const Light root = light.max(0.0f).min(1.0f).sqrt();
  return {root[0], root[1], root[2]};
}

}  // namespace

Camera camera_of(const Stage& stage, int width, int height, DirectionLength length) {
  return Camera({stage.eye, stage.target, Vector3f::UnitZ(), tangent_of_half(stage.degrees), width, height, length});
}

Canvas draw_shaded(const World& world, const Stage& stage, const ShadingOptions& options, RayCounts& counts) {
  const int samples = options.samples;
  const Camera camera = camera_of(stage, samples * options.width, samples * options.height, options.length);
  const Tracer tracer(world, stage, options.max_depth);
  Canvas canvas(options.width, options.height, {});
  const auto rays_of_a_row = static_cast<std::size_t>(options.width) * static_cast<std::size_t>(samples * samples);
  const std::size_t rows = std::max(std::size_t{1}, world.rays_of_a_batch() / rays_of_a_row);
  std::mutex mutex;
  const auto start = std::chrono::steady_clock::now();

  const auto draw_rows = [&](std::size_t begin, std::size_t end) {
    stop_if_interrupted();
    std::vector<Rayf> rays;
    for (int j = samples * static_cast<int>(begin); j < samples * static_cast<int>(end); ++j) {
      for (int i = 0; i < camera.width(); ++i) rays.push_back(camera.ray(i, j));
    }
    std::vector<Light> lights(rays.size());
    RayCounts counts_of_rows;
    tracer.trace(rays, lights, counts_of_rows);
    for (int row = static_cast<int>(begin); row < static_cast<int>(end); ++row) {
      for (int column = 0; column < options.width; ++column) {
        Light sum = Light::Zero();
        for (int j = 0; j < samples; ++j) {
          const int ray_row = samples * (row - static_cast<int>(begin)) + j;
          for (int i = 0; i < samples; ++i) {
            sum += lights[static_cast<std::size_t>(ray_row) * static_cast<std::size_t>(camera.width()) +
                          static_cast<std::size_t>(samples * column + i)];
          }
        }
        canvas.at(column, row) = shown(sum / static_cast<float>(samples * samples));
      }
    }
    const std::lock_guard lock(mutex);
    counts += counts_of_rows;
  };
  const auto rate = [&] {
    const std::lock_guard lock(mutex);
    return rate_since(start, counts.all());
  };
  run_in_chunks("render", static_cast<std::size_t>(options.height), rows, options.threads, draw_rows, rate);
  return canvas;
}

}  // namespace surehit::example
