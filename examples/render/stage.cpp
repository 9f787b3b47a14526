#include "render/stage.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "level/level.hpp"
#include "render/corner_normals.hpp"
#include "render/shapes.hpp"

namespace surehit::example {
namespace {

/// The floors of the level are of polished stone. All else is plaster.
void paint_level(Model& model) {
  model.materials = {{.colour = {0.80f, 0.76f, 0.68f}, .second_colour = {0.80f, 0.76f, 0.68f}},
                     {.colour = {0.46f, 0.33f, 0.24f}, .second_colour = {0.56f, 0.42f, 0.30f}, .mirror = 0.06f}};
  const TriangleMeshViewf view = model.mesh.view();
  for (std::uint32_t i = 0; i < model.mesh.triangles.size(); ++i) {
    const Trianglef triangle = view.triangle(i);
    const bool is_floor = triangle.a.z() == 0 && triangle.b.z() == 0 && triangle.c.z() == 0;
    model.material_ids.push_back(is_floor ? 1 : 0);
    const auto in_plan = [](const Vector3f& corner) { return Eigen::Vector2f(corner.head<2>()); };
    model.texture_coordinates.push_back({in_plan(triangle.a), in_plan(triangle.b), in_plan(triangle.c)});
  }
}

/// Texture coordinates of a mesh that has one colour.
std::vector<std::array<Eigen::Vector2f, 3>> plain_texture(const Mesh<float>& mesh) {
  const Eigen::Vector2f zero = Eigen::Vector2f::Zero();
  return std::vector<std::array<Eigen::Vector2f, 3>>(mesh.triangles.size(), {zero, zero, zero});
}

}  // namespace

Stage exercise_stage() {
  Stage stage;
  Model floor = chess_board({0, 0, 0}, 200, 200);
  set_material(floor, {.colour = {0.85f, 0.85f, 0.82f}, .second_colour = {0.12f, 0.14f, 0.18f}, .mirror = 0.05f});
  Model glass = tessellated_sphere({-1.15f, -1.1f, 1.2f}, 1.2f, 6);
  set_material(glass, {.highlight = 0.8f, .shininess = 400, .is_glass = true});
  Model diffuse = tessellated_sphere({1.35f, 1.2f, 1.5f}, 1.5f, 6);
  set_material(diffuse, {.colour = {0.78f, 0.20f, 0.14f}, .highlight = 0.35f, .shininess = 60});
  stage.model.append(floor);
  stage.model.append(glass);
  stage.model.append(diffuse);
  stage.lamps = {{{-6, -7, 10}, Light(0.75f, 0.73f, 0.68f)}, {{8, -4, 7}, Light(0.18f, 0.2f, 0.26f)}};
  stage.horizon = {0.80f, 0.87f, 0.94f};
  stage.zenith = {0.16f, 0.32f, 0.62f};
  stage.eye = {-0.9f, -8.6f, 2.6f};
  stage.target = {0.1f, 0, 1.15f};
  stage.degrees = 36;
  return stage;
}

Stage level_stage() {
  Stage stage;
  Level level = build_level();
  stage.model.mesh = std::move(level.mesh);
  paint_level(stage.model);
  stage.model.normals = corner_normals(stage.model.mesh);
  stage.lamps = {{{37.5f, 25.5f, 3.5f}, Light(0.72f, 0.64f, 0.50f)}, {{30, 19.5f, 2.5f}, Light(0.20f, 0.25f, 0.33f)}};
  stage.ambient = Light(0.15f, 0.155f, 0.17f);
  stage.horizon = {0.72f, 0.82f, 0.92f};
  stage.zenith = {0.28f, 0.46f, 0.75f};
  stage.eye = {39.2f, 18.6f, level.eye[2]};
  stage.target = {35.9f, 31, 1.6f};
  stage.degrees = 58;
  return stage;
}

Stage stage_of(Mesh<float> mesh, const ShowOptions& options) {
  Stage stage;
  const Boxf box = box_of(mesh.view());
  const Vector3f middle = box.is_empty() ? Vector3f(0, 0, 0) : Vector3f(box.low / 2 + box.high / 2);
  const float radius = box.is_empty() ? 1 : std::max((box.high / 2 - box.low / 2).norm(), 1e-30f);
  Model shown;
  shown.mesh = std::move(mesh);
  shown.normals = corner_normals(shown.mesh);
  shown.texture_coordinates = plain_texture(shown.mesh);
  set_material(shown, options.material);
  stage.model.append(shown);
  if (options.has_floor && !box.is_empty()) {
    Model floor = chess_board({middle.x(), middle.y(), box.low.z()}, 60 * radius, 120);
    set_material(floor, {.colour = {0.78f, 0.78f, 0.76f}, .second_colour = {0.42f, 0.45f, 0.50f}, .mirror = 0.03f});
    stage.model.append(floor);
  }
  if (!options.is_smooth) stage.model.normals.clear();
  const Vector3f view(0.45f, -0.85f, 0.4f);
  constexpr float distance = 3.2f;  // in radii: all of a ball is in the view
  stage.target = middle;
  stage.eye = middle + distance * radius * (view / view.norm());
  stage.degrees = 36;
  stage.lamps = {{middle + radius * Vector3f(-3, -4, 6), Light(0.75f, 0.73f, 0.68f)},
                 {middle + radius * Vector3f(5, -3, 4), Light(0.18f, 0.2f, 0.26f)}};
  stage.horizon = {0.80f, 0.87f, 0.94f};
  stage.zenith = {0.16f, 0.32f, 0.62f};
  return stage;
}

Light background(const Stage& stage, const Vector3f& direction) {
  const float upward = std::clamp(direction.z() / direction.norm(), 0.0f, 1.0f);
  return stage.horizon + std::sqrt(upward) * (stage.zenith - stage.horizon);
}

}  // namespace surehit::example
