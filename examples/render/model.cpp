#include "render/model.hpp"

namespace surehit::example {

void Model::append(const Model& other) {
  if (mesh.triangles.empty()) materials.clear();
  const auto first_vertex = static_cast<std::uint32_t>(mesh.vertices.size());
  const auto first_material = static_cast<std::uint8_t>(materials.size());
  const auto add_all = [](auto& all, const auto& more) { all.insert(all.end(), more.begin(), more.end()); };
  add_all(mesh.vertices, other.mesh.vertices);
  for (const auto& [a, b, c] : other.mesh.triangles) {
    mesh.triangles.push_back({a + first_vertex, b + first_vertex, c + first_vertex});
  }
  add_all(normals, other.normals);
  add_all(texture_coordinates, other.texture_coordinates);
  for (const std::uint8_t id : other.material_ids) {
    material_ids.push_back(static_cast<std::uint8_t>(first_material + id));
  }
  add_all(materials, other.materials);
}

void set_material(Model& model, const Material& material) {
  model.materials = {material};
  model.material_ids.assign(model.mesh.triangles.size(), 0);
}

}  // namespace surehit::example
