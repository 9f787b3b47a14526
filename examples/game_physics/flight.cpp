#include "game_physics/flight.hpp"

#include <algorithm>
#include <cmath>

namespace surehit::example {
namespace {

constexpr float gravity = 9.81f;

/// Returns the energy of a unit of mass.
float energy_of(const MovingPoint& point) { return point.velocity.squaredNorm() / 2 + gravity * point.position.z(); }

/// Steps as long as these would heat the room up, if each bounce within a step did not know how much of its gravity was
/// due. So a step takes only its turn from gravity, and its speed from the height.
Vector3f pulled_down(const MovingPoint& point, float energy) {
  constexpr float pull = Flight::time_step * gravity;
  const Vector3f velocity = point.velocity - Vector3f(0, 0, pull);
  const float square = std::max(2 * (energy - gravity * point.position.z()), pull * pull);
  return std::sqrt(square) * velocity.normalized();
}

/// Goes straight to a position and notes it, if the point moves at all.
void go(MovingPoint& point, const Vector3f& to, Course& course) {
  if (to == point.position) return;
  course.length_completed += double{(to - point.position).norm()};
  course.positions.push_back(to);
  point.position = to;
}

}  // namespace

Flight::Flight(const Arena& arena, const Sweep& sweep) : arena_(arena), sweep_(sweep) {
  const TriangleMeshViewf view = arena.walls.view();
  for (std::uint32_t i = 0; i < view.triangle_count(); ++i) normals_.push_back(normal(view, i));
}

Course Flight::fly(MovingPoint point, std::size_t steps) const {
  Course course;
  course.positions.push_back(point.position);
  const float energy = energy_of(point);
  while (course.steps < steps && arena_.room.contains(point.position)) step(point, energy, course);
  return course;
}

void Flight::step(MovingPoint& point, float energy, Course& course) const {
  point.velocity = pulled_down(point, energy);
  course.length_wanted += double{time_step * point.velocity.norm()};
  ++course.steps;
  float time_left = time_step;
  for (int bounce = 0; bounce < max_bounces; ++bounce) {
    const Segmentf move{point.position, point.position + time_left * point.velocity};
    const auto contact = sweep_.first_contact(move);
    go(point, contact ? contact->stop : move.end, course);
    if (!contact) return;
    ++course.bounces;
    point.velocity = reflected(point.velocity, *contact);
    time_left *= 1 - contact->t;
  }
}

Vector3f Flight::reflected(const Vector3f& velocity, const Contact& contact) const {
  if (contact.side == Side::edge_on) return -velocity;
  const Vector3f normal = contact.side == Side::front ? normals_[contact.wall] : -normals_[contact.wall];
  // A grazing contact may look like a departure once it is rounded; the point must turn away from the wall all the
  // same.
  const float approach = std::min(normal.dot(velocity), -1e-6f * velocity.norm());
  return velocity - 2 * approach * normal;
}

}  // namespace surehit::example
