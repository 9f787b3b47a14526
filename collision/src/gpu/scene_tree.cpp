#include "gpu/scene_tree.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace surehit::detail {
namespace {

constexpr double max_gap = 0x1p-23;

/// Returns the largest float that is at most x.
float rounded_down(double x) {
  const auto nearest = static_cast<float>(x);
  return double{nearest} <= x ? nearest : std::nextafter(nearest, -std::numeric_limits<float>::infinity());
}
float rounded_up(double x) { return -rounded_down(-x); }

bool is_in_range(double entry) {
  const double size = std::fabs(entry);
  return entry == 0 || (size <= SceneTree::largest_entry && size >= 1 / SceneTree::largest_entry);
}

bool is_small(const Vector3f& x) { return x.cwiseAbs().maxCoeff() <= BoxTree::largest_coordinate; }

}  // namespace

const DeviceMesh* find_mesh(const std::vector<DeviceMesh>& meshes, const MeshVersions& versions) {
  const auto found =
      std::lower_bound(meshes.begin(), meshes.end(), versions,
                       [](const DeviceMesh& mesh, const MeshVersions& wanted) { return mesh.versions < wanted; });
  return found == meshes.end() || found->versions != versions ? nullptr : &*found;
}

DeviceInstance device_instance(const PlacedInstance<float>& placed, const Box<float>& mesh_box) {
  const auto& [pose, motion, moves] = placed.placement;
  const InstanceFrame& frame = placed.frame;
  DeviceInstance result = {};
  result.flags = frame.is_mirrored ? DeviceInstance::is_mirrored : 0;
  result.reach = std::max(mesh_box.low.cwiseAbs().maxCoeff(), mesh_box.high.cwiseAbs().maxCoeff());
  bool is_on_device = frame.is_usable && is_small(pose.translation) && is_small(motion);
  for (std::size_t row = 0; row < 3; ++row) {
    const auto i = static_cast<Eigen::Index>(row);
    for (std::size_t column = 0; column < 3; ++column) {
      const float entry = pose.linear(i, static_cast<Eigen::Index>(column));
      const double inverse = frame.inverse[column][row];
      is_on_device &= is_in_range(double{entry}) && is_in_range(inverse);
      result.linear[3 * row + column] = entry;
      result.inverse[3 * row + column] = static_cast<float>(inverse);
    }
    result.translation[row] = pose.translation[i];
    result.motion[row] = moves ? motion[i] : 0;
  }
  result.share = rounded_up(frame.largest_row_size * max_gap);
  if (!is_on_device) result.flags |= DeviceInstance::is_left_to_host;
  return result;
}

SceneTree::SceneTree(const CommittedScene<float>& scene, const std::vector<DeviceMesh>& meshes) {
  std::vector<ItemBox> boxes;
  std::vector<std::uint32_t> indices;
  for (std::uint32_t index = 0; index < scene.instances.size(); ++index) {
    const CommittedInstance<float>& instance = scene.instances[index];
    if (!instance.is_in_tree || instance.mask == 0) continue;
    const InstanceBox box = instance.box();
    ItemBox rounded;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!(box.low[axis] >= -BoxTree::largest_coordinate && box.high[axis] <= BoxTree::largest_coordinate)) return;
      rounded.low[axis] = rounded_down(box.low[axis]);
      rounded.high[axis] = rounded_up(box.high[axis]);
    }
    boxes.push_back(rounded);
    indices.push_back(index);
  }
  BoxTree tree(boxes, 1);
  for (TreeNode& node : tree.nodes) {
    if (node.count == 0) node.first |= in_scene;
  }
  for (const std::uint32_t item : tree.items) {
    const CommittedInstance<float>& instance = scene.instances[indices[item]];
    DeviceInstance& added = instances.emplace_back(device_instance(instance.placed, instance.mesh.own->box));
    added.root = find_mesh(meshes, versions_of(*instance.mesh.own))->root;
    added.mask = instance.mask;
    added.index = indices[item];
    if (added.root == DeviceMesh::no_root) added.flags |= DeviceInstance::is_left_to_host;
  }
  nodes = std::move(tree.nodes);
}

}  // namespace surehit::detail
