#pragma once

#include <array>
#include <vector>

#include "walk/grid_traversal.hpp"

namespace surehit::test {

/// `detail::LaneWalk::can_enter_crossings` on the instruction set that is chosen at the moment.
[[nodiscard]] bool can_enter_crossings();

/// The cells in which `detail::LaneWalk` stands there, of a path from some tau on: their low corners, as the path is
/// mirrored.
[[nodiscard]] std::vector<std::array<float, 3>> cells_of(const Grid& grid, const ClippedPath& path, float enters);

}  // namespace surehit::test
