#include "surehit/gpu_scene.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "gpu/gpu_batch.hpp"
#include "gpu/gpu_buffer_batch.hpp"
#include "gpu/gpu_scene_state.hpp"
#include "gpu/scene_tree.hpp"
#include "gpu/triangle_tree.hpp"
#include "support/floating_point_environment.hpp"

namespace surehit {
namespace {

using detail::ColliderState;
using detail::CommittedScene;
using detail::DeviceMesh;
using detail::GpuDeviceState;
using detail::GpuSceneState;
using detail::UploadedCollider;

/// The trees of some meshes, one after the other.
struct JoinedTrees {
  /// Adds the tree of a collider. Returns where its root is.
  std::uint32_t add(const Colliderf& collider) {
    const detail::TriangleTree tree(collider);
    if (tree.nodes.empty()) return DeviceMesh::no_root;
    const auto root = static_cast<std::uint32_t>(nodes.size());
    const auto first_triangle = static_cast<std::uint32_t>(triangles.size());
    for (detail::TreeNode node : tree.nodes) {
      node.first += node.count == 0 ? root : first_triangle;
      nodes.push_back(node);
    }
    triangles.insert(triangles.end(), tree.triangles.begin(), tree.triangles.end());
    return root;
  }

  std::vector<detail::TreeNode> nodes;
  std::vector<detail::TreeTriangle> triangles;
};

/// Sets `colliders` to those of all instances that have triangles, sorted by their versions and each once. Returns
/// false if one has another mesh than the scene has seen.
bool find_colliders(const CommittedScene<float>& scene, std::vector<UploadedCollider>& colliders) {
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const detail::CommittedInstance<float>& instance = scene.instances[i];
    if (!instance.is_in_tree) continue;
    const auto* const collider = static_cast<const Colliderf*>(scene.kept[i].collider.get());
    const ColliderState<float>& now = ColliderState<float>::of(*collider);
    if (&now != instance.mesh.own || now.version != instance.mesh.version) return false;
    colliders.push_back({collider, &now, detail::versions_of(now)});
  }
  const auto key = [](const UploadedCollider& one) { return std::pair(one.versions, one.collider); };
  std::sort(colliders.begin(), colliders.end(), [&](const auto& x, const auto& y) { return key(x) < key(y); });
  colliders.erase(std::unique(colliders.begin(), colliders.end(),
                              [](const auto& x, const auto& y) { return x.collider == y.collider; }),
                  colliders.end());
  return true;
}

/// Uploads a scene. Meshes that `before` has on the same device are not uploaded again.
GpuResult upload(const std::shared_ptr<GpuDeviceState>& device, const SceneSnapshotf& scene,
                 const GpuSceneState* before, std::shared_ptr<GpuSceneState>& result) {
  const FloatingPointEnvironment environment;
  auto state = std::make_shared<GpuSceneState>();
  state->device = device;
  state->scene = scene;
  const CommittedScene<float>& committed = state->committed();
  if (!find_colliders(committed, state->colliders)) {
    return GpuError(GpuError::Reason::not_updated, "a collider was rebuilt since the scene was committed");
  }
  const bool keeps_meshes =
      before != nullptr && std::all_of(state->colliders.begin(), state->colliders.end(), [&](const auto& one) {
        return detail::find_mesh(before->meshes, one.versions) != nullptr;
      });
  JoinedTrees trees;
  if (keeps_meshes) {
    state->meshes = before->meshes;
    state->mesh->nodes = before->mesh->nodes;
    state->mesh->triangles = before->mesh->triangles;
  } else {
    for (const UploadedCollider& one : state->colliders) {
      if (!state->meshes.empty() && state->meshes.back().versions == one.versions) continue;  // A copy has the same.
      state->meshes.push_back({one.versions, trees.add(*one.collider)});
    }
  }
  const detail::SceneTree tree(committed, state->meshes);
  state->is_on_device = !tree.nodes.empty();
  detail::GpuMesh& mesh = *state->mesh;
  detail::GpuWork work(*device);
  if (auto error = work.begin(state->mesh)) return *error;
  if (auto error = device->prepare_scenes()) return *error;
  if (!keeps_meshes) {
    if (auto error = work.upload(std::as_bytes(std::span(trees.nodes)), "the nodes of meshes", *mesh.nodes)) {
      return *error;
    }
    if (auto error =
            work.upload(std::as_bytes(std::span(trees.triangles)), "the triangles of meshes", *mesh.triangles)) {
      return *error;
    }
  }
  if (auto error = work.upload(std::as_bytes(std::span(tree.nodes)), "the nodes of a scene", mesh.scene_nodes)) {
    return *error;
  }
  if (auto error = work.upload(std::as_bytes(std::span(tree.instances)), "the instances of a scene", mesh.instances)) {
    return *error;
  }
  result = std::move(state);
  return {};
}

/// Runs a batch of this class, unless a collider has changed since the scene was uploaded.
template <typename Batch, typename Paths, typename Answers>
GpuBatchResult run(const GpuSceneState* state, const Paths& paths, const Answers& answers,
                   const SceneBatchOptionsf& options, const GpuBatchOptions& gpu) {
  const FloatingPointEnvironment environment;
  GpuBatchResult refused;
  if (state == nullptr) {
    refused.error = GpuError(GpuError::Reason::not_updated, "no scene was uploaded");
    return refused;
  }
  for (const UploadedCollider& one : state->colliders) {
    if (!one.has_changed()) continue;
    refused.error = GpuError(GpuError::Reason::not_updated,
                             "a collider was rebuilt or has other masks since the scene was uploaded; update it first");
    return refused;
  }
  return Batch(*state, paths, answers, options, gpu).run();
}

}  // namespace

