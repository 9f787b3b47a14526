#include "gpu/gpu_device_state.hpp"

#include <algorithm>
#include <cstring>

#include "gpu/device_answers.hpp"
#include "gpu/path_limits.hpp"
#include "roundings.spv.hpp"
#include "tree_walk.spv.hpp"

namespace surehit::detail {
namespace {

constexpr std::uint32_t buffer_count = 5;
constexpr std::uint64_t two_minutes = 120'000'000'000;
constexpr const char* while_beginning = "while beginning a batch";

/// A structure of Vulkan with all members zero, except for its type.
template <typename Structure>
Structure of_type(VkStructureType type) {
  Structure structure = {};
  structure.sType = type;
  return structure;
}

}  // namespace

GpuDeviceState::~GpuDeviceState() {
  if (device != VK_NULL_HANDLE) {
    vulkan.DeviceWaitIdle(device);
    mesh.reset();
    for (GpuSlot& slot : slots) {
      vulkan.DestroyFence(device, slot.fence, nullptr);
      slot = {};
    }
    for (VkPipeline pipeline : pipelines_) vulkan.DestroyPipeline(device, pipeline, nullptr);
    vulkan.DestroyDescriptorPool(device, sets_, nullptr);
    vulkan.DestroyCommandPool(device, commands_, nullptr);
    vulkan.DestroyPipelineLayout(device, layout_, nullptr);
    vulkan.DestroyDescriptorSetLayout(device, set_layout_, nullptr);
    vulkan.DestroyDevice(device, nullptr);
  }
  if (instance != VK_NULL_HANDLE) vulkan.DestroyInstance(instance, nullptr);
}

std::optional<GpuError> GpuDeviceState::start(const char* loader) {
  if (auto error = vulkan.open_loader(loader)) return error;
  std::uint32_t version = 0;
  vulkan.EnumerateInstanceVersion(&version);
  if (version < VK_API_VERSION_1_1) {
    return GpuError(GpuError::Reason::no_loader, "the Vulkan loader is older than 1.1");
  }
  auto application = of_type<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
  application.pApplicationName = "surehit";
  application.apiVersion = VK_API_VERSION_1_1;
  auto info = of_type<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
  info.pApplicationInfo = &application;
  const VkResult started = vulkan.CreateInstance(&info, nullptr, &instance);
  if (auto error = error_of(started, "while starting Vulkan", instance)) return error;
  return vulkan.load(instance);
}

std::optional<GpuError> GpuDeviceState::find(std::vector<std::pair<VkPhysicalDevice, DeviceReport>>& found) const {
  found.clear();
  std::uint32_t count = 0;
  if (auto error = error_of(vulkan.EnumeratePhysicalDevices(instance, &count, nullptr), "while finding devices")) {
    return error;
  }
  std::vector<VkPhysicalDevice> devices(count);
  const VkResult result = vulkan.EnumeratePhysicalDevices(instance, &count, devices.data());
  if (result != VK_INCOMPLETE) {
    if (auto error = error_of(result, "while finding devices")) return error;
  }
  devices.resize(count);
  for (VkPhysicalDevice one : devices) {
    DeviceReport its_report;
    vulkan.GetPhysicalDeviceProperties(one, &its_report.properties);
    vulkan.GetPhysicalDeviceMemoryProperties(one, &its_report.memory);
    std::uint32_t families = 0;
    vulkan.GetPhysicalDeviceQueueFamilyProperties(one, &families, nullptr);
    its_report.families.resize(families);
    vulkan.GetPhysicalDeviceQueueFamilyProperties(one, &families, its_report.families.data());
    found.emplace_back(one, its_report);
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& x, const auto& y) {
    return description_of(x.second).kind < description_of(y.second).kind;
  });
  return std::nullopt;
}

