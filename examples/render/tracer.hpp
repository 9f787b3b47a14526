#pragma once

#include <span>

#include "render/ray_counts.hpp"
#include "render/stage.hpp"
#include "render/world.hpp"

namespace surehit::example {

/// Casts rays in the manner of Whitted (1980), "An Improved Illumination Model for Shaded Display".
///
/// All rays of some pixels go through the world in waves. The rays of a wave are a batch, and so are their ways to the
/// lamps. What they reflect and refract is the next wave.
class Tracer {
 public:
  /// A ray that has been reflected or refracted `max_depth` times sees the background. All arguments must outlive this.
  Tracer(const World& world, const Stage& stage, int max_depth) : world_(world), stage_(stage), max_depth_(max_depth) {}

  /// Sets `lights[i]` to the light that primary ray i sees. The answer for a ray does not depend on the others. Adds to
  /// `counts`.
  void trace(std::span<const Rayf> primary, std::span<Light> lights, RayCounts& counts) const;

 private:
  const World& world_;
  const Stage& stage_;
  int max_depth_;
};

}  // namespace surehit::example
