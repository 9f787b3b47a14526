#pragma once

#include <cstdint>
#include <memory>

#include "gpu/device_answers.hpp"
#include "gpu/gpu_device_state.hpp"
#include "gpu/path_limits.hpp"
#include "surehit/gpu.hpp"

namespace surehit::detail {

/// What an uploaded collider has behind its pointer.
struct GpuColliderState {
  using FirstHit = Hitf;
  using BatchOptions = BatchOptionsf;
  using DeviceFirst = DeviceHit;
  static constexpr GpuTask first_task = GpuTask::first_hits;
  static constexpr GpuTask any_task = GpuTask::any_hits;

  std::shared_ptr<GpuDeviceState> device;
  const Colliderf* collider;
  std::uint64_t version;       ///< That of the collider when it was uploaded.
  std::uint64_t mask_version;  ///< The same of its masks.
  bool is_on_device;           ///< False if the host answers all paths, because the device could decide none.
  std::shared_ptr<GpuMesh> mesh;

  [[nodiscard]] const Colliderf& asked() const { return *collider; }
  [[nodiscard]] PathLimits limits(PathKind kind, const QueryOptionsf& options) const {
    return path_limits(kind, options);
  }
  [[nodiscard]] Leftover leftover_of(const DeviceHit& answer) const {
    return detail::leftover_of(answer, collider->triangle_count());
  }
  [[nodiscard]] Leftover leftover_of(DeviceAny answer) const { return detail::leftover_of(answer); }
  /// Returns true if a list of the device says which triangle a path hits.
  [[nodiscard]] bool has_hit(const ListedPath& listed) const { return listed.triangle < collider->triangle_count(); }
  [[nodiscard]] Hitf answer_of(const DeviceHit& answer) const { return detail::answer_of(answer); }
};

}  // namespace surehit::detail
