#pragma once

#include <algorithm>

#include "gpu/gpu_device_state.hpp"
#include "small_dispatches.hpp"
#include "surehit/gpu.hpp"

namespace surehit::test {

/// Returns true if a device is open and sound, and has nothing under way.
inline bool is_reusable(const GpuDevice& device) {
  if (!device.is_open() || detail::GpuDeviceState::of(device)->is_lost) return false;
  return std::ranges::all_of(detail::GpuDeviceState::of(device)->pairs, [](const auto& pair) {
    return std::ranges::none_of(pair->slots, [](const detail::GpuSlot& slot) { return slot.is_under_way; });
  });
}

/// Makes the device of the last test as good as new, because software takes a second to open one. Opens it anew where
/// it cannot be reused. A test that exchanges functions of Vulkan gives them back, or leaves the device lost.
inline void renew(GpuDevice& device, GpuDevice (*open)()) {
  if (!is_reusable(device)) device = open();
  if (device.is_open()) detail::GpuDeviceState::of(device)->pairs.clear();
  device = with_small_dispatches(device);
}

}  // namespace surehit::test
