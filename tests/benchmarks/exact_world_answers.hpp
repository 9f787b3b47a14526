#pragma once

#include <cstdint>
#include <span>
#include <surehit/path.hpp>
#include <vector>

#include "world.hpp"

namespace surehit::benchmark {

/// Returns whether each path meets anything, by exact arithmetic on the exact images of all instances. Of the first
/// paths only, since the judge is slow. Without CGAL, there is no judge, and the result is empty.
[[nodiscard]] std::vector<std::uint8_t> exact_world_answers(const World& world, std::span<const Segmentf> paths);

}  // namespace surehit::benchmark
