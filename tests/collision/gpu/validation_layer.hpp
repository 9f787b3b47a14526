#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "gpu/gpu_device_state.hpp"
#include "gpu_answers.hpp"

namespace surehit::test {

/// Makes two copies to one place with nothing between them, which is a race.
inline void race(const GpuDevice& device) {
  detail::GpuDeviceState& state = *detail::GpuDeviceState::of(device);
  detail::GpuSlotPair* pair = nullptr;
  ASSERT_FALSE(state.take(pair));
  detail::GpuSlot& slot = pair->slots[0];
  const VkBufferCopy word = {0, 0, 4};
  const detail::GpuCopy copies[] = {{slot.host_paths.get(), slot.paths.get(), word},
                                    {slot.answers.get(), slot.paths.get(), word}};
  EXPECT_FALSE(state.submit(slot, copies, nullptr, {}));
  EXPECT_FALSE(state.wait(slot));
  state.give_back(*pair);
}

/// Calls `work(device)` with a device whose calls and barriers Khronos's layer looks at. The layer writes what it finds
/// to standard output. It is expected to find nothing in this work, and to find a race after it.
template <typename Work>
void expect_nothing_from_validation(
    const Work& work, GpuDevice (*open)() = [] { return any_gpu(true); }) {
  if (!std::filesystem::exists("/usr/share/vulkan/explicit_layer.d/VkLayer_khronos_validation.json")) {
    GTEST_SKIP() << "no validation layer here";
  }
  setenv("VK_INSTANCE_LAYERS", "VK_LAYER_KHRONOS_validation", 1);
  setenv("VK_LAYER_ENABLES", "VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT", 1);
  setenv("VK_LAYER_SETTINGS_PATH", SUREHIT_LAYER_SETTINGS, 1);
  testing::internal::CaptureStdout();
  std::string said_of_work;
  bool is_open = false;
  {
    const GpuDevice device = open();
    is_open = device.is_open();
    if (is_open) {
      work(device);
      said_of_work = testing::internal::GetCapturedStdout();
      testing::internal::CaptureStdout();
      race(device);
    }
  }
  unsetenv("VK_LAYER_SETTINGS_PATH");
  unsetenv("VK_LAYER_ENABLES");
  unsetenv("VK_INSTANCE_LAYERS");
  const std::string said_of_race = testing::internal::GetCapturedStdout();
  if (!is_open) GTEST_SKIP() << "no Vulkan device here";
  EXPECT_EQ(said_of_work, "");
  EXPECT_NE(said_of_race.find("SYNC-HAZARD-WRITE-AFTER-WRITE"), std::string::npos) << said_of_race;
}

}  // namespace surehit::test
