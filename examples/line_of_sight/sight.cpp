#include "line_of_sight/sight.hpp"

#include "command_line/chunked_run.hpp"

namespace surehit::example {

std::vector<Sight> look_around(const Colliderf& collider, const FloorPlan& plan, const Vector3f& eye,
                               float height_above_floor, unsigned threads, const GpuBatches* gpu) {
  std::vector<Sight> sights(plan.size(), Sight::no_floor);
  const std::size_t chunk = gpu != nullptr ? 1 << 18 : 1 << 14;
  run_in_chunks("line of sight", plan.size(), chunk, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<std::size_t> places;
    std::vector<Segmentf> segments;
    for (std::size_t i = begin; i < end; ++i) {
      if (!plan.has_floor(i)) continue;
      places.push_back(i);
      segments.push_back({eye, {plan.x(i), plan.y(i), plan.floor_height(i) + height_above_floor}});
    }
    std::vector<std::uint8_t> blocked(segments.size());
    if (gpu != nullptr) {
      gpu->any_hits(segments, blocked, {});
    } else {
      collider.any_hits(segments, blocked);
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
      sights[places[i]] = blocked[i] != 0 ? Sight::hidden : Sight::visible;
    }
  });
  return sights;
}

}  // namespace surehit::example
