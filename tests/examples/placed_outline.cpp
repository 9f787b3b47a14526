#include "placed_outline.hpp"

#include <cstddef>

namespace surehit::test {

Plane draw_axis_plane(Random& random) {
  Plane plane{};
  const std::size_t axis = random.below(3);
  const std::size_t turned = random.below(2);
  plane.u[(axis + 1 + turned) % 3] = random.one_in(2) ? 1 : -1;
  plane.v[(axis + 2 - turned) % 3] = 1;
  plane.origin[axis] = static_cast<double>(random.between(-3, 3));
  return plane;
}

Plane draw_whole_plane(Random& random) {
  for (;;) {
    Plane plane;
    for (std::size_t i = 0; i < 3; ++i) {
      plane.u[i] = static_cast<double>(random.between(-5, 5));
      plane.v[i] = static_cast<double>(random.between(-5, 5));
      plane.origin[i] = static_cast<double>(random.between(-50, 50));
    }
    if (length_of(plane.normal()) != 0) return plane;
  }
}

Plane draw_plane(Random& random) {
  for (;;) {
    Plane plane;
    for (std::size_t i = 0; i < 3; ++i) {
      plane.u[i] = random.symmetric<double>();
      plane.v[i] = random.symmetric<double>();
      plane.origin[i] = 10 * random.symmetric<double>();
    }
    if (length_of(plane.normal()) > 0.5) return plane;
  }
}

}  // namespace surehit::test
