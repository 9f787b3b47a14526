#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gpu/gpu_device_state.hpp"
#include "support/floating_point_environment.hpp"
#include "surehit/gpu.hpp"

namespace surehit {

GpuResult GpuDevice::try_list(std::vector<GpuDescription>& descriptions) {
  descriptions.clear();
  detail::GpuDeviceState state;
  std::vector<detail::FoundDevice> found;
  auto error = state.start();
  if (!error) error = state.find(found);
  if (error && error->reason == GpuError::Reason::no_device) return {};  // A loader without a driver.
  if (error) return *error;
  for (const auto& [device, report] : found) descriptions.push_back(detail::description_of(report));
  return {};
}

GpuResult GpuDevice::try_open(const GpuChoice& choice) {
  const FloatingPointEnvironment environment;
  auto state = std::make_shared<detail::GpuDeviceState>();
  std::vector<detail::FoundDevice> found;
  if (auto error = state->start()) return *error;
  if (auto error = state->find(found)) return *error;
  const GpuError::Reason no_device = GpuError::Reason::no_device;
  if (found.empty()) return GpuError(no_device, "Vulkan has found no device; a driver may not be installed");
  std::vector<detail::FoundDevice> chosen;
  std::string refused;
  for (const auto& [device, report] : found) {
    const GpuDescription description = detail::description_of(report);
    const bool is_chosen = choice.name.empty() ? description.kind != GpuKind::software || choice.takes_software
                                               : description.name.find(choice.name) != std::string::npos;
    if (is_chosen) {
      chosen.emplace_back(device, report);
    } else {
      refused += (refused.empty() ? "" : ", ") + description.name;
    }
  }
  if (!chosen.empty()) {
    if (auto error = state->open_first(chosen)) return *error;
    state_ = std::move(state);
    return {};
  }
  if (choice.name.empty()) {
    return GpuError(no_device, "Vulkan has no device but software: " + refused + "; a name or takes_software opens it");
  }
  return GpuError(no_device, "Vulkan has no device with " + choice.name + " in its name; there is " + refused);
}

GpuResult GpuDevice::try_adopt(const GpuHandles& given) {
  const FloatingPointEnvironment environment;
  auto state = std::make_shared<detail::GpuDeviceState>();
  if (auto error = state->adopt(given)) return *error;
  state_ = std::move(state);
  return {};
}

GpuHandles GpuDevice::handles() const noexcept { return state_->handles(); }

const std::string& GpuDevice::name() const noexcept { return state_->name; }

}  // namespace surehit