std::optional<GpuError> GpuDeviceState::open(VkPhysicalDevice chosen, const DeviceReport& its_report) {
  report = its_report;
  name = report.properties.deviceName;
  if (const std::string missing = missing_of(report); !missing.empty()) {
    return GpuError(GpuError::Reason::missing_feature, name + " cannot be used: it lacks " + missing);
  }
  const std::uint32_t family = *computing_family(report);
  const float priority = 1;
  auto queue = of_type<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
  queue.queueFamilyIndex = family;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  auto info = of_type<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  VkDevice opened = VK_NULL_HANDLE;
  if (auto error = error_of(vulkan.CreateDevice(chosen, &info, nullptr, &opened), "while opening " + name))
    return error;
  if (auto error = vulkan.load(opened)) {
    if (vulkan.DestroyDevice != nullptr) vulkan.DestroyDevice(opened, nullptr);
    return error;
  }
  device = opened;
  vulkan.GetDeviceQueue(device, family, 0, &queue_);

  auto pool = of_type<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
  pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
  pool.queueFamilyIndex = family;
  const VkResult made = vulkan.CreateCommandPool(device, &pool, nullptr, &commands_);
  if (auto error = error_of(made, "while opening " + name, commands_)) return error;
  if (auto error = make_layouts()) return error;
  if (auto error = make_pipeline(GpuTask::roundings, roundings_spirv)) return error;
  if (auto error = make_slots()) return error;

  const std::vector<RoundingCase> cases = rounding_cases();
  std::vector<RoundingResult> results(cases.size());
  if (auto error = round(cases, results)) return error;
  if (const auto fault = rounding_fault(cases, results)) {
    return GpuError(GpuError::Reason::missing_feature, name + " cannot be used: " + *fault);
  }
  if (auto error = make_pipeline(GpuTask::any_hits, tree_walk_spirv)) return error;
  return make_pipeline(GpuTask::first_hits, tree_walk_spirv);
}

std::optional<GpuError> GpuDeviceState::make_layouts() {
  std::array<VkDescriptorSetLayoutBinding, buffer_count> bindings = {};
  for (std::uint32_t i = 0; i < buffer_count; ++i) {
    bindings[i] = {i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
  }
  auto set = of_type<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
  set.bindingCount = buffer_count;
  set.pBindings = bindings.data();
  const VkResult made = vulkan.CreateDescriptorSetLayout(device, &set, nullptr, &set_layout_);
  if (auto error = error_of(made, "while opening " + name, set_layout_)) return error;
  const VkPushConstantRange words = {VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(PushedWords)};
  auto info = of_type<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
  info.setLayoutCount = 1;
  info.pSetLayouts = &set_layout_;
  info.pushConstantRangeCount = 1;
  info.pPushConstantRanges = &words;
  return error_of(vulkan.CreatePipelineLayout(device, &info, nullptr, &layout_), "while opening " + name, layout_);
}

std::optional<GpuError> GpuDeviceState::make_pipeline(GpuTask task, std::span<const std::uint32_t> shader) {
  auto source = of_type<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
  source.codeSize = shader.size_bytes();
  source.pCode = shader.data();
  VkShaderModule compiled = VK_NULL_HANDLE;
  const std::string what = "while compiling a shader for " + name;
  if (auto error = error_of(vulkan.CreateShaderModule(device, &source, nullptr, &compiled), what)) return error;
  const std::uint32_t wants_first = task == GpuTask::first_hits ? 1 : 0;
  const VkSpecializationMapEntry entry = {0, 0, sizeof wants_first};
  const VkSpecializationInfo constants = {1, &entry, sizeof wants_first, &wants_first};
  auto info = of_type<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = compiled;
  info.stage.pName = "main";
  info.stage.pSpecializationInfo = task == GpuTask::roundings ? nullptr : &constants;
  info.layout = layout_;
  VkPipeline& pipeline = pipelines_[static_cast<std::size_t>(task)];
  const VkResult made = vulkan.CreateComputePipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline);
  vulkan.DestroyShaderModule(device, compiled, nullptr);
  return error_of(made, what, pipeline);
}

