#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "gpu/box_tree.hpp"
#include "scene/committed_scene.hpp"

namespace surehit::detail {

/// An instance, as `tree_walk.comp` reads it. `placed_path.glsl` says what the members are.
struct DeviceInstance {
  std::array<float, 9> inverse, linear;
  std::array<float, 3> translation, motion;
  float share, reach;
  std::uint32_t root, mask, index, flags;

  static constexpr std::uint32_t is_mirrored = 1;
  static constexpr std::uint32_t is_left_to_host = 2;  ///< A path that meets its box is undecided.
};
static_assert(sizeof(DeviceInstance) == 120);

/// The version of a collider, and that of its masks. No two meshes have the same ones, but a collider and its copies
/// do.
using MeshVersions = std::pair<std::uint64_t, std::uint64_t>;

/// What is on a device of a mesh that instances share.
struct DeviceMesh {
  MeshVersions versions;
  /// The root of its tree. It is `no_root` if the device has none, because a coordinate is too large.
  std::uint32_t root;

  static constexpr std::uint32_t no_root = ~std::uint32_t{0};
};

/// A tree of boxes around the instances of a scene, which are rounded outward.
struct SceneTree {
  /// The numbers of its nodes have this bit, and those of the meshes do not.
  static constexpr std::uint32_t in_scene = std::uint32_t{1} << 31;
  /// No entry of a matrix or of its inverse is larger on the device. None but 0 is smaller than its inverse (G15).
  static constexpr double largest_entry = 0x1p30;

  SceneTree() = default;
  /// Builds the tree of a scene. It is empty if the scene is, or if an instance is too far away. Each mesh of the scene
  /// is among `meshes`, which are sorted. May throw std::bad_alloc.
  SceneTree(const CommittedScene<float>& scene, const std::vector<DeviceMesh>& meshes);

  std::vector<TreeNode> nodes;            ///< The root comes first.
  std::vector<DeviceInstance> instances;  ///< One for each leaf.
};

/// Returns a placed instance as a device sees it, without its mesh and its mask. It may be left to the host (G15).
[[nodiscard]] DeviceInstance device_instance(const PlacedInstance<float>& placed, const Box<float>& mesh_box);

[[nodiscard]] inline MeshVersions versions_of(const ColliderState<float>& collider) {
  return {collider.version, collider.mask_version};
}

/// Returns the mesh of these versions among `meshes`, or null. They are sorted by their versions.
[[nodiscard]] const DeviceMesh* find_mesh(const std::vector<DeviceMesh>& meshes, const MeshVersions& versions);

}  // namespace surehit::detail
