#pragma once

#include <cstdint>
#include <random>

#include "character/walker.hpp"

namespace surehit::example {

/// Decides where a character wants to go: to one goal after the other. It knows no ways, so it walks against walls.
/// If it does not come forward, it chooses another goal.
class Mind {
 public:
  explicit Mind(std::uint32_t seed);

  /// Returns the level velocity that it wants in this step.
  [[nodiscard]] Vector3f decide(const Character& character);
  /// How long it has come no farther than a hand's breadth, whatever its goal was, in rounds of 16 steps.
  [[nodiscard]] std::uint32_t failed_rounds() const { return failed_rounds_; }

 private:
  void choose_goal(const Vector3f& position);
  float between(float low, float high);

  std::minstd_rand bits_;
  float speed_ = 0;
  std::uint32_t steps_ = 0;
  std::uint32_t failed_rounds_ = 0;
  Vector3f goal_ = Vector3f::Zero();
  Vector3f round_start_ = Vector3f::Zero();
};

}  // namespace surehit::example
