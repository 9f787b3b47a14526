#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "gpu_answers.hpp"

namespace surehit::test {

/// Calls `work(device)` with a device whose calls Khronos's layer looks at. The layer writes what it finds to standard
/// output, and is expected to find nothing.
template <typename Work>
void expect_nothing_from_validation(const Work& work) {
  if (!std::filesystem::exists("/usr/share/vulkan/explicit_layer.d/VkLayer_khronos_validation.json")) {
    GTEST_SKIP() << "no validation layer here";
  }
  setenv("VK_INSTANCE_LAYERS", "VK_LAYER_KHRONOS_validation", 1);
  testing::internal::CaptureStdout();
  bool is_open = false;
  {
    const GpuDevice device = any_gpu();
    is_open = device.is_open();
    if (is_open) work(device);
  }
  unsetenv("VK_INSTANCE_LAYERS");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  if (!is_open) GTEST_SKIP() << "no Vulkan device here";
}

}  // namespace surehit::test
