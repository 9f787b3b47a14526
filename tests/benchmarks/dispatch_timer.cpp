#include "dispatch_timer.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace surehit::benchmark {

using detail::GpuDeviceState;

DispatchTimer* DispatchTimer::current = nullptr;

DispatchTimer::DispatchTimer(const GpuDevice& device, std::size_t max_dispatches)
    : state_(*GpuDeviceState::of(device)),
      max_dispatches_(static_cast<std::uint32_t>(max_dispatches)),
      valid_bits_(state_.report.families[device.handles().queue_family].timestampValidBits) {
  if (valid_bits_ == 0) return;
  const auto load = [&](auto& function, const char* name) {
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(
        state_.vulkan.GetDeviceProcAddr(state_.device, name));
  };
  load(functions_.CreateQueryPool, "vkCreateQueryPool");
  load(functions_.DestroyQueryPool, "vkDestroyQueryPool");
  load(functions_.CmdResetQueryPool, "vkCmdResetQueryPool");
  load(functions_.CmdWriteTimestamp, "vkCmdWriteTimestamp");
  load(functions_.GetQueryPoolResults, "vkGetQueryPoolResults");
  auto info = detail::of_type<VkQueryPoolCreateInfo>(VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO);
  info.queryType = VK_QUERY_TYPE_TIMESTAMP;
  info.queryCount = 2 * max_dispatches_;
  const VkResult made = functions_.CreateQueryPool(state_.device, &info, nullptr, &pool_);
  if (auto error = detail::error_of(made, "for timestamps", pool_)) throw GpuError(*error);
  current = this;
  dispatch_ = std::exchange(state_.vulkan.CmdDispatch, timed_dispatch);
  indirect_dispatch_ = std::exchange(state_.vulkan.CmdDispatchIndirect, timed_indirect_dispatch);
}

DispatchTimer::~DispatchTimer() {
  if (valid_bits_ == 0) return;
  state_.vulkan.CmdDispatch = dispatch_;
  state_.vulkan.CmdDispatchIndirect = indirect_dispatch_;
  current = nullptr;
  functions_.DestroyQueryPool(state_.device, pool_, nullptr);
}

void DispatchTimer::timed_dispatch(VkCommandBuffer commands, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  current->time(commands, [&] { current->dispatch_(commands, x, y, z); });
}

void DispatchTimer::timed_indirect_dispatch(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize offset) {
  current->time(commands, [&] { current->indirect_dispatch_(commands, buffer, offset); });
}

template <typename Dispatch>
void DispatchTimer::time(VkCommandBuffer commands, const Dispatch& dispatch) {
  const std::uint32_t index = dispatches_++;
  if (index >= max_dispatches_) {
    dispatch();
    return;
  }
  // Each timestamp is taken when all commands before it have ended. A dispatch waits for what is before it, so no two
  // of them share the time between.
  constexpr auto end = VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT;
  functions_.CmdResetQueryPool(commands, pool_, 2 * index, 2);
  functions_.CmdWriteTimestamp(commands, end, pool_, 2 * index);
  dispatch();
  functions_.CmdWriteTimestamp(commands, end, pool_, 2 * index + 1);
}

std::optional<double> DispatchTimer::nanoseconds() const {
  if (valid_bits_ == 0 || dispatches_ == 0 || dispatches_ > max_dispatches_) return std::nullopt;
  std::vector<std::uint64_t> times(2 * std::size_t{dispatches_});
  const VkResult read = functions_.GetQueryPoolResults(
      state_.device, pool_, 0, 2 * dispatches_, times.size() * sizeof(std::uint64_t), times.data(),
      sizeof(std::uint64_t), VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT);
  if (auto error = detail::error_of(read, "while reading timestamps")) throw GpuError(*error);
  // The clock may begin anew in between.
  const std::uint64_t mask = ~std::uint64_t{0} >> (64 - std::min(valid_bits_, 64U));
  double ticks = 0;
  for (std::size_t i = 0; i < times.size(); i += 2) ticks += static_cast<double>((times[i + 1] - times[i]) & mask);
  return ticks * static_cast<double>(state_.report.properties.limits.timestampPeriod);
}

}  // namespace surehit::benchmark
