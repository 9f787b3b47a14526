#pragma once

#include <cstddef>
#include <vector>

#include "character/capsule_sweep.hpp"

namespace surehit::example {

/// Where a character is, and how it moves on.
struct Character {
  Vector3f position = Vector3f::Zero();  ///< The centre of its body.
  float fall_speed = 0;                  ///< Metres a second, downwards.
  bool is_standing = false;
};

/// Lets characters walk, slide along walls, climb steps and fall.
///
/// A step goes ahead first, and slides along what is in the way. If something stops it, it tries the same from a step's
/// height above. At last it goes down, to the ground or by its fall. A walker knows nothing of how a sweep finds its
/// answers.
class Walker {
 public:
  static constexpr float time_step = 1.0f / 32;
  static constexpr float step_height = 0.3125f;
  /// The ground carries a character if its normal has at least this z, so up to 45 degrees.
  static constexpr float min_carrying_z = 0.70710678f;

  /// The sweep must outlive this.
  explicit Walker(const CapsuleSweep& sweep) : sweep_(sweep) {}

  /// Takes one step. `velocity` is level: where the character wants to go. Appends each position to which the character
  /// goes straight, in their order. Adds its queries to `queries`.
  void step(Character& character, const Vector3f& velocity, std::vector<Vector3f>& positions,
            std::size_t& queries) const;

 private:
  class Step;
  const CapsuleSweep& sweep_;
};

}  // namespace surehit::example
