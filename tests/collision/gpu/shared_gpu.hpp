#pragma once

#include <gtest/gtest.h>

#include "gpu_answers.hpp"

namespace surehit::test {

/// The tests of a suite that open a device once. They are skipped where there is none.
class SharedGpu : public testing::Test {
 protected:
  static void SetUpTestSuite() { device = any_gpu(); }
  static void TearDownTestSuite() { device = GpuDevice(); }
  void SetUp() override { SUREHIT_SKIP_WITHOUT(device); }

  static inline GpuDevice device;
  GpuStatistics statistics;
};

}  // namespace surehit::test
