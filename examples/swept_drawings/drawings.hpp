#pragma once

#include "picture/canvas.hpp"

namespace surehit::example {

// The drawings of the guide to moving shapes. Everything in them is what the library answers.

/// Balls fall onto a triangle: from above, which part each of them touches first, and from the side, some of them.
[[nodiscard]] Canvas draw_touched_features();

/// The floats around the time and the place of a contact, and which of them are free.
[[nodiscard]] Canvas draw_free_numbers();

/// A box and a capsule on their ways over a step and a ramp, from the side.
[[nodiscard]] Canvas draw_box_and_capsule();

}  // namespace surehit::example
