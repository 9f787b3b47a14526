#pragma once

#include <string>
#include <vector>

#include "line_of_sight/floor_plan.hpp"
#include "line_of_sight/sight.hpp"
#include "mesh_io/mesh.hpp"
#include "picture/canvas.hpp"

namespace surehit::example {

/// The plan from above, x to the right and y up: what is visible, what is hidden, the mesh as cut at the eye's height,
/// and the eye.
[[nodiscard]] Canvas draw_plan(const Mesh<float>& mesh, const FloorPlan& plan, const std::vector<Sight>& sights,
                               const Vector3f& eye, const std::string& caption);

}  // namespace surehit::example
