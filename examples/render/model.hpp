#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "mesh_io/mesh.hpp"

namespace surehit::example {

/// An amount of red, green and blue light. 1 is as bright as a picture gets.
using Light = Eigen::Array3f;

/// What a surface does with light.
struct Material {
  Light colour = Light::Constant(0.8f);
  /// The colour of every second square of a chess board, in texture coordinates whose unit is a square.
  Light second_colour = colour;
  float highlight = 0;  ///< The strength of Phong's highlight.
  int shininess = 50;   ///< The exponent of Phong's highlight.
  /// The share of light that a mirror reflects straight on. At grazing angles it is more. With 0, there is no mirror.
  float mirror = 0;
  bool is_glass = false;
  float refraction = 1.5f;  ///< The index of refraction of glass.
};

/// A mesh with what a renderer needs to know about it. What is empty is left out.
struct Model {
  Mesh<float> mesh;
  std::vector<std::array<Vector3f, 3>> normals;                     ///< Unit normals at the corners of each triangle.
  std::vector<std::array<Eigen::Vector2f, 3>> texture_coordinates;  ///< The same for texture coordinates.
  std::vector<std::uint8_t> material_ids;                           ///< The material of each triangle.
  std::vector<Material> materials = {Material{}};

  [[nodiscard]] const Material& material(std::uint32_t triangle) const {
    return materials[material_ids.empty() ? 0 : material_ids[triangle]];
  }
  /// Makes all vertices, triangles and materials of another model a part of this one. Both have normals, texture
  /// coordinates and material ids, or a part is without triangles.
  void append(const Model& other);
};

/// Gives each triangle of a model the same material.
void set_material(Model& model, const Material& material);

/// Interpolates what is given at the three corners of a triangle. u and v are the weights of corners b and c.
template <typename Value>
[[nodiscard]] Value interpolated(const std::array<Value, 3>& corners, float u, float v) {
  return (1 - u - v) * corners[0] + u * corners[1] + v * corners[2];
}

}  // namespace surehit::example
