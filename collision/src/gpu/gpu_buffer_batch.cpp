#include "gpu/gpu_buffer_batch.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace surehit::detail {
namespace {

GpuError bad(const std::string& what) { return {GpuError::Reason::bad_buffer, what}; }

std::optional<GpuError> part_fault(const GpuDeviceState& device, const GpuBufferPart& part, std::uint64_t needed,
                                   const std::string& whose) {
  if (part.buffer == 0) return bad("the buffer of the " + whose + " is null");
  // Both are powers of two. The shader reads and writes words.
  const auto alignment =
      std::max<std::uint64_t>(sizeof(std::uint32_t), device.report.properties.limits.minStorageBufferOffsetAlignment);
  if (part.offset % alignment != 0) {
    return bad("the " + whose + " begin at byte " + std::to_string(part.offset) + " of their buffer, and " +
               device.name + " needs a multiple of " + std::to_string(alignment));
  }
  if (part.size < needed) {
    return bad("the " + whose + " take " + std::to_string(needed) + " bytes, and their part of a buffer has " +
               std::to_string(part.size));
  }
  VkMemoryRequirements whole = {};
  device.vulkan.GetBufferMemoryRequirements(device.device, buffer_of(part), &whole);
  if (part.offset > whole.size || part.size > whole.size - part.offset) {
    return bad("the part of the " + whose + " ends beyond their buffer, which has " + std::to_string(whole.size) +
               " bytes");
  }
  return std::nullopt;
}

}  // namespace

VkBuffer buffer_of(const GpuBufferPart& part) {
  VkBuffer buffer = VK_NULL_HANDLE;
  static_assert(sizeof buffer <= sizeof part.buffer);
  std::memcpy(&buffer, &part.buffer, sizeof buffer);
  return buffer;
}

std::optional<GpuError> buffer_fault(const GpuDeviceState& device, const GpuPaths& paths, const GpuBufferPart& answers,
                                     std::uint64_t answer_size, std::uint64_t count) {
  if (count == 0) return std::nullopt;
  constexpr std::uint64_t path_size = sizeof(float[6]);
  // No buffer is so large, and nothing below overflows.
  if (count > std::uint64_t{1} << 56) return bad("the paths take more than any buffer has");
  if (auto fault = part_fault(device, paths.part, count * path_size, "paths")) return fault;
  if (auto fault = part_fault(device, answers, count * answer_size, "answers")) return fault;
  if (paths.part.buffer == answers.buffer && paths.part.offset < answers.offset + count * answer_size &&
      answers.offset < paths.part.offset + count * path_size) {
    return bad("the paths and the answers share bytes of a buffer");
  }
  return std::nullopt;
}

}  // namespace surehit::detail
