#pragma once

#include <cstddef>
#include <string>
#include <surehit/box.hpp>
#include <surehit/pose.hpp>
#include <vector>

#include "mesh_io/mesh.hpp"
#include "surface_points.hpp"

namespace surehit::benchmark {

/// A mesh of a world, at a pose.
struct PlacedMesh {
  std::size_t mesh;  ///< its index among the meshes
  Posef pose;
};

/// Meshes that are placed many times, and what paths through them are drawn from.
struct World {
  std::string name;
  std::vector<example::Mesh<float>> meshes;
  std::vector<PlacedMesh> instances;
  Vector3d eye = {0, 0, 0};
  bool has_details = false;  ///< True if paths are drawn about small instances too.

  /// Returns the number of placed triangles.
  [[nodiscard]] std::size_t triangle_count() const;
  /// Returns a box around all instances, computed in double.
  [[nodiscard]] Box<double> box() const;
};

/// Returns where a pose places a point, computed in double.
[[nodiscard]] Vector3d placed(const Posef& pose, const Vector3d& point);
/// Returns the box of a placed box.
[[nodiscard]] Box<double> placed(const Posef& pose, const Boxf& box);

/// Names the worlds that are built here.
[[nodiscard]] std::vector<std::string> world_names();
/// Builds the world of that name. `detail` is 1, or less for a quick look. Has the same bits on every platform.
[[nodiscard]] World build_world(const std::string& name, float detail);

/// Returns the poses of all instances after a step in which each has moved and turned a bit.
[[nodiscard]] std::vector<Posef> moved_poses(const World& world, std::uint64_t seed);

}  // namespace surehit::benchmark
