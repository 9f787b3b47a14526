#include "moving_platforms/fan.hpp"

#include <array>
#include <cmath>

namespace surehit::example {

Mesh<float> Fan::mesh() const {
  constexpr float hub = 0.25f;
  constexpr float half_width = 0.375f;
  constexpr float half_depth = 0.25f;
  constexpr std::array<std::array<float, 2>, 4> directions = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  Mesh<float> mesh;
  for (const auto& [x, z] : directions) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const float r : {hub, radius}) {
      mesh.vertices.push_back({r * x - half_width * z, -half_depth, r * z + half_width * x});
      mesh.vertices.push_back({r * x + half_width * z, half_depth, r * z - half_width * x});
    }
    mesh.triangles.push_back({first, first + 1, first + 3});
    mesh.triangles.push_back({first, first + 3, first + 2});
  }
  return mesh;
}

Vector3f Fan::motion_at(const Vector3f& point) const {
  const float square = half_turn * half_turn;
  const float cosine = (1 - square) / (1 + square);
  const float sine = 2 * half_turn / (1 + square);
  const Vector3f arm = point - centre;
  return {arm.x() * cosine + arm.z() * sine - arm.x(), 0, arm.z() * cosine - arm.x() * sine - arm.z()};
}

void FanTurn::advance(const Fan& fan) {
  const float cosine = cosine_ - sine_ * fan.half_turn;
  const float sine = sine_ + cosine_ * fan.half_turn;
  const float length = std::sqrt(cosine * cosine + sine * sine);
  cosine_ = cosine / length;
  sine_ = sine / length;
}

}  // namespace surehit::example
