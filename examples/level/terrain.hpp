#pragma once

#include "level/solid_builder.hpp"

namespace surehit::example {

/// Rolling ground around a level plateau.
class Terrain {
 public:
  /// Ground over the plan from `low` to `high`, at `plateau_height` within the plateau and near it.
  Terrain(const std::array<float, 2>& low, const std::array<float, 2>& high, const std::array<float, 2>& plateau_low,
          const std::array<float, 2>& plateau_high, float plateau_height);

  [[nodiscard]] float height_at(float x, float y) const;
  /// The heightfield of height_at.
  void add_to(SolidBuilder& builder) const;

 private:
  std::array<float, 2> low_;
  std::array<float, 2> high_;
  std::array<float, 2> plateau_low_;
  std::array<float, 2> plateau_high_;
  float plateau_height_;
};

}  // namespace surehit::example
