#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <surehit/gpu.hpp>

#include "gpu/gpu_device_state.hpp"

namespace surehit::benchmark {

/// While it lives, it measures how long a device computes: timestamps stand around each dispatch in the queue. So the
/// library itself need not measure. One at a time may live, and batches may not overlap then.
class DispatchTimer {
 public:
  /// Has room for so many dispatches.
  DispatchTimer(const GpuDevice& device, std::size_t max_dispatches);
  ~DispatchTimer();
  DispatchTimer(const DispatchTimer&) = delete;
  DispatchTimer& operator=(const DispatchTimer&) = delete;

  /// Returns the nanoseconds that all dispatches so far took, or nothing if the device has no timestamps, or if there
  /// were too many dispatches. None may be under way.
  [[nodiscard]] std::optional<double> nanoseconds() const;

 private:
  struct Functions {
    PFN_vkCreateQueryPool CreateQueryPool;  // NOLINT(readability-identifier-naming): as Vulkan has it
    PFN_vkDestroyQueryPool DestroyQueryPool;
    PFN_vkCmdResetQueryPool CmdResetQueryPool;
    PFN_vkCmdWriteTimestamp CmdWriteTimestamp;
    PFN_vkGetQueryPoolResults GetQueryPoolResults;
  };

  /// What the library calls in place of the device's own functions.
  static VKAPI_ATTR void VKAPI_CALL timed_dispatch(VkCommandBuffer commands, std::uint32_t x, std::uint32_t y,
                                                   std::uint32_t z);
  static VKAPI_ATTR void VKAPI_CALL timed_indirect_dispatch(VkCommandBuffer commands, VkBuffer buffer,
                                                            VkDeviceSize offset);
  /// Gives timestamps before and after a dispatch, if there is room for them.
  template <typename Dispatch>
  void time(VkCommandBuffer commands, const Dispatch& dispatch);

  static DispatchTimer* current;

  detail::GpuDeviceState& state_;
  std::uint32_t max_dispatches_;
  std::uint32_t valid_bits_;  ///< Those of a timestamp, or 0 where there are none.
  Functions functions_ = {};
  VkQueryPool pool_ = VK_NULL_HANDLE;
  PFN_vkCmdDispatch dispatch_ = nullptr;  ///< The device's own functions.
  PFN_vkCmdDispatchIndirect indirect_dispatch_ = nullptr;
  std::uint32_t dispatches_ = 0;
};

}  // namespace surehit::benchmark