std::optional<GpuError> GpuDeviceState::make_slots() {
  const std::string what = "while opening " + name;
  const auto slot_count = static_cast<std::uint32_t>(slots.size());
  const VkDescriptorPoolSize sizes = {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, buffer_count * slot_count};
  auto pool = of_type<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
  pool.maxSets = slot_count;
  pool.poolSizeCount = 1;
  pool.pPoolSizes = &sizes;
  if (auto error = error_of(vulkan.CreateDescriptorPool(device, &pool, nullptr, &sets_), what, sets_)) return error;
  for (GpuSlot& slot : slots) {
    auto commands = of_type<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
    commands.commandPool = commands_;
    commands.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    commands.commandBufferCount = 1;
    if (auto error = error_of(vulkan.AllocateCommandBuffers(device, &commands, &slot.commands), what)) return error;
    auto set = of_type<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
    set.descriptorPool = sets_;
    set.descriptorSetCount = 1;
    set.pSetLayouts = &set_layout_;
    if (auto error = error_of(vulkan.AllocateDescriptorSets(device, &set, &slot.buffers), what)) return error;
    const auto fence = of_type<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
    const VkResult made = vulkan.CreateFence(device, &fence, nullptr, &slot.fence);
    if (auto error = error_of(made, what, slot.fence)) return error;
    struct Wanted {
      GpuBuffer *on_host, *on_device;
      std::size_t size;
    };
    for (const Wanted& wanted : {Wanted{&slot.host_paths, &slot.paths, sizeof(float[6])},
                                 Wanted{&slot.host_limits, &slot.limits, sizeof(PathLimits)},
                                 Wanted{&slot.host_answers, &slot.answers, sizeof(DeviceHit)}}) {
      const std::size_t bytes = wanted.size * paths_in_dispatch;
      if (auto error = wanted.on_host->make(*this, bytes, GpuBuffer::Place::host, "a batch")) return error;
      if (auto error = wanted.on_device->make(*this, bytes, GpuBuffer::Place::device, "a batch")) return error;
    }
  }
  return std::nullopt;
}

void GpuDeviceState::bind(const GpuSlot& slot, VkBuffer nodes, VkBuffer triangles) const {
  std::array<VkDescriptorBufferInfo, buffer_count> infos;
  std::array<VkWriteDescriptorSet, buffer_count> writes;
  const std::array<VkBuffer, buffer_count> all = {nodes, triangles, slot.paths.get(), slot.limits.get(),
                                                  slot.answers.get()};
  for (std::uint32_t i = 0; i < buffer_count; ++i) {
    infos[i] = {all[i], 0, VK_WHOLE_SIZE};
    writes[i] = of_type<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
    writes[i].dstSet = slot.buffers;
    writes[i].dstBinding = i;
    writes[i].descriptorCount = 1;
    writes[i].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    writes[i].pBufferInfo = &infos[i];
  }
  vulkan.UpdateDescriptorSets(device, buffer_count, writes.data(), 0, nullptr);
}

std::optional<GpuError> GpuDeviceState::submit(const GpuSlot& slot, GpuTask task, const PushedWords& pushed,
                                               std::size_t path_bytes, std::size_t limit_bytes,
                                               std::size_t answer_bytes) {
  auto begin = of_type<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  if (auto error = noted(vulkan.BeginCommandBuffer(slot.commands, &begin), while_beginning)) return error;
  // Nothing throws until the commands end, because those of the next batch cannot begin before.
  const auto copy = [&](const GpuBuffer& from, const GpuBuffer& to, std::size_t bytes) {
    if (bytes == 0) return;
    const VkBufferCopy region = {0, 0, bytes};
    vulkan.CmdCopyBuffer(slot.commands, from.get(), to.get(), 1, &region);
  };
  // Each stage waits for the whole one before it.
  const auto wait_for = [&](VkPipelineStageFlags before, VkAccessFlags written, VkPipelineStageFlags after,
                            VkAccessFlags read) {
    auto barrier = of_type<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
    barrier.srcAccessMask = written;
    barrier.dstAccessMask = read;
    vulkan.CmdPipelineBarrier(slot.commands, before, after, 0, 1, &barrier, 0, nullptr, 0, nullptr);
  };
  copy(slot.host_paths, slot.paths, path_bytes);
  copy(slot.host_limits, slot.limits, limit_bytes);
  wait_for(VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
           VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT);
  vulkan.CmdBindPipeline(slot.commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipelines_[static_cast<std::size_t>(task)]);
  vulkan.CmdBindDescriptorSets(slot.commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1, &slot.buffers, 0, nullptr);
  vulkan.CmdPushConstants(slot.commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof pushed, &pushed);
  vulkan.CmdDispatch(slot.commands, (pushed.path_count + threads_in_group - 1) / threads_in_group, 1, 1);
  wait_for(VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT,
           VK_ACCESS_TRANSFER_READ_BIT);
  copy(slot.answers, slot.host_answers, answer_bytes);
  wait_for(VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_HOST_BIT,
           VK_ACCESS_HOST_READ_BIT);
  return run(slot);
}

