#include "game_physics/epsilon_sweep.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace surehit::example {

EpsilonSweep::EpsilonSweep(const Mesh<float>& walls, float skin) : skin_(skin) {
  const auto corner = [&](std::uint32_t id) -> Vector3f {
    const auto& [x, y, z] = walls.vertices[id];
    return {x, y, z};
  };
  for (const auto& [a, b, c] : walls.triangles) {
    const Vector3f edge1 = corner(b) - corner(a);
    const Vector3f edge2 = corner(c) - corner(a);
    walls_.push_back({corner(a), edge1, edge2, edge1.cross(edge2).normalized()});
  }
}

std::optional<Contact> EpsilonSweep::first_contact(const Segmentf& move) const {
  constexpr float epsilon = 1e-6f;
  const Vector3f direction = move.end - move.start;
  std::optional<Contact> first;
  for (std::uint32_t i = 0; i < walls_.size(); ++i) {
    const Wall& wall = walls_[i];
    const Vector3f p = direction.cross(wall.edge2);
    const float det = wall.edge1.dot(p);
    if (std::abs(det) < epsilon) continue;
    const Vector3f s = move.start - wall.a;
    const float u = s.dot(p) / det;
    if (u < 0 || u > 1) continue;
    const Vector3f q = s.cross(wall.edge1);
    const float v = direction.dot(q) / det;
    if (v < 0 || u + v > 1) continue;
    const float t = wall.edge2.dot(q) / det;
    if (t < 0 || t > 1 || (first && t >= first->t)) continue;
    const Vector3f off_the_wall = (det > 0 ? skin_ : -skin_) * wall.normal;
    first = Contact{i, det > 0 ? Side::front : Side::back, t, move.start + t * direction + off_the_wall};
  }
  return first;
}

}  // namespace surehit::example
