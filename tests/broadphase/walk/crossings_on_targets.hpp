#pragma once

#include <array>
#include <vector>

#include "walk/grid_traversal.hpp"

namespace surehit::test {

/// `detail::LaneWalk::can_enter_crossings` on the instruction set that is chosen at the moment.
[[nodiscard]] bool can_enter_crossings();

/// Returns the cells that `detail::LaneWalk` is in at once there, for a path from tau `enters` on. They are given by
/// their low corners, mirrored like the path.
[[nodiscard]] std::vector<std::array<float, 3>> cells_of(const Grid& grid, const ClippedPath& path, float enters);

}  // namespace surehit::test
