#pragma once

#include <surehit/box.hpp>
#include <vector>

#include "render/camera.hpp"
#include "render/model.hpp"

namespace surehit::example {

/// A lamp without extent, so its shadows are hard.
struct Lamp {
  Vector3f position;
  Light light;  ///< arrives at any distance
};

/// What is rendered, and from where.
struct Stage {
  Model model;
  std::vector<Lamp> lamps;
  Light ambient = Light::Constant(0.1f);  ///< arrives everywhere
  Light horizon = Light::Constant(0.9f);  ///< the background straight ahead
  Light zenith = Light::Constant(0.5f);   ///< the background upwards
  Vector3f eye = {0, 0, 0};
  Vector3f target = {0, 1, 0};
  float degrees = 45;  ///< the angle of view from top to bottom
};

/// The classic exercise: a sphere of glass and a diffuse one on the squares of a floor.
[[nodiscard]] Stage exercise_stage();

/// The great hall of the built-in level.
[[nodiscard]] Stage level_stage();

/// How a mesh from a file is shown.
struct ShowOptions {
  Material material = {.colour = {0.76f, 0.72f, 0.66f}, .highlight = 0.15f, .shininess = 40};
  bool is_smooth = true;  ///< Normals are interpolated where the mesh has no sharp edge.
  bool has_floor = true;  ///< The mesh is on a floor of squares, whose triangles have the ids behind its own.
};

/// A mesh with z up, seen from the front and from above.
[[nodiscard]] Stage stage_of(Mesh<float> mesh, const ShowOptions& options = {});

/// The light that comes from far away.
[[nodiscard]] Light background(const Stage& stage, const Vector3f& direction);

}  // namespace surehit::example
