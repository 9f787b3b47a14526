#pragma once

#include <surehit/box.hpp>

#include "mesh_io/mesh.hpp"

namespace surehit::example {

/// A closed room full of obstacles without thickness: bent slats that lie across it and end on its front and its back
/// wall.
///
/// All of it lies in [32, 64] on each axis, where every float is a multiple of 2^-18. So an exact check of its walls
/// takes short integers. Corners lie on multiples of 1/8, walls at all angles.
struct Arena {
  Boxf room;
  Mesh<float> walls;  ///< the room's twelve triangles first, normals inwards
};

[[nodiscard]] Arena build_arena();

}  // namespace surehit::example
