#pragma once

#include <surehit/collider.hpp>

#include "level/solid_builder.hpp"

namespace surehit::test {

/// A floor of 8 by 4, at z = 0, with a wall across x = 4 that has a door in 1 < y < 2.
[[nodiscard]] inline example::Mesh<float> level_with_a_door() {
  example::SolidBuilder builder(1);
  builder.add_box({0, 0, -1}, {8, 4, 0});
  builder.add_box({3.9f, 0, 0}, {4.1f, 1, 3});
  builder.add_box({3.9f, 2, 0}, {4.1f, 4, 3});
  return builder.take();
}

}  // namespace surehit::test
