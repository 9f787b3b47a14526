#pragma once

#include "render/model.hpp"

namespace surehit::example {

/// A sphere of 20 · 4^divisions triangles: an icosahedron whose edges are halved again and again. Its vertices are on
/// the sphere, but for rounding. The mesh is closed, and its normals point outwards.
[[nodiscard]] Model tessellated_sphere(const Vector3f& centre, float radius, int divisions);

/// A level square around a point. It has `squares` · `squares` squares of two triangles
/// each. The unit of the texture coordinates is one square. Its normal points up.
[[nodiscard]] Model chess_board(const Vector3f& centre, float width, int squares);

}  // namespace surehit::example
