#pragma once

#include "game_physics/arena.hpp"
#include "game_physics/trial.hpp"
#include "picture/canvas.hpp"

namespace surehit::example {

/// The room as seen from the front and a little from above, twice: how points fly with the library, and where points
/// went through walls without it.
[[nodiscard]] Canvas draw_trials(const Arena& arena, const TrialReport& exact, const TrialReport& with_epsilon);

}  // namespace surehit::example
