#pragma once

#include <cstdint>
#include <vector>

#include "game_physics/arena.hpp"
#include "game_physics/sweep.hpp"

namespace surehit::example {

struct MovingPoint {
  Vector3f position;
  Vector3f velocity;
};

/// Where a point has been. It went straight from each position to the next. The first one is its start.
struct Course {
  std::vector<Vector3f> positions;
  std::size_t steps = 0;
  std::size_t bounces = 0;
  double length_wanted = 0;     ///< by the speed at each step, bounces or not
  double length_completed = 0;  ///< what of it the point went

  [[nodiscard]] bool is_stuck_at_start() const { return positions.size() == 1; }
};

/// Lets points fly through an arena: each step takes its share of gravity and then goes straight on, reflected without
/// loss by every wall that it meets on its way. A point's energy stays what it was at the start.
class Flight {
 public:
  static constexpr float time_step = 0.25f;
  /// After so many bounces within a step the rest of the step is lost: a point that is caught in a corner is not to
  /// hang the game.
  static constexpr int max_bounces = 64;

  Flight(const Arena& arena, const Sweep& sweep);

  /// Ends early where the point has left the room.
  [[nodiscard]] Course fly(MovingPoint point, std::size_t steps) const;

 private:
  void step(MovingPoint& point, float energy, Course& course) const;
  [[nodiscard]] Vector3f reflected(const Vector3f& velocity, const Contact& contact) const;

  const Arena& arena_;
  const Sweep& sweep_;
  std::vector<Vector3f> normals_;
};

}  // namespace surehit::example
