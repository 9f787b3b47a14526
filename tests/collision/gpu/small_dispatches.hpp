#pragma once

#include <cstdint>

#include "gpu/gpu_device_state.hpp"

namespace surehit::test {

/// Software takes seconds for dispatches of full size.
inline constexpr std::uint32_t paths_in_small_dispatch = std::uint32_t{1} << 13;

/// Lets a device cut batches into small dispatches, unless it is closed. Returns it.
inline GpuDevice with_small_dispatches(GpuDevice device) {
  if (device.is_open()) detail::GpuDeviceState::of(device)->dispatch_size.fix(paths_in_small_dispatch);
  return device;
}

}  // namespace surehit::test
