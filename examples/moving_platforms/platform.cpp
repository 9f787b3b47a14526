#include "moving_platforms/platform.hpp"

#include <cmath>

#include "level/solid_builder.hpp"

namespace surehit::example {

Vector3f Platform::position(std::uint32_t step) const {
  const std::uint32_t half = steps + pause;
  const std::uint32_t phase = (step + ahead) % (2 * half);
  const std::uint32_t since_end = phase % half;
  const float gone = since_end < steps ? static_cast<float>(since_end) / static_cast<float>(steps) : 1.0f;
  const float share = phase < half ? gone : 1 - gone;
  const float smooth = share * share * (3 - 2 * share);
  Vector3f position;
  for (int axis = 0; axis < 3; ++axis) position[axis] = home[axis] + std::round(1024 * smooth * way[axis]) / 1024;
  return position;
}

Mesh<float> Platform::mesh() const {
  constexpr float whole = 64;  // No box is cut into pieces.
  SolidBuilder builder(whole);
  for (const Boxf& box : boxes) {
    builder.add_box({box.low.x(), box.low.y(), box.low.z()}, {box.high.x(), box.high.y(), box.high.z()});
  }
  return builder.take();
}

}  // namespace surehit::example
