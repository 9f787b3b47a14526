#pragma once

#include <cstdint>
#include <string>
#include <surehit/collider.hpp>
#include <surehit/query_statistics.hpp>
#include <vector>

#include "picture/canvas.hpp"
#include "render/camera.hpp"
#include "render/ray_counts.hpp"

namespace surehit::example {

/// What a pixel's colour counts.
enum class Cost : std::uint8_t { cells, candidates, exact_decisions };

/// How much work the ray of each pixel is, row by row. Adds to `counts`.
[[nodiscard]] std::vector<std::uint64_t> costs_of(const Colliderf& collider, const Camera& camera, Culling culling,
                                                  Cost cost, unsigned threads, RayCounts& counts);

/// Draws costs from dark to bright, with a legend below. `name` says what they count.
[[nodiscard]] Canvas draw_costs(const std::vector<std::uint64_t>& costs, int width, int height,
                                const std::string& name);

}  // namespace surehit::example
