#pragma once

#include <array>
#include <cstdint>

#include "level/solid_builder.hpp"

namespace surehit::example {

/// The inside of a box with nothing in it, each side cut into cells. Closed: neighbouring triangles share their
/// vertices, every edge has two triangles, and normals point inwards.
[[nodiscard]] Mesh<float> build_room(const Point& low, const Point& high, const std::array<std::uint32_t, 3>& cells);

}  // namespace surehit::example
