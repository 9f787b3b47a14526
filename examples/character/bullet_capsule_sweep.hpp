#pragma once

#include <memory>

#include "character/capsule_sweep.hpp"
#include "mesh_io/mesh.hpp"

namespace surehit::example {

struct BulletOptions {
  float margin = 0;    ///< Triangles are as thick as this on each side. Bullet's own default is 0.04.
  float skin = 1e-3f;  ///< A stop is pushed off the surface by so many metres along the normal, as is common.
};

/// Asks Bullet's convex sweep, for contrast. The mesh must outlive it. Returns null if the program was built without
/// Bullet.
[[nodiscard]] std::unique_ptr<const CapsuleSweep> make_bullet_capsule_sweep(const Mesh<float>& mesh,
                                                                            const BulletOptions& options);

}  // namespace surehit::example
