#pragma once

#include <surehit/path.hpp>
#include <surehit/pose.hpp>

#include "mesh_io/mesh.hpp"

namespace surehit::example {

/// Four thin, tilted blades that turn about an axis along y.
///
/// A scene lets instances translate during a step, but not turn. So a fan turns between two steps.
struct Fan {
  Vector3f centre;
  float radius;
  float half_turn;  ///< the tangent of half of the angle that it turns in a step

  /// The blades about the origin.
  [[nodiscard]] Mesh<float> mesh() const;
  /// The way that a point of a blade goes in a step, if it goes straight.
  [[nodiscard]] Vector3f motion_at(const Vector3f& point) const;
};

/// How far a fan has turned. Only + - * / and sqrt are used, so every platform turns to the same bits.
class FanTurn {
 public:
  void advance(const Fan& fan);
  [[nodiscard]] Posef pose(const Fan& fan) const { return Posef::rigid({0, sine_, 0, cosine_}, fan.centre); }

 private:
  float cosine_ = 1;  ///< of half of the angle
  float sine_ = 0;
};

}  // namespace surehit::example
