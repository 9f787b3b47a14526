#pragma once

#include <cstdint>
#include <surehit/collider.hpp>
#include <vector>

#include "command_line/gpu_batches.hpp"
#include "line_of_sight/floor_plan.hpp"

namespace surehit::example {

/// What an eye makes out at a grid point of the plan.
enum class Sight : std::uint8_t { no_floor, hidden, visible };

/// Looks from the eye to a point above each floor of the plan: visible if the segment between them meets nothing at
/// all. A GPU answers if there is one, with the same result.
[[nodiscard]] std::vector<Sight> look_around(const Colliderf& collider, const FloorPlan& plan, const Vector3f& eye,
                                             float height_above_floor, unsigned threads,
                                             const GpuBatches* gpu = nullptr);

}  // namespace surehit::example
