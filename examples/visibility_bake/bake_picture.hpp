#pragma once

#include <cstdint>

#include "picture/canvas.hpp"
#include "visibility_bake/pair_plan.hpp"
#include "visibility_bake/visibility.hpp"

namespace surehit::example {

/// Two plans from above, x to the right and y up: which share of the cells in its range each cell sees, and which cells
/// one of them sees. `shown` is this cell, which must be there.
[[nodiscard]] Canvas draw_bake(const PairPlan& plan, const Visibility& visibility, std::uint32_t shown);

}  // namespace surehit::example
