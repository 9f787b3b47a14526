#pragma once

#include "level/solid_builder.hpp"

namespace surehit::example {

struct LevelOptions {
  /// Edges are about 1/detail times as long as in the level as it is meant. So the number of triangles grows with the
  /// square of detail: about 1,000 at 0.01, 93,000 at 1 and 10,000,000 at 11. Below 0.2 the furniture, windows and
  /// railings, which would not get any coarser, are left out.
  float detail = 1;
};

/// A house with a great hall, a gallery above its stairs, a corridor, rooms and a terrace, in the hills. Metres, z up;
/// floors of the house lie at z = 0.
struct Level {
  Mesh<float> mesh;
  Point eye;  ///< of somebody who stands in the great hall
};

/// The same bits on every platform. Solids lie before the floors that they stand on, so that of two triangles at the
/// same height a first hit reports the solid's.
[[nodiscard]] Level build_level(const LevelOptions& options = {});

}  // namespace surehit::example
