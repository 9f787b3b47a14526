#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "faulty_vulkan.hpp"
#include "gpu_answers.hpp"
#include "small_dispatches.hpp"

namespace surehit::test {

/// When a device is lost in a batch of three dispatches.
struct LossInBatch {
  bool is_in_wait;       ///< True if a wait says so, and false if the queue does.
  int calls;             ///< The calls that succeed before.
  std::size_t finished;  ///< The dispatches whose answers are there.
};

/// Two dispatches are given to a queue before the first wait.
inline constexpr LossInBatch losses_in_batch[] = {
    {false, 1, 0}, {false, 2, 1}, {true, 0, 0}, {true, 1, 1}, {true, 2, 2}};

/// Expects that a batch whose device is lost tells how many answers there are, and that the others are as before.
template <typename OnGpu, typename Hit>
void expect_lost_in_batch(const GpuDevice& device, const OnGpu& on_gpu, std::span<const Segmentf> paths,
                          const std::vector<Hit>& expected, const LossInBatch& loss) {
  SCOPED_TRACE((loss.is_in_wait ? "wait " : "submission ") + std::to_string(loss.calls));
  detail::GpuDeviceState& state = *detail::GpuDeviceState::of(device);
  Hit unset;
  unset.t = 7;
  unset.triangle = 7;
  std::vector<Hit> hits(paths.size(), unset);
  submit = state.vulkan.QueueSubmit;
  wait_for = state.vulkan.WaitForFences;
  if (loss.is_in_wait) {
    state.vulkan.WaitForFences = no_wait;
  } else {
    state.vulkan.QueueSubmit = no_submit;
  }
  submit_result = VK_ERROR_DEVICE_LOST;
  wait_result = VK_ERROR_DEVICE_LOST;
  calls_left = loss.is_in_wait ? loss.calls : loss.calls * submissions_of_dispatch(state);
  failures_left = 1;
  const std::size_t finished = loss.finished * paths_in_small_dispatch;
  const GpuBatchResult result = on_gpu.first_hits(paths, hits);
  EXPECT_FALSE(result);
  ASSERT_TRUE(result.error);
  EXPECT_EQ(result.error->reason, GpuError::Reason::device_lost);
  EXPECT_EQ(result.finished, finished);
  calls_left = 100;  // Nothing more is asked of a lost device.
  const GpuBatchResult next = on_gpu.first_hits(paths, hits);
  ASSERT_TRUE(next.error);
  EXPECT_EQ(next.error->reason, GpuError::Reason::device_lost);
  EXPECT_EQ(next.finished, 0U);
  EXPECT_EQ(calls_left, 100);
  for (std::size_t i = 0; i < hits.size(); ++i) ASSERT_EQ(hits[i], i < finished ? expected[i] : unset) << i;
  // The driver has lost nothing, so the device works again. What is still under way is waited for when it is closed.
  state.vulkan.QueueSubmit = submit;
  state.vulkan.WaitForFences = wait_for;
  state.is_lost = false;
}

}  // namespace surehit::test