GpuResult GpuScene::try_upload(const GpuDevice& device, const SceneSnapshotf& scene) {
  if (!device.is_open()) return GpuError(GpuError::Reason::no_device, "the device is not open");
  return upload(GpuDeviceState::of(device), scene, nullptr, state_);
}

GpuResult GpuScene::try_update(const SceneSnapshotf& scene) {
  if (state_ == nullptr) return GpuError(GpuError::Reason::not_updated, "no scene was uploaded");
  return upload(state_->device, scene, state_.get(), state_);
}

GpuBatchResult GpuScene::first_hits(const PathSpanf& paths, std::span<SceneHitf> hits,
                                    const SceneBatchOptionsf& options, const GpuBatchOptions& gpu) const {
  return run<detail::GpuBatch<GpuSceneState, SceneHitf>>(state_.get(), paths, hits, options, gpu);
}

GpuBatchResult GpuScene::any_hits(const PathSpanf& paths, std::span<std::uint8_t> blocked,
                                  const SceneBatchOptionsf& options, const GpuBatchOptions& gpu) const {
  return run<detail::GpuBatch<GpuSceneState, std::uint8_t>>(state_.get(), paths, blocked, options, gpu);
}

GpuBatchResult GpuScene::first_hits(const GpuPaths& paths, const GpuBufferPart& hits, const SceneBatchOptionsf& options,
                                    const GpuBatchOptions& gpu) const {
  return run<detail::GpuBufferBatch<GpuSceneState, SceneHitf>>(state_.get(), paths, hits, options, gpu);
}

GpuBatchResult GpuScene::any_hits(const GpuPaths& paths, const GpuBufferPart& blocked,
                                  const SceneBatchOptionsf& options, const GpuBatchOptions& gpu) const {
  return run<detail::GpuBufferBatch<GpuSceneState, std::uint8_t>>(state_.get(), paths, blocked, options, gpu);
}

std::size_t GpuScene::memory_bytes() const noexcept { return state_ == nullptr ? 0 : state_->mesh->size(); }

}  // namespace surehit
