#pragma once

#include "picture/canvas.hpp"
#include "surehit_query/explanation_drawing.hpp"

namespace surehit::example {

/// Returns a picture of the drawing, seen from aside, with all of the mesh dimly behind it. The path goes from left to
/// right. `direction` is that of the path.
template <typename Scalar>
[[nodiscard]] Canvas picture_of(const Drawing& drawing, const Collider<Scalar>& mesh, const Vector3d& direction);

}  // namespace surehit::example
