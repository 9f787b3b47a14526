#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <new>
#include <span>
#include <vector>

#include "gpu/gpu_device_state.hpp"

namespace surehit::test {

/// Functions of Vulkan that fail after some calls.
inline int calls_left = 0;
inline PFN_vkAllocateMemory allocate = nullptr;
inline VKAPI_ATTR VkResult VKAPI_CALL no_memory(VkDevice device, const VkMemoryAllocateInfo* info,
                                                const VkAllocationCallbacks* callbacks, VkDeviceMemory* memory) {
  if (calls_left-- > 0) return allocate(device, info, callbacks, memory);
  std::memset(memory, 0x55, sizeof *memory);  // Vulkan leaves it undefined.
  return VK_ERROR_OUT_OF_DEVICE_MEMORY;
}
inline PFN_vkQueueSubmit submit = nullptr;
inline VkResult submit_result = VK_SUCCESS;
inline VKAPI_ATTR VkResult VKAPI_CALL no_submit(VkQueue queue, std::uint32_t count, const VkSubmitInfo* work,
                                                VkFence fence) {
  return calls_left-- > 0 ? submit(queue, count, work, fence) : submit_result;
}

/// How often a device is given work for a dispatch whose paths and answers are on the host.
inline int submissions_of_dispatch(const detail::GpuDeviceState& state) { return state.copies_apart() ? 3 : 1; }

inline PFN_vkWaitForFences wait_for = nullptr;
inline VkResult wait_result = VK_SUCCESS;
inline int failures_left = 0;
inline VKAPI_ATTR VkResult VKAPI_CALL no_wait(VkDevice device, std::uint32_t count, const VkFence* fences, VkBool32 all,
                                              std::uint64_t timeout) {
  if (calls_left-- > 0 || failures_left-- <= 0) return wait_for(device, count, fences, all, timeout);
  if (wait_result == VK_SUCCESS) throw std::bad_alloc();
  return wait_result;
}
inline PFN_vkResetFences reset = nullptr;
inline VKAPI_ATTR VkResult VKAPI_CALL no_reset(VkDevice device, std::uint32_t count, const VkFence* fences) {
  return calls_left-- > 0 ? reset(device, count, fences) : VK_ERROR_OUT_OF_DEVICE_MEMORY;
}
inline detail::GpuDeviceState* faulty = nullptr;
/// It is written over the answers to the first 1000 paths.
inline std::vector<std::byte> faulty_answer;
inline VKAPI_ATTR VkResult VKAPI_CALL faulty_answers(VkDevice device, std::uint32_t count, const VkFence* fences,
                                                     VkBool32 all, std::uint64_t timeout) {
  const VkResult result = wait_for(device, count, fences, all, timeout);
  for (const auto& pair : faulty->pairs) {
    for (const detail::GpuSlot& slot : pair->slots) {
      if (slot.fence != *fences) continue;
      for (std::size_t i = 0; i < 1000; ++i) {
        std::memcpy(slot.host_answers.data() + i * faulty_answer.size(), faulty_answer.data(), faulty_answer.size());
      }
    }
  }
  return result;
}
/// Changes the list of the first dispatch, where its counts begin.
inline std::function<void(std::byte*)> change;
inline VKAPI_ATTR VkResult VKAPI_CALL changed_list(VkDevice device, std::uint32_t count, const VkFence* fences,
                                                   VkBool32 all, std::uint64_t timeout) {
  const VkResult result = wait_for(device, count, fences, all, timeout);
  change(faulty->pairs.front()->slots[0].host_list.data());
  return result;
}
inline PFN_vkFreeMemory give_back = nullptr;
inline int freed = 0;
inline VKAPI_ATTR void VKAPI_CALL counted_free(VkDevice device, VkDeviceMemory memory,
                                               const VkAllocationCallbacks* callbacks) {
  ++freed;
  give_back(device, memory, callbacks);
}

/// Expects that no one has slots of a device, and that no fence has been signaled, nor will be.
inline void expect_idle(const detail::GpuDeviceState& state) {
  for (const auto& pair : state.pairs) {
    EXPECT_FALSE(pair->is_taken);
    for (const detail::GpuSlot& slot : pair->slots) {
      EXPECT_FALSE(slot.is_under_way);
      EXPECT_EQ(state.vulkan.WaitForFences(state.device, 1, &slot.fence, VK_TRUE, 0), VK_TIMEOUT);
    }
  }
}

/// Lets a faulty device answer with this.
template <typename Answer>
void set_faulty_answer(const Answer& answer) {
  const auto bytes = std::as_bytes(std::span(&answer, 1));
  faulty_answer.assign(bytes.begin(), bytes.end());
}

}  // namespace surehit::test
