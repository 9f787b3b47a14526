#pragma once

#include <optional>
#include <string>
#include <surehit/box.hpp>
#include <vector>

#include "mesh_io/mesh.hpp"
#include "surface_points.hpp"

namespace surehit::benchmark {

/// A mesh with a name, and what paths through it are drawn from.
struct NamedMesh {
  /// How far above the floor a point is looked at, as a share of the diagonal.
  static constexpr double target_height = 0.005;

  std::string name;
  example::Mesh<float> mesh;
  int up = 2;  ///< axis
  Vector3d eye = {0, 0, 0};
  std::optional<Boxf> drawn_in = {};  ///< The box that paths are drawn in, if not the mesh's.
  double cell = 0;                    ///< The edge of the cubes that the mesh is made of, or 0.

  [[nodiscard]] Boxf box() const { return drawn_in ? *drawn_in : box_of(mesh.view()); }
  /// Returns false for a triangle outside the box that paths are drawn in.
  [[nodiscard]] bool draws_at(const Trianglef& triangle) const;
  [[nodiscard]] double diagonal() const;
  /// Where somebody could stand: of the triangles that look upward.
  [[nodiscard]] SurfacePoints floor() const;
  /// A vector of this length.
  [[nodiscard]] Vector3d upward(double length) const;
};

/// The built-in level, eye in its great hall.
[[nodiscard]] NamedMesh level_mesh(float detail);
/// The meshes in the folder by name: all, or those that are named. Throws InputError. An eye is a bit above some floor,
/// from where about half of the floors are in sight. The upward axis is z for meshes of `z_up`, and y for the others.
[[nodiscard]] std::vector<NamedMesh> meshes_in(const std::string& folder, const std::vector<std::string>& z_up,
                                               const std::vector<std::string>& names);

}  // namespace surehit::benchmark
