#include "gpu/gpu_commands.hpp"

#include <array>

#include "gpu/device_answers.hpp"
#include "gpu/device_needs.hpp"
#include "gpu/gpu_slots.hpp"

namespace surehit::detail {
namespace {

constexpr auto transfer = VK_PIPELINE_STAGE_TRANSFER_BIT;
constexpr auto compute = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
constexpr auto by_transfer = VK_ACCESS_TRANSFER_READ_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
constexpr auto by_shader = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT;

}  // namespace

VkResult GpuCommands::begin() const {
  auto info = of_type<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
  info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  return vulkan_.BeginCommandBuffer(commands_, &info);
}

void GpuCommands::wait_for_queue() const {
  wait_for(VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_ACCESS_MEMORY_WRITE_BIT, transfer | compute, by_transfer | by_shader);
}

void GpuCommands::copy(std::span<const GpuCopy> copies) const {
  for (std::size_t i = 0; i < copies.size();) {
    std::array<VkBufferCopy, 64> regions;
    std::uint32_t count = 0;
    const GpuCopy& first = copies[i];
    while (count < regions.size() && i < copies.size() && copies[i].from == first.from && copies[i].to == first.to) {
      regions[count++] = copies[i++].region;
    }
    vulkan_.CmdCopyBuffer(commands_, first.from, first.to, count, regions.data());
  }
}

void GpuCommands::dispatch(const GpuSlot& slot, const GpuPipelines& pipelines, VkPipelineLayout layout,
                           const PushedWords& words) const {
  const bool has_two = pipelines.quick != VK_NULL_HANDLE;
  wait_for(transfer, VK_ACCESS_TRANSFER_WRITE_BIT, transfer | compute, by_transfer | by_shader);
  vulkan_.CmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, has_two ? pipelines.quick : pipelines.whole);
  vulkan_.CmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &slot.buffers, 0, nullptr);
  vulkan_.CmdPushConstants(commands_, layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof words, &words);
  vulkan_.CmdDispatch(commands_, (words.path_count + threads_in_group - 1) / threads_in_group, 1, 1);
  if (!has_two) return;
  wait_for(compute, VK_ACCESS_SHADER_WRITE_BIT, VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT | compute,
           VK_ACCESS_INDIRECT_COMMAND_READ_BIT | by_shader);
  vulkan_.CmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, pipelines.whole);
  vulkan_.CmdDispatchIndirect(commands_, slot.list.get(), offsetof(ListedCounts, groups));
}

void GpuCommands::wait_for_shader() const { wait_for(compute, VK_ACCESS_SHADER_WRITE_BIT, transfer, by_transfer); }

VkResult GpuCommands::end() const {
  const bool computes = queue_ == Queue::computes;
  wait_for(computes ? transfer | compute : transfer,
           computes ? VK_ACCESS_TRANSFER_WRITE_BIT | VK_ACCESS_SHADER_WRITE_BIT : VK_ACCESS_TRANSFER_WRITE_BIT,
           VK_PIPELINE_STAGE_HOST_BIT | VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
           VK_ACCESS_HOST_READ_BIT | VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT);
  return vulkan_.EndCommandBuffer(commands_);
}

void GpuCommands::wait_for(VkPipelineStageFlags stages, VkAccessFlags written, VkPipelineStageFlags next_stages,
                           VkAccessFlags used) const {
  auto barrier = of_type<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
  barrier.srcAccessMask = written;
  barrier.dstAccessMask = used;
  vulkan_.CmdPipelineBarrier(commands_, stages, next_stages, 0, 1, &barrier, 0, nullptr, 0, nullptr);
}

}  // namespace surehit::detail
