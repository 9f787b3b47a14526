#pragma once

#include "picture/canvas.hpp"
#include "render/camera.hpp"
#include "render/ray_counts.hpp"
#include "render/world.hpp"

namespace surehit::example {

/// Gives each triangle a colour of its own, and each pixel the colour of what its ray first meets. Adds to `counts`.
[[nodiscard]] Canvas draw_ids(const World& world, const Camera& camera, unsigned threads, RayCounts& counts);

/// The colour of a triangle.
[[nodiscard]] Colour colour_of_id(std::uint32_t triangle);

}  // namespace surehit::example
