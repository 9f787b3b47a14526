#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "collider_state.hpp"
#include "gpu/gpu_batch.hpp"
#include "gpu/gpu_buffer_batch.hpp"
#include "gpu/gpu_collider_state.hpp"
#include "gpu/triangle_tree.hpp"
#include "support/floating_point_environment.hpp"
#include "surehit/gpu.hpp"

namespace surehit {
namespace {

using detail::GpuColliderState;
using detail::GpuDeviceState;

/// Runs a batch of this class, unless the collider has changed since it was uploaded.
template <typename Batch, typename Paths, typename Answers>
GpuBatchResult run(const GpuColliderState* state, const Paths& paths, const Answers& answers,
                   const BatchOptionsf& options, const GpuBatchOptions& gpu) {
  const FloatingPointEnvironment environment;
  GpuBatchResult refused;
  if (state == nullptr) {
    refused.error = GpuError(GpuError::Reason::not_updated, "no collider was uploaded");
    return refused;
  }
  const auto& now = detail::ColliderState<float>::of(*state->collider);
  if (now.version != state->version || now.mask_version != state->mask_version) {
    refused.error = GpuError(GpuError::Reason::not_updated,
                             "the collider was rebuilt or has other masks since it was uploaded; update it first");
    return refused;
  }
  return Batch(*state, paths, answers, options, gpu).run();
}

}  // namespace

GpuResult GpuCollider::try_upload(const GpuDevice& device, const Colliderf& collider) {
  if (!device.is_open()) return GpuError(GpuError::Reason::no_device, "the device is not open");
  const FloatingPointEnvironment environment;
  const detail::TriangleTree tree(collider);
  const auto& now = detail::ColliderState<float>::of(collider);
  auto state = std::make_shared<GpuColliderState>();
  state->device = GpuDeviceState::of(device);
  state->collider = &collider;
  state->version = now.version;
  state->mask_version = now.mask_version;
  state->is_on_device = !tree.nodes.empty();
  state->mesh = std::make_shared<detail::GpuMesh>();
  if (state->is_on_device) {
    const detail::GpuMesh& mesh = *state->mesh;
    detail::GpuWork work(*state->device);
    if (auto error = work.begin(state->mesh)) return *error;
    if (auto error = work.upload(std::as_bytes(std::span(tree.nodes)), "the nodes of a mesh", *mesh.nodes)) {
      return *error;
    }
    if (auto error =
            work.upload(std::as_bytes(std::span(tree.triangles)), "the triangles of a mesh", *mesh.triangles)) {
      return *error;
    }
  }
  state_ = std::move(state);
  return {};
}

GpuResult GpuCollider::try_update() {
  if (state_ == nullptr) return GpuError(GpuError::Reason::not_updated, "no collider was uploaded");
  return try_upload(GpuDeviceState::device_of(state_->device), *state_->collider);
}

GpuBatchResult GpuCollider::first_hits(const PathSpanf& paths, std::span<Hitf> hits, const BatchOptionsf& options,
                                       const GpuBatchOptions& gpu) const {
  return run<detail::GpuBatch<GpuColliderState, Hitf>>(state_.get(), paths, hits, options, gpu);
}

GpuBatchResult GpuCollider::any_hits(const PathSpanf& paths, std::span<std::uint8_t> blocked,
                                     const BatchOptionsf& options, const GpuBatchOptions& gpu) const {
  return run<detail::GpuBatch<GpuColliderState, std::uint8_t>>(state_.get(), paths, blocked, options, gpu);
}

GpuBatchResult GpuCollider::first_hits(const GpuPaths& paths, const GpuBufferPart& hits, const BatchOptionsf& options,
                                       const GpuBatchOptions& gpu) const {
  return run<detail::GpuBufferBatch<GpuColliderState, Hitf>>(state_.get(), paths, hits, options, gpu);
}

GpuBatchResult GpuCollider::any_hits(const GpuPaths& paths, const GpuBufferPart& blocked, const BatchOptionsf& options,
                                     const GpuBatchOptions& gpu) const {
  return run<detail::GpuBufferBatch<GpuColliderState, std::uint8_t>>(state_.get(), paths, blocked, options, gpu);
}

std::size_t GpuCollider::memory_bytes() const noexcept { return state_ == nullptr ? 0 : state_->mesh->size(); }

}  // namespace surehit
