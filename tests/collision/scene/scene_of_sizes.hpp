#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "support/random.hpp"
#include "support/scene_drawer.hpp"
#include "surehit/box.hpp"
#include "surehit/path.hpp"

namespace surehit::test {

/// Draws a scene whose instances overlap in clusters, turned in any direction. Each octave of sizes from 1 to 2^20 has
/// as many, and so has each octave of the clusters' sizes.
template <typename Scalar>
[[nodiscard]] DrawnScene<Scalar> draw_scene_of_sizes(std::size_t count, Random& random) {
  constexpr double width = 4e6;
  constexpr std::size_t per_cluster = 25;
  const auto draw_size = [&] {
    const auto octave = static_cast<int>(random.below(20));
    return std::ldexp(1 + random.unit<double>(), octave);
  };
  const auto draw_in_cube = [&] {
    const double x = random.symmetric<double>() / 2;
    const double y = random.symmetric<double>() / 2;
    return Vector3<double>(x, y, random.symmetric<double>() / 2);
  };
  using Corners = std::vector<Vector3<double>>;
  using Triangles = std::vector<std::array<std::uint32_t, 3>>;
  const Corners of_tetrahedron = {{-0.5, -0.5, -0.5}, {0.5, 0.5, -0.5}, {0.5, -0.5, 0.5}, {-0.5, 0.5, 0.5}};
  const Triangles around_tetrahedron = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
  const Corners of_octahedron = {{0.5, 0, 0}, {-0.5, 0, 0}, {0, 0.5, 0}, {0, -0.5, 0}, {0, 0, 0.5}, {0, 0, -0.5}};
  const Triangles around_octahedron = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                       {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  DrawnScene<Scalar> scene;
  const auto add = [&](const Corners& corners, const Triangles& triangles, bool is_float) {
    DrawnMesh& mesh = scene.meshes.emplace_back();
    mesh.is_float = is_float;
    mesh.vertices = corners;
    mesh.triangles = triangles;
  };
  for (const bool is_float : {true, std::is_same_v<Scalar, float>}) {
    add(of_tetrahedron, around_tetrahedron, is_float);
    add(of_octahedron, around_octahedron, is_float);
  }

  struct Cluster {
    Vector3<double> centre;
    double size;
  };
  std::vector<Cluster> clusters;
  while (clusters.size() * per_cluster < count) {
    const Vector3<double> centre = width * draw_in_cube();
    clusters.push_back({centre, draw_size()});
  }
  while (scene.instances.size() < count) {
    const Cluster& cluster = clusters[random.below(clusters.size())];
    const double size = draw_size();
    Pose<Scalar> pose = draw_pose<Scalar>(SceneFamily::rotations, random);
    pose.linear *= static_cast<Scalar>(size);
    pose.translation = rounded<Scalar>(cluster.centre + (cluster.size + size) * draw_in_cube());
    scene.instances.push_back({random.below(scene.meshes.size()), {pose}});
  }
  return scene;
}

/// Returns a box around an instance, computed in double.
template <typename Scalar>
[[nodiscard]] Box<double> box_of_instance(const DrawnScene<Scalar>& scene, std::size_t instance) {
  const auto& [mesh, placement] = scene.instances[instance];
  Box<double> box;
  for (const Vector3<double>& vertex : scene.meshes[mesh].vertices) {
    box.extend(placement.pose.linear.template cast<double>() * vertex +
               placement.pose.translation.template cast<double>());
  }
  return box;
}

/// Draws paths that begin in the box of an instance. Half of them are about as long as it, and the others end in that
/// of another one. Instances of all sizes count alike.
template <typename Scalar>
[[nodiscard]] std::vector<Segment<Scalar>> draw_paths_of_sizes(const DrawnScene<Scalar>& scene, std::size_t count,
                                                               Random& random) {
  const auto draw_in = [&](const Box<double>& box) {
    Vector3<double> point = box.low;
    for (Eigen::Index axis = 0; axis < 3; ++axis) point[axis] += random.unit<double>() * (box.high - box.low)[axis];
    return rounded<Scalar>(point);
  };
  const auto any_box = [&] { return box_of_instance(scene, random.below(scene.instances.size())); };
  std::vector<Segment<Scalar>> paths;
  while (paths.size() < count) {
    const Box<double> box = any_box();
    const Vector3<Scalar> start = draw_in(box);
    paths.push_back({start, draw_in(paths.size() % 2 == 0 ? box : any_box())});
  }
  return paths;
}

}  // namespace surehit::test
