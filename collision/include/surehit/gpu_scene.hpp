#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "surehit/gpu.hpp"
#include "surehit/scene_hit.hpp"
#include "surehit/scene_query_options.hpp"
#include "surehit/scene_snapshot.hpp"

namespace surehit {

namespace detail {
struct GpuSceneState;
}  // namespace detail

/// What a scene of floats has committed, with batches that run on a GPU. The answers have the same bits as those of the
/// scene.
///
/// It has a snapshot of the scene, see `Scene::snapshot`. So it goes on to answer as before while the scene changes and
/// commits, until it is updated. Meshes are shared: a thousand instances of one collider are uploaded once.
///
/// The device finds out which paths certainly miss, and which triangle of which instance a path certainly hits. It
/// rounds t, u and v of most first hits. The host answers the other paths. `collision/src/gpu/GPU.md` proves that what
/// the device is certain of is right. There is none for scenes of doubles, because a device has no doubles that the
/// proof could use.
///
/// Batches may run in several threads at the same time. None may run during an upload or an update, or while a collider
/// of the scene changes.
class GpuScene {
 public:
  /// Makes one that has no scene. It must be uploaded before it is asked.
  GpuScene() noexcept = default;

  /// Uploads a scene to an open device. Fails as `GpuCollider::try_upload` does. Fails too if the device has fewer than
  /// eight buffers for a shader, or if a collider was rebuilt since the scene was committed. Before the first scene,
  /// the device answers known paths through a small one. A wrong answer is `missing_feature`, so it gets no scene.
  /// After a failure, this is as before. May throw std::bad_alloc.
  GpuResult try_upload(const GpuDevice& device, const SceneSnapshotf& scene);
  /// Uploads another snapshot to the same device, usually after a commit. Fails as `try_upload` does.
  ///
  /// If all meshes are on the device already, this uploads the instances alone. Otherwise it uploads all meshes of the
  /// scene. Meshes that no instance has any more stay on the device until then.
  GpuResult try_update(const SceneSnapshotf& scene);

#if defined(__cpp_exceptions)
  /// Uploads a scene. Throws the error of `try_upload`.
  GpuScene(const GpuDevice& device, const SceneSnapshotf& scene) {
    if (const GpuResult uploaded = try_upload(device, scene); !uploaded) throw uploaded.error();
  }
  /// Uploads another snapshot. Throws the error of `try_update`.
  void update(const SceneSnapshotf& scene) {
    if (const GpuResult updated = try_update(scene); !updated) throw updated.error();
  }
#endif

  /// Sets `hits[i]` to the first hit of path i, as `SceneQueries::first_hits` does. Lengths are as there.
  ///
  /// Filters, executors, statistics and failures are as in `GpuCollider::first_hits`. It fails too if a collider of the
  /// scene was rebuilt or assigned, or has other masks, since the scene was uploaded.
  GpuBatchResult first_hits(const PathSpanf& paths, std::span<SceneHitf> hits, const SceneBatchOptionsf& options = {},
                            const GpuBatchOptions& gpu = {}) const;
  /// Sets `blocked[i]` to 1 if path i has a hit, and to 0 otherwise, as `SceneQueries::any_hits` does. All else is as
  /// in `first_hits`.
  GpuBatchResult any_hits(const PathSpanf& paths, std::span<std::uint8_t> blocked,
                          const SceneBatchOptionsf& options = {}, const GpuBatchOptions& gpu = {}) const;

  /// Does the same with paths and hits in buffers of the caller's, as `GpuCollider::first_hits` does. Each hit takes 24
  /// bytes: those of a collider's hit, and then the index of the instance as a word of 32 bits. The generation is that
  /// of the snapshot's instance with this index. A miss has `no_instance`.
  GpuBatchResult first_hits(const GpuPaths& paths, const GpuBufferPart& hits, const SceneBatchOptionsf& options = {},
                            const GpuBatchOptions& gpu = {}) const;
  /// Sets a word of 32 bits for each path: to 1 if it has a hit, and to 0 otherwise. All else is as in `first_hits`.
  GpuBatchResult any_hits(const GpuPaths& paths, const GpuBufferPart& blocked, const SceneBatchOptionsf& options = {},
                          const GpuBatchOptions& gpu = {}) const;

  /// Returns the memory on the device that the meshes and the instances take, in bytes.
  [[nodiscard]] std::size_t memory_bytes() const noexcept;

 private:
  std::shared_ptr<detail::GpuSceneState> state_;
};

}  // namespace surehit
