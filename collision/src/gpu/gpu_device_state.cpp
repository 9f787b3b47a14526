#include "gpu/gpu_device_state.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <utility>

#include "gpu/device_answers.hpp"
#include "gpu/path_limits.hpp"
#include "gpu/scene_check.hpp"
#include "gpu/walk_check.hpp"
#include "roundings.spv.hpp"
#include "scene_walk.spv.hpp"
#include "tree_walk.spv.hpp"

namespace surehit::detail {
namespace {

constexpr const char* while_beginning = "while beginning a batch";

GpuError unusable(const std::string& device_name, const std::string& fault) {
  return {GpuError::Reason::missing_feature, device_name + " cannot be used: " + fault};
}
GpuError lacking(const std::string& device_name, const std::string& missing) {
  return unusable(device_name, "it lacks " + missing);
}

/// Returns the copy of the first bytes of a buffer.
GpuCopy copy_of(const GpuBuffer& from, const GpuBuffer& to, std::size_t bytes, std::size_t to_offset = 0) {
  return {from.get(), to.get(), {0, to_offset, bytes}};
}

}  // namespace

GpuDeviceState::~GpuDeviceState() {
  if (!close()) return;
  if (instance != VK_NULL_HANDLE && !is_adopted) vulkan.DestroyInstance(instance, nullptr);
}

bool GpuDeviceState::close() noexcept {
  if (device == VK_NULL_HANDLE) return true;
  if (!has_returned()) {
    forget();
    return false;
  }
  pairs.clear();
  for (GpuPipelines& pipelines : pipelines_) {
    for (VkPipeline pipeline : {pipelines.quick, pipelines.whole}) vulkan.DestroyPipeline(device, pipeline, nullptr);
    pipelines = {};
  }
  vulkan.DestroyPipelineLayout(device, std::exchange(layout_, VkPipelineLayout{VK_NULL_HANDLE}), nullptr);
  vulkan.DestroyDescriptorSetLayout(device, std::exchange(set_layout_, VkDescriptorSetLayout{VK_NULL_HANDLE}), nullptr);
  if (!is_adopted) vulkan.DestroyDevice(device, nullptr);
  device = VK_NULL_HANDLE;
  copy_queues_ = {};
  takes_scenes_ = false;
  is_lost = false;
  return true;
}

std::optional<GpuError> GpuDeviceState::start(std::span<const char* const> loaders) {
  if (auto error = vulkan.open_loader(loaders)) return error;
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

std::optional<GpuError> GpuDeviceState::find(std::vector<FoundDevice>& found) const {
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
  for (VkPhysicalDevice one : devices) found.emplace_back(one, report_of(one));
  std::stable_sort(found.begin(), found.end(), [](const auto& x, const auto& y) {
    return description_of(x.second).kind < description_of(y.second).kind;
  });
  return std::nullopt;
}

DeviceReport GpuDeviceState::report_of(VkPhysicalDevice one) const {
  DeviceReport its_report;
  vulkan.GetPhysicalDeviceProperties(one, &its_report.properties);
  vulkan.GetPhysicalDeviceMemoryProperties(one, &its_report.memory);
  std::uint32_t families = 0;
  vulkan.GetPhysicalDeviceQueueFamilyProperties(one, &families, nullptr);
  its_report.families.resize(families);
  vulkan.GetPhysicalDeviceQueueFamilyProperties(one, &families, its_report.families.data());
  return its_report;
}

std::optional<GpuError> GpuDeviceState::open_first(std::span<const FoundDevice> found) {
  std::optional<GpuError> of_first;
  for (const auto& [one, its_report] : found) {
    auto error = open(one, its_report);
    if (!error) return std::nullopt;
    if (!of_first) of_first = std::move(error);
    if (!close()) break;
  }
  return of_first;
}

std::optional<GpuError> GpuDeviceState::open(VkPhysicalDevice chosen, const DeviceReport& its_report) {
  physical_ = chosen;
  report = its_report;
  name = report.properties.deviceName;
  if (const std::string missing = missing_of(report); !missing.empty()) return lacking(name, missing);
  families_[0] = *computing_family(report);
  const std::optional<std::uint32_t> copying = copying_family(report);
  families_[1] = copying.value_or(families_[0]);
  const float priorities[] = {1, 1};
  std::array<VkDeviceQueueCreateInfo, 2> queues;
  for (std::size_t i = 0; i < queues.size(); ++i) {
    queues[i] = of_type<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
    queues[i].queueFamilyIndex = families_[i];
    queues[i].queueCount = i == 0 ? 1 : 2;
    queues[i].pQueuePriorities = priorities;
  }
  auto info = of_type<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
  info.queueCreateInfoCount = copying ? 2 : 1;
  info.pQueueCreateInfos = queues.data();
  VkDevice opened = VK_NULL_HANDLE;
  if (auto error = error_of(vulkan.CreateDevice(chosen, &info, nullptr, &opened), "while opening " + name))
    return error;
  if (auto error = vulkan.load(opened)) {
    if (vulkan.DestroyDevice != nullptr) vulkan.DestroyDevice(opened, nullptr);
    return error;
  }
  device = opened;
  vulkan.GetDeviceQueue(device, families_[0], 0, &queue_);
  for (std::uint32_t i = 0; copying && i < copy_queues_.size(); ++i) {
    vulkan.GetDeviceQueue(device, *copying, i, &copy_queues_[i]);
  }
  return prepare();
}

std::optional<GpuError> GpuDeviceState::adopt(const GpuHandles& given) {
  struct Part {
    bool is_there;
    const char* name;
  };
  for (const Part& part :
       {Part{given.get_instance_proc_addr != nullptr, "vkGetInstanceProcAddr"},
        Part{given.instance != nullptr, "instance"}, Part{given.physical_device != nullptr, "physical device"},
        Part{given.device != nullptr, "device"}, Part{given.queue != nullptr, "queue"}}) {
    if (!part.is_there) {
      return GpuError(GpuError::Reason::no_device, std::string("the handles of a device have no ") + part.name);
    }
  }
  is_adopted = true;
  vulkan.GetInstanceProcAddr = reinterpret_cast<PFN_vkGetInstanceProcAddr>(given.get_instance_proc_addr);
  instance = static_cast<VkInstance>(given.instance);
  if (auto error = vulkan.load(instance)) return error;
  physical_ = static_cast<VkPhysicalDevice>(given.physical_device);
  report = report_of(physical_);
  name = report.properties.deviceName;
  if (const std::string missing = missing_of(report); !missing.empty()) return lacking(name, missing);
  families_[0] = given.queue_family;
  if (families_[0] >= report.families.size() ||
      (report.families[families_[0]].queueFlags & VK_QUEUE_COMPUTE_BIT) == 0) {
    return lacking(name, "a queue that computes in family " + std::to_string(families_[0]));
  }
  if (auto error = vulkan.load(static_cast<VkDevice>(given.device))) return error;
  device = static_cast<VkDevice>(given.device);
  queue_ = static_cast<VkQueue>(given.queue);
  return prepare();
}

GpuHandles GpuDeviceState::handles() const {
  return {reinterpret_cast<void (*)()>(vulkan.GetInstanceProcAddr), instance, physical_, device, queue_, families_[0]};
}

std::optional<GpuError> GpuDeviceState::prepare() {
  // A batch has two slots, and may have a 32nd of the device's memory.
  dispatch_size.set_limit(description_of(report).memory_bytes / 32 / (2 * GpuSlot::bytes_for_path));
  if (auto error = make_layouts()) return error;
  VkPipeline& roundings = pipelines_of(GpuTask::roundings).whole;
  if (auto error = make_pipeline(GpuTask::roundings, roundings_spirv, false, roundings)) return error;
  if (auto error = check_roundings()) return error;
  if (auto error = make_pipelines(GpuTask::any_hits, tree_walk_spirv)) return error;
  if (auto error = make_pipelines(GpuTask::first_hits, tree_walk_spirv)) return error;
  return WalkCheck::is_on ? check_walk() : std::nullopt;
}

std::optional<GpuError> GpuDeviceState::check_roundings() {
  const std::vector<RoundingCase> cases = rounding_cases();
  std::vector<RoundingResult> results(cases.size());
  GpuWork work(*this);
  if (auto error = work.begin(nullptr)) return error;
  if (auto error = round(work.slots()[0], cases, results)) return error;
  if (const auto fault = rounding_fault(cases, results)) return unusable(name, *fault);
  return std::nullopt;
}

std::optional<GpuError> GpuDeviceState::check_walk() {
  const WalkCheck check;
  const auto mesh = std::make_shared<GpuMesh>();
  GpuWork work(*this);
  if (auto error = work.begin(mesh)) return error;
  if (auto error = work.upload(std::as_bytes(std::span(check.tree.nodes)), "the nodes of a check", *mesh->nodes)) {
    return error;
  }
  if (auto error =
          work.upload(std::as_bytes(std::span(check.tree.triangles)), "the triangles of a check", *mesh->triangles)) {
    return error;
  }
  return check_answers(check, *mesh, work.slots()[0], GpuTask::first_hits, GpuTask::any_hits);
}

std::optional<GpuError> GpuDeviceState::check_scenes() {
  const SceneCheck check;
  const auto mesh = std::make_shared<GpuMesh>();
  GpuWork work(*this);
  if (auto error = work.begin(mesh)) return error;
  const auto upload = [&](const auto& all, const char* what, GpuBuffer& buffer) {
    return work.upload(std::as_bytes(std::span(all)), what, buffer);
  };
  if (auto error = upload(check.mesh.tree.nodes, "the nodes of a check", *mesh->nodes)) return error;
  if (auto error = upload(check.mesh.tree.triangles, "the triangles of a check", *mesh->triangles)) return error;
  if (auto error = upload(check.tree.nodes, "the nodes of a scene of a check", mesh->scene_nodes)) return error;
  if (auto error = upload(check.tree.instances, "the instances of a check", mesh->instances)) return error;
  return check_answers(check, *mesh, work.slots()[0], GpuTask::scene_first_hits, GpuTask::scene_any_hits);
}

template <typename Check>
std::optional<GpuError> GpuDeviceState::check_answers(const Check& check, const GpuMesh& mesh, GpuSlot& slot,
                                                      GpuTask first_hits, GpuTask any_hits) {
  std::vector<typename Check::DeviceFirst> hits(check.paths.size());
  std::vector<DeviceAny> blocked(check.paths.size());
  const PathLimits limits = check.limits();
  const auto ask = [&](GpuTask task, auto& answers) {
    return walk(slot, mesh, check.paths, limits, task, std::as_writable_bytes(std::span(answers)));
  };
  if (auto error = ask(first_hits, hits)) return error;
  if (auto error = ask(any_hits, blocked)) return error;
  if (const auto fault = check.fault(hits, blocked)) return unusable(name, *fault);
  return std::nullopt;
}

std::optional<GpuError> GpuDeviceState::prepare_scenes() {
  if (!has_buffers_for_scenes(report)) {
    return GpuError(GpuError::Reason::missing_feature, name + " takes no scenes: it lacks eight buffers for a shader");
  }
  const std::lock_guard lock(scenes_mutex_);
  if (takes_scenes_) return std::nullopt;
  for (const GpuTask task : {GpuTask::scene_any_hits, GpuTask::scene_first_hits}) {
    if (auto error = make_pipelines(task, scene_walk_spirv)) return error;
  }
  if (WalkCheck::is_on) {
    if (auto error = check_scenes()) return error;
  }
  takes_scenes_ = true;
  return std::nullopt;
}

std::uint32_t GpuDeviceState::buffer_count() const {
  return has_buffers_for_scenes(report) ? buffers_for_scenes : buffers_for_meshes;
}

std::optional<GpuError> GpuDeviceState::make_layouts() {
  std::array<VkDescriptorSetLayoutBinding, buffers_for_scenes> bindings = {};
  for (std::uint32_t i = 0; i < buffer_count(); ++i) {
    bindings[i] = {i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
  }
  auto set = of_type<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
  set.bindingCount = buffer_count();
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

std::optional<GpuError> GpuDeviceState::make_pipelines(GpuTask task, std::span<const std::uint32_t> shader) {
  auto& [quick, whole] = pipelines_of(task);
  if (quick == VK_NULL_HANDLE) {
    if (auto error = make_pipeline(task, shader, true, quick)) return error;
  }
  return whole == VK_NULL_HANDLE ? make_pipeline(task, shader, false, whole) : std::nullopt;
}

std::optional<GpuError> GpuDeviceState::make_pipeline(GpuTask task, std::span<const std::uint32_t> shader,
                                                      bool is_quick, VkPipeline& pipeline) {
  auto source = of_type<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
  source.codeSize = shader.size_bytes();
  source.pCode = shader.data();
  VkShaderModule compiled = VK_NULL_HANDLE;
  const std::string what = "while compiling a shader for " + name;
  if (auto error = error_of(vulkan.CreateShaderModule(device, &source, nullptr, &compiled), what)) return error;
  const std::uint32_t values[] = {task == GpuTask::first_hits || task == GpuTask::scene_first_hits ? 1U : 0U,
                                  is_quick ? 1U : 0U};
  const VkSpecializationMapEntry entries[] = {{0, 0, sizeof values[0]}, {1, sizeof values[0], sizeof values[1]}};
  const VkSpecializationInfo constants = {2, entries, sizeof values, values};
  auto info = of_type<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = compiled;
  info.stage.pName = "main";
  info.stage.pSpecializationInfo = task == GpuTask::roundings ? nullptr : &constants;
  info.layout = layout_;
  const VkResult made = vulkan.CreateComputePipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline);
  vulkan.DestroyShaderModule(device, compiled, nullptr);
  return error_of(made, what, pipeline);
}

void GpuDeviceState::bind(const GpuSlot& slot, const std::array<VkBuffer, 4>& of_mesh, const GpuRange& paths,
                          const GpuRange& answers) const {
  std::array<VkDescriptorBufferInfo, buffers_for_scenes> infos;
  std::array<VkWriteDescriptorSet, buffers_for_scenes> writes;
  const std::array<GpuRange, buffers_for_scenes> all = {GpuRange{of_mesh[0]},
                                                        GpuRange{of_mesh[1]},
                                                        paths,
                                                        GpuRange{slot.limits.get()},
                                                        answers,
                                                        GpuRange{slot.list.get()},
                                                        GpuRange{of_mesh[2]},
                                                        GpuRange{of_mesh[3]}};
  for (std::uint32_t i = 0; i < buffer_count(); ++i) {
    infos[i] = {all[i].buffer, all[i].offset, all[i].size};
    writes[i] = of_type<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
    writes[i].dstSet = slot.buffers;
    writes[i].dstBinding = i;
    writes[i].descriptorCount = 1;
    writes[i].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    writes[i].pBufferInfo = &infos[i];
  }
  vulkan.UpdateDescriptorSets(device, buffer_count(), writes.data(), 0, nullptr);
}

std::optional<GpuError> GpuDeviceState::submit(GpuSlot& slot, std::span<const GpuCopy> before,
                                               const GpuDispatch* dispatch, std::span<const GpuCopy> after,
                                               bool waits_for_all) {
  if (is_lost) return lost;
  const GpuCommands commands(vulkan, slot.commands);
  if (auto error = noted(commands.begin(), while_beginning)) return error;
  // Nothing throws until the commands end, because those of the next batch cannot begin before.
  if (waits_for_all) commands.wait_for_queue();
  commands.copy(before);
  if (dispatch != nullptr) {
    commands.dispatch(slot, pipelines_of(dispatch->task), layout_, dispatch->words);
    commands.wait_for_shader();
  }
  commands.copy(after);
  if (auto error = noted(commands.end(), while_beginning)) return error;
  const GpuPart whole = {queue_, slot.commands, VK_NULL_HANDLE, VK_NULL_HANDLE};
  return begin_work(slot, dispatch, {&whole, 1});
}

std::optional<GpuError> GpuDeviceState::submit_apart(GpuSlot& slot, std::span<const GpuCopy> before,
                                                     const GpuDispatch& dispatch, std::span<const GpuCopy> after) {
  if (!copies_apart()) return submit(slot, before, &dispatch, after);
  if (is_lost) return lost;
  // One after the other, so that none is left half written.
  const auto written = [&](const GpuCommands& commands, const auto& write) -> std::optional<GpuError> {
    if (auto error = noted(commands.begin(), while_beginning)) return error;
    write(commands);
    return noted(commands.end(), while_beginning);
  };
  constexpr auto only_copies = GpuCommands::Queue::only_copies;
  const auto copies_of = [](std::span<const GpuCopy> copies) {
    return [copies](const GpuCommands& commands) { commands.copy(copies); };
  };
  const auto computes = [&](const GpuCommands& commands) {
    commands.dispatch(slot, pipelines_of(dispatch.task), layout_, dispatch.words);
  };
  if (auto error = written({vulkan, slot.commands_there, only_copies}, copies_of(before))) return error;
  if (auto error = written({vulkan, slot.commands}, computes)) return error;
  if (auto error = written({vulkan, slot.commands_back, only_copies}, copies_of(after))) return error;
  const GpuPart parts[] = {{copy_queues_[0], slot.commands_there, VK_NULL_HANDLE, slot.is_there},
                           {queue_, slot.commands, slot.is_there, slot.is_computed},
                           {copy_queues_[1], slot.commands_back, slot.is_computed, VK_NULL_HANDLE}};
  return begin_work(slot, &dispatch, parts);
}

std::optional<GpuError> GpuDeviceState::begin_work(GpuSlot& slot, const GpuDispatch* dispatch,
                                                   std::span<const GpuPart> parts) {
  slot.dispatched = dispatch == nullptr ? 0 : dispatch->words.path_count;
  slot.begun = std::chrono::steady_clock::now();
  const std::lock_guard lock(queue_mutex_);
  for (const GpuPart& part : parts) {
    const bool is_last = &part == &parts.back();
    constexpr VkPipelineStageFlags all_commands = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
    auto work = of_type<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
    work.commandBufferCount = 1;
    work.pCommandBuffers = &part.commands;
    work.waitSemaphoreCount = part.begins == VK_NULL_HANDLE ? 0 : 1;
    work.pWaitSemaphores = &part.begins;
    work.pWaitDstStageMask = &all_commands;
    work.signalSemaphoreCount = part.ends == VK_NULL_HANDLE ? 0 : 1;
    work.pSignalSemaphores = &part.ends;
    const VkResult begun = vulkan.QueueSubmit(part.queue, 1, &work, is_last ? slot.fence : VK_NULL_HANDLE);
    slot.is_under_way = slot.is_under_way || begun == VK_SUCCESS;
    if (begun == VK_SUCCESS) continue;
    if (slot.is_under_way) is_lost = true;  // No fence tells when the parts end that were taken.
    return noted(begun, while_beginning);
  }
  return std::nullopt;
}

std::optional<GpuError> GpuDeviceState::noted(VkResult result, const char* what) {
  // Before the text of the error, which may find no memory.
  if (result == VK_ERROR_DEVICE_LOST || result == VK_TIMEOUT) is_lost = true;
  return error_of(result, what);
}

std::optional<GpuError> GpuDeviceState::upload(GpuSlot& slot, std::span<const std::byte> bytes, const char* what,
                                               GpuBuffer& buffer) {
  const std::uint64_t max = report.properties.limits.maxStorageBufferRange;
  if (bytes.size() > max) {
    return GpuError(GpuError::Reason::too_large, std::string(what) + " take " + std::to_string(bytes.size()) +
                                                     " bytes, and a buffer of " + name + " has at most " +
                                                     std::to_string(max));
  }
  if (auto error = buffer.make(*this, bytes.size(), GpuBuffer::Place::device, what)) return error;
  return upload(slot, bytes, buffer);
}

std::optional<GpuError> GpuDeviceState::upload(GpuSlot& slot, std::span<const std::byte> bytes, const GpuBuffer& to) {
  constexpr std::size_t bytes_at_once = std::size_t{4} << 20;
  const GpuRoom room = {&slot.host_paths, GpuBuffer::Place::host, std::min(bytes.size(), bytes_at_once)};
  if (auto error = make_room({&room, 1})) return error;
  for (std::size_t first = 0; first < bytes.size(); first += slot.host_paths.size()) {
    const std::size_t count = std::min(slot.host_paths.size(), bytes.size() - first);
    std::memcpy(slot.host_paths.data(), bytes.data() + first, count);
    const GpuCopy copy = copy_of(slot.host_paths, to, count, first);
    if (auto error = submit(slot, {&copy, 1}, nullptr, {})) return error;
    if (auto error = wait(slot)) return error;
  }
  return std::nullopt;
}

std::optional<GpuError> GpuDeviceState::round(GpuSlot& slot, std::span<const RoundingCase> cases,
                                              std::span<RoundingResult> results) {
  if (auto error = make_room(slot.rooms(cases.size_bytes(), 0, results.size_bytes(), 0))) return error;
  std::memcpy(slot.host_paths.data(), cases.data(), cases.size_bytes());
  // The shader reads no mesh.
  VkBuffer unread = slot.limits.get();
  bind(slot, {unread, unread, unread, unread}, {slot.paths.get()}, {slot.answers.get()});
  const GpuDispatch dispatch = {GpuTask::roundings, {static_cast<std::uint32_t>(cases.size()), 0, 0, 0, 0}};
  const GpuCopy there = copy_of(slot.host_paths, slot.paths, cases.size_bytes());
  const GpuCopy back = copy_of(slot.answers, slot.host_answers, results.size_bytes());
  if (auto error = submit(slot, {&there, 1}, &dispatch, {&back, 1})) return error;
  if (auto error = wait(slot)) return error;
  std::memcpy(results.data(), slot.host_answers.data(), results.size_bytes());
  return std::nullopt;
}

std::optional<GpuError> GpuDeviceState::walk(GpuSlot& slot, const GpuMesh& mesh, std::span<const Segmentf> paths,
                                             const PathLimits& limits, GpuTask task, std::span<std::byte> answers) {
  if (auto error = make_room(slot.rooms(paths.size_bytes(), sizeof limits, answers.size_bytes(), paths.size()))) {
    return error;
  }
  std::memcpy(slot.host_paths.data(), paths.data(), paths.size_bytes());
  std::memcpy(slot.host_limits.data(), &limits, sizeof limits);
  slot.clear_list();
  bind(slot, mesh.buffers(), {slot.paths.get()}, {slot.answers.get()});
  const GpuDispatch dispatch = {task, {static_cast<std::uint32_t>(paths.size()), 1, 0, max_path_steps, 0}};
  const GpuCopy there[] = {copy_of(slot.host_paths, slot.paths, paths.size_bytes()),
                           copy_of(slot.host_limits, slot.limits, sizeof limits),
                           copy_of(slot.host_list, slot.list, sizeof(ListedCounts))};
  const GpuCopy back = copy_of(slot.answers, slot.host_answers, answers.size_bytes());
  if (auto error = submit(slot, there, &dispatch, {&back, 1})) return error;
  if (auto error = wait(slot)) return error;
  std::memcpy(answers.data(), slot.host_answers.data(), answers.size_bytes());
  return std::nullopt;
}

}  // namespace surehit::detail
