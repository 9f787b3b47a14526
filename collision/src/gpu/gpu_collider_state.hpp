#pragma once

#include <cstdint>
#include <memory>

#include "gpu/gpu_device_state.hpp"
#include "surehit/gpu.hpp"

namespace surehit::detail {

/// What an uploaded collider has behind its pointer.
struct GpuColliderState {
  std::shared_ptr<GpuDeviceState> device;
  const Colliderf* collider;
  std::uint64_t version;       ///< That of the collider when it was uploaded.
  std::uint64_t mask_version;  ///< The same of its masks.
  bool is_on_device;           ///< False if the host answers all paths, because the device could decide none.
  std::shared_ptr<GpuMesh> mesh;
};

/// Adds what a batch did.
inline void add(const GpuStatistics& of_batch, GpuStatistics& all) {
  all.paths += of_batch.paths;
  all.misses += of_batch.misses;
  all.hits += of_batch.hits;
  all.rounded += of_batch.rounded;
  all.rounded_by_host += of_batch.rounded_by_host;
  all.undecided += of_batch.undecided;
  all.dispatches += of_batch.dispatches;
}

}  // namespace surehit::detail
