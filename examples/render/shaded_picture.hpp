#pragma once

#include "picture/canvas.hpp"
#include "render/ray_counts.hpp"
#include "render/stage.hpp"
#include "render/world.hpp"

namespace surehit::example {

struct ShadingOptions {
  int width = 640;
  int height = 480;
  int samples = 1;  ///< in each direction: a pixel has the mean light of samples · samples rays
  int max_depth = 8;
  DirectionLength length = DirectionLength::to_image_plane;
  unsigned threads = 1;
};

/// Renders a stage. The picture is the same for any number of threads. Adds to `counts`.
[[nodiscard]] Canvas draw_shaded(const World& world, const Stage& stage, const ShadingOptions& options,
                                 RayCounts& counts);

/// The camera of a stage, for a picture of a size.
[[nodiscard]] Camera camera_of(const Stage& stage, int width, int height,
                               DirectionLength length = DirectionLength::to_image_plane);

}  // namespace surehit::example
