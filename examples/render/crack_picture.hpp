#pragma once

#include <optional>

#include "mesh_io/mesh.hpp"
#include "picture/canvas.hpp"
#include "render/camera.hpp"

namespace surehit::example {

/// A vertex of a mesh, seen straight from above, and from so near that rounding shows.
///
/// All triangles at the vertex face upwards and lie around it, so each ray of the picture meets one of them. A ray that
/// meets none, or another triangle from behind, is a hole.
struct CrackView {
  std::uint32_t vertex = 0;
  CameraOptions camera;
  float width = 0;  ///< what the picture shows of the mesh, in the mesh's unit
};

/// Chooses a vertex that a closed mesh shows upwards, or checks the one that is given. Throws InputError, with a
/// reason, if there is none.
[[nodiscard]] CrackView find_crack_view(const Mesh<float>& mesh, std::optional<std::uint32_t> vertex, int size);

/// What the two tests made of the same rays.
struct Cracks {
  std::size_t rays = 0;
  std::size_t holes_of_plain = 0;
  std::size_t holes_of_surehit = 0;
  Canvas picture = Canvas(1, 1, {});  ///< plain test on the left, surehit on the right, holes in red
};

[[nodiscard]] Cracks draw_cracks(const Mesh<float>& mesh, const CrackView& view, unsigned threads);

}  // namespace surehit::example
