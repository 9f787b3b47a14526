#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <surehit/executor.hpp>
#include <surehit/scene.hpp>
#include <vector>

#include "moving_platforms/hall.hpp"

namespace surehit::example {

/// How the scene knows that platforms move.
enum class Stepping : std::uint8_t {
  by_motion,  ///< Each has its motion during the step, and a path meets it on its way.
  by_pose,    ///< Each stands still during the step and then jumps, as is common in games.
};

/// A hall as a scene: the room, and an instance for each platform and each fan.
class HallScene {
 public:
  HallScene(const Hall& hall, Stepping stepping);

  /// Places all instances for the next step. The first step is step 0.
  void next_step(const std::optional<Executor>& executor);

  [[nodiscard]] const Scenef& scene() const { return scene_; }
  /// How the surface of an instance moves in a step, near a point of it. For a bounce.
  [[nodiscard]] Vector3f motion_at(InstanceId id, const Vector3f& point) const;

 private:
  const Hall& hall_;
  Stepping stepping_;
  Scenef scene_;
  std::uint32_t steps_begun_ = 0;
  std::vector<InstanceId> platforms_;
  std::vector<InstanceId> fans_;
  std::vector<FanTurn> turns_;
};

}  // namespace surehit::example
