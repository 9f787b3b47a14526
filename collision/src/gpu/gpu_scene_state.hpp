#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "gpu/device_answers.hpp"
#include "gpu/gpu_device_state.hpp"
#include "gpu/path_limits.hpp"
#include "gpu/scene_tree.hpp"
#include "scene/committed_scene.hpp"
#include "surehit/gpu_scene.hpp"

namespace surehit::detail {

/// A collider of a scene, as it was when the scene was uploaded.
struct UploadedCollider {
  const Colliderf* collider;
  const ColliderState<float>* state;  ///< It may be freed since then, if the collider has changed.
  MeshVersions versions;

  [[nodiscard]] bool has_changed() const {
    const ColliderState<float>& now = ColliderState<float>::of(*collider);
    return &now != state || versions_of(now) != versions;
  }
};

/// What an uploaded scene has behind its pointer.
struct GpuSceneState {
  using FirstHit = SceneHitf;
  using BatchOptions = SceneBatchOptionsf;
  using DeviceFirst = DeviceSceneHit;
  static constexpr GpuTask first_task = GpuTask::scene_first_hits;
  static constexpr GpuTask any_task = GpuTask::scene_any_hits;

  std::shared_ptr<GpuDeviceState> device;
  SceneSnapshotf scene;
  std::vector<UploadedCollider> colliders;  ///< Those of instances with triangles, each once, by their versions.
  std::vector<DeviceMesh> meshes;           ///< The meshes on the device. Some may have no instance.
  bool is_on_device = false;  ///< False if the host answers all paths, because the device could decide none.
  std::shared_ptr<GpuMesh> mesh = std::make_shared<GpuMesh>();

  [[nodiscard]] const CommittedScene<float>& committed() const { return CommittedScene<float>::of(scene); }
  [[nodiscard]] const SceneSnapshotf& asked() const { return scene; }
  [[nodiscard]] PathLimits limits(PathKind kind, const SceneQueryOptionsf& options) const {
    return path_limits(kind, options, committed());
  }
  [[nodiscard]] Leftover leftover_of(const DeviceSceneHit& answer) const {
    const std::vector<CommittedInstance<float>>& instances = committed().instances;
    const bool is_known = answer.instance < instances.size() && instances[answer.instance].is_in_tree;
    return detail::leftover_of(answer.hit,
                               is_known ? instances[answer.instance].mesh.own->mesh.triangle_count() : std::size_t{0});
  }
  [[nodiscard]] Leftover leftover_of(DeviceAny answer) const { return detail::leftover_of(answer); }
  /// Returns true if a list of the device says that a path hits something. It does not name the instance.
  [[nodiscard]] bool has_hit(const ListedPath& listed) const { return listed.triangle != no_triangle; }
  [[nodiscard]] SceneHitf answer_of(const DeviceSceneHit& answer) const {
    if (answer.hit.triangle == no_triangle) return {};
    return {detail::answer_of(answer.hit), {answer.instance, committed().instances[answer.instance].generation}};
  }
};

}  // namespace surehit::detail
