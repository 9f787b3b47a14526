#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "mesh_io/mesh.hpp"

namespace surehit::example {

using Point = std::array<float, 3>;

/// Grows a mesh out of solids and surfaces, each cut into pieces with edges of about `edge`.
///
/// Triangles wind so that normals point out of solids. Only + - * / and sqrt are used. IEEE 754 rounds each of them in
/// one way, so every platform builds the same vertices to the bit.
class SolidBuilder {
 public:
  explicit SolidBuilder(float edge) : edge_(edge) {}

  /// The parallelogram origin + s u + t v with s and t in [0, 1]; its normal points along u × v.
  void add_parallelogram(const Point& origin, const Point& u, const Point& v);

  /// An axis-parallel box.
  void add_box(const Point& low, const Point& high);

  /// A box that stands on the ground, turned about the vertical so that its x axis points along (cosine, sine).
  void add_turned_box(const Point& base_centre, const Point& size, float cosine, float sine);

  /// An upright round solid: a cylinder, or a cone without its tip. Both radii are above 0.
  void add_round(const Point& base_centre, float height, float bottom_radius, float top_radius);

  /// A grid of (columns + 1) × (rows + 1) vertices, given row by row along x, with its normals up.
  void add_surface(const std::vector<Point>& vertices, std::uint32_t columns, std::uint32_t rows);

  [[nodiscard]] float edge() const { return edge_; }
  /// Pieces of a length that are about `edge` long, at least one.
  [[nodiscard]] std::uint32_t pieces(float length) const;
  [[nodiscard]] Mesh<float> take() { return std::move(mesh_); }

 private:
  std::uint32_t add_vertex(const Point& vertex);
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) { mesh_.triangles.push_back({a, b, c}); }
  /// The quads between vertices that were added row by row from `first` on.
  void add_quads(std::uint32_t first, std::uint32_t columns, std::uint32_t rows);
  /// Unit vectors in the plan, counterclockwise and evenly spaced.
  using Circle = std::vector<std::array<float, 2>>;
  /// As many directions as a round solid of this radius deserves.
  [[nodiscard]] Circle circle(float radius) const;
  void add_disc(const Circle& circle, const Point& centre, float radius, bool faces_up);

  float edge_;
  Mesh<float> mesh_;
};

}  // namespace surehit::example
