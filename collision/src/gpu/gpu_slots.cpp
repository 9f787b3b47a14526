#include "gpu/gpu_slots.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <utility>

#include "gpu/device_answers.hpp"
#include "gpu/gpu_device_state.hpp"
#include "gpu/path_limits.hpp"

namespace surehit::detail {
namespace {

constexpr std::uint64_t one_second = 1'000'000'000;
constexpr std::uint64_t two_minutes = 120 * one_second;
constexpr const char* for_a_batch = "for a batch";

}  // namespace

std::array<GpuRoom, 8> GpuSlot::rooms(std::size_t path_bytes, std::size_t limit_bytes, std::size_t answer_bytes,
                                      std::size_t listed) {
  constexpr auto on_host = GpuBuffer::Place::host;
  constexpr auto on_device = GpuBuffer::Place::device;
  return {GpuRoom{&host_paths, on_host, path_bytes},
          {&paths, on_device, path_bytes},
          {&host_limits, on_host, limit_bytes},
          {&limits, on_device, limit_bytes},
          {&host_answers, on_host, answer_bytes},
          {&answers, on_device, answer_bytes},
          {&host_list, on_host, sizeof(ListedCounts)},
          {&list, on_device, sizeof(ListedCounts) + listed * sizeof(ListedPath)}};
}

void GpuSlot::clear_list() const {
  const ListedCounts none;
  std::memcpy(host_list.data(), &none, sizeof none);
}

GpuSlotPair::~GpuSlotPair() {
  if (device == nullptr) return;
  for (const GpuSlot& slot : slots) {
    device->vulkan.DestroyFence(device->device, slot.fence, nullptr);
    device->vulkan.DestroySemaphore(device->device, slot.is_there, nullptr);
    device->vulkan.DestroySemaphore(device->device, slot.is_computed, nullptr);
  }
  device->vulkan.DestroyDescriptorPool(device->device, sets, nullptr);
  device->vulkan.DestroyCommandPool(device->device, commands, nullptr);
  device->vulkan.DestroyCommandPool(device->device, copies, nullptr);
}

void GpuSlotPair::forget() noexcept {
  device = nullptr;
  for (GpuSlot& slot : slots) {
    for (GpuBuffer* buffer : {&slot.host_paths, &slot.host_limits, &slot.host_answers, &slot.host_list, &slot.paths,
                              &slot.limits, &slot.answers, &slot.list}) {
      buffer->forget();
    }
  }
  if (mesh == nullptr) return;
  for (GpuBuffer* buffer : {mesh->nodes.get(), mesh->triangles.get(), &mesh->scene_nodes, &mesh->instances}) {
    buffer->forget();
  }
}

std::optional<GpuError> GpuDeviceState::take(GpuSlotPair*& pair) {
  if (is_lost) return lost;
  {
    const std::lock_guard lock(pairs_mutex_);
    for (const auto& one : pairs) {
      if (one->is_taken) continue;
      one->is_taken = true;
      pair = one.get();
      return std::nullopt;
    }
  }
  auto made = std::make_unique<GpuSlotPair>(*this);
  if (auto error = make(*made)) return error;
  const std::lock_guard lock(pairs_mutex_);
  pairs.push_back(std::move(made));
  pair = pairs.back().get();
  return std::nullopt;
}

void GpuDeviceState::give_back(GpuSlotPair& pair) noexcept {
  for (GpuSlot& slot : pair.slots) {
    if (slot.is_under_way) abandon(slot);
  }
  if (pair.is_under_way()) return;  // The device keeps the pair and its mesh, and no one takes it again.
  pair.mesh.reset();
  std::unique_ptr<GpuSlotPair> surplus;  // It goes after the mutex was unlocked.
  const std::lock_guard lock(pairs_mutex_);
  pair.is_taken = false;
  const auto free_pairs = std::count_if(pairs.begin(), pairs.end(), [](const auto& one) { return !one->is_taken; });
  if (free_pairs <= max_free_pairs) return;
  const auto place = std::find_if(pairs.begin(), pairs.end(), [&](const auto& one) { return one.get() == &pair; });
  surplus = std::move(*place);
  pairs.erase(place);
}

std::optional<GpuError> GpuDeviceState::make(GpuSlotPair& pair) const {
  auto commands = of_type<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
  commands.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
  for (std::size_t i = 0; i < families().size(); ++i) {
    commands.queueFamilyIndex = families()[i];
    VkCommandPool& pool = i == 0 ? pair.commands : pair.copies;
    const VkResult has_commands = vulkan.CreateCommandPool(device, &commands, nullptr, &pool);
    if (auto error = error_of(has_commands, for_a_batch, pool)) return error;
  }
  const auto slot_count = static_cast<std::uint32_t>(pair.slots.size());
  const VkDescriptorPoolSize sizes = {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, buffer_count() * slot_count};
  auto sets = of_type<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
  sets.maxSets = slot_count;
  sets.poolSizeCount = 1;
  sets.pPoolSizes = &sizes;
  const VkResult has_sets = vulkan.CreateDescriptorPool(device, &sets, nullptr, &pair.sets);
  if (auto error = error_of(has_sets, for_a_batch, pair.sets)) return error;
  for (GpuSlot& slot : pair.slots) {
    if (auto error = make(slot, pair)) return error;
  }
  return std::nullopt;
}

std::optional<GpuError> GpuDeviceState::make(GpuSlot& slot, const GpuSlotPair& pair) const {
  const auto make_commands = [&](VkCommandPool pool, VkCommandBuffer& made) {
    auto commands = of_type<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
    commands.commandPool = pool;
    commands.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    commands.commandBufferCount = 1;
    return error_of(vulkan.AllocateCommandBuffers(device, &commands, &made), for_a_batch);
  };
  if (auto error = make_commands(pair.commands, slot.commands)) return error;
  if (copies_apart()) {
    if (auto error = make_commands(pair.copies, slot.commands_there)) return error;
    if (auto error = make_commands(pair.copies, slot.commands_back)) return error;
    const auto semaphore = of_type<VkSemaphoreCreateInfo>(VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO);
    for (VkSemaphore* made : {&slot.is_there, &slot.is_computed}) {
      const VkResult has_semaphore = vulkan.CreateSemaphore(device, &semaphore, nullptr, made);
      if (auto error = error_of(has_semaphore, for_a_batch, *made)) return error;
    }
  }
  auto set = of_type<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
  set.descriptorPool = pair.sets;
  set.descriptorSetCount = 1;
  set.pSetLayouts = &set_layout_;
  if (auto error = error_of(vulkan.AllocateDescriptorSets(device, &set, &slot.buffers), for_a_batch)) return error;
  const auto fence = of_type<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
  const VkResult has_fence = vulkan.CreateFence(device, &fence, nullptr, &slot.fence);
  if (auto error = error_of(has_fence, for_a_batch, slot.fence)) return error;
  return std::nullopt;
}

std::optional<GpuError> GpuDeviceState::make_room(std::span<const GpuRoom> rooms) const {
  for (const auto& [buffer, place, bytes] : rooms) {
    if (buffer->size() >= bytes && buffer->get() != VK_NULL_HANDLE) continue;
    *buffer = GpuBuffer();  // So there is memory for the larger one.
    if (auto error = buffer->make(*this, bytes, place, "a batch")) return error;
  }
  return std::nullopt;
}

std::optional<GpuError> GpuDeviceState::wait(GpuSlot& slot) {
  if (is_lost) return lost;
  const char* const what = "while a batch was under way";
  if (auto error = noted(wait_for_end(slot), what)) return error;
  slot.is_under_way = false;
  if (slot.dispatched > 0) dispatch_size.note(slot.dispatched, std::chrono::steady_clock::now() - slot.begun);
  const VkResult reset = vulkan.ResetFences(device, 1, &slot.fence);
  if (reset != VK_SUCCESS) is_lost = true;  // The next wait would end before the work does.
  return noted(reset, what);
}

VkResult GpuDeviceState::wait_for_end(const GpuSlot& slot) {
  for (;;) {
    const std::uint64_t before = ended_;
    const VkResult result = vulkan.WaitForFences(device, 1, &slot.fence, VK_TRUE, two_minutes);
    if (result == VK_SUCCESS) ++ended_;
    if (result != VK_TIMEOUT || is_lost || ended_ == before) return result;
  }
}

void GpuDeviceState::abandon(GpuSlot& slot) noexcept {
  if (is_lost) return;
  VkResult result = wait_for_end(slot);
  slot.is_under_way = result != VK_SUCCESS;
  if (result == VK_SUCCESS) result = vulkan.ResetFences(device, 1, &slot.fence);
  if (result != VK_SUCCESS) is_lost = true;
}

bool GpuDeviceState::has_returned() noexcept {
  bool has = true;
  for (const auto& pair : pairs) {
    if (pair->device == nullptr) return false;  // It was forgotten.
    for (const GpuSlot& slot : pair->slots) {
      if (!slot.is_under_way) continue;
      const VkResult result = vulkan.WaitForFences(device, 1, &slot.fence, VK_TRUE, one_second);
      // A device that was lost has returned. Any other error says nothing of the work.
      has &= result == VK_SUCCESS || result == VK_ERROR_DEVICE_LOST;
    }
  }
  return has;
}

void GpuDeviceState::forget() noexcept {
  for (const auto& pair : pairs) pair->forget();
  vulkan.library.forget();
}

}  // namespace surehit::detail