std::optional<GpuError> GpuDeviceState::run(const GpuSlot& slot) {
  if (auto error = noted(vulkan.EndCommandBuffer(slot.commands), while_beginning)) return error;
  auto work = of_type<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
  work.commandBufferCount = 1;
  work.pCommandBuffers = &slot.commands;
  return noted(vulkan.QueueSubmit(queue_, 1, &work, slot.fence), while_beginning);
}

std::optional<GpuError> GpuDeviceState::wait(const GpuSlot& slot) {
  const char* const what = "while a batch was under way";
  if (auto error = noted(vulkan.WaitForFences(device, 1, &slot.fence, VK_TRUE, two_minutes), what)) return error;
  return noted(vulkan.ResetFences(device, 1, &slot.fence), what);
}

void GpuDeviceState::abandon() noexcept {
  if (is_lost) return;
  VkResult result = vulkan.DeviceWaitIdle(device);
  for (const GpuSlot& slot : slots) {
    if (result == VK_SUCCESS) result = vulkan.ResetFences(device, 1, &slot.fence);
  }
  is_lost = result != VK_SUCCESS;
}

std::optional<GpuError> GpuDeviceState::noted(VkResult result, const char* what) {
  // Before the text of the error, which may find no memory.
  if (result == VK_ERROR_DEVICE_LOST || result == VK_TIMEOUT) is_lost = true;
  return error_of(result, what);
}

std::optional<GpuError> GpuDeviceState::upload(std::span<const std::byte> bytes, const GpuBuffer& to) {
  const GpuSlot& slot = slots[0];
  for (std::size_t first = 0; first < bytes.size(); first += slot.host_paths.size()) {
    const std::size_t count = std::min(slot.host_paths.size(), bytes.size() - first);
    std::memcpy(slot.host_paths.data(), bytes.data() + first, count);
    auto begin = of_type<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    const VkResult begun = vulkan.BeginCommandBuffer(slot.commands, &begin);
    if (auto error = noted(begun, "while uploading a mesh")) return error;
    const VkBufferCopy region = {0, first, count};
    vulkan.CmdCopyBuffer(slot.commands, slot.host_paths.get(), to.get(), 1, &region);
    auto barrier = of_type<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
    barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_SHADER_READ_BIT;
    vulkan.CmdPipelineBarrier(slot.commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, 0, 1,
                              &barrier, 0, nullptr, 0, nullptr);
    if (auto error = run(slot)) return error;
    if (auto error = wait(slot)) return error;
  }
  return std::nullopt;
}

std::optional<GpuError> GpuDeviceState::round(std::span<const RoundingCase> cases, std::span<RoundingResult> results) {
  const GpuSlot& slot = slots[0];
  std::memcpy(slot.host_paths.data(), cases.data(), cases.size_bytes());
  bind(slot, slot.limits.get(), slot.limits.get());  // The shader reads no mesh.
  const auto count = static_cast<std::uint32_t>(cases.size());
  if (auto error = submit(slot, GpuTask::roundings, {count, 0, 0, 0}, cases.size_bytes(), 0, results.size_bytes())) {
    return error;
  }
  if (auto error = wait(slot)) return error;
  std::memcpy(results.data(), slot.host_answers.data(), results.size_bytes());
  return std::nullopt;
}

}  // namespace surehit::detail
