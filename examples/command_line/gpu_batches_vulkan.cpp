#include <mutex>
#include <surehit/gpu.hpp>
#include <surehit/gpu_scene.hpp>
#include <type_traits>

#include "command_line/gpu_batches.hpp"
#include "command_line/gpu_record.hpp"

namespace surehit::example {

template <typename Asked>
struct GpuBatchesOf<Asked>::State {
  using OnGpu = std::conditional_t<std::is_same_v<Asked, Scenef>, GpuScene, GpuCollider>;

  State(const Asked& asked, const std::string& name) : device(GpuDevice::open({.name = name})) {
    if constexpr (std::is_same_v<Asked, Scenef>) {
      on_gpu = GpuScene(device, asked.snapshot());
    } else {
      on_gpu = GpuCollider(device, asked);
    }
  }

  /// `question(options)` asks the device with these options.
  template <typename Question>
  void ask(const Question& question) {
    GpuStatistics statistics;
    const GpuBatchResult result = question(GpuBatchOptions{.goes_on_without_device = true, .statistics = &statistics});
    if (!result) throw GpuError(*result.error);
    const std::lock_guard lock(mutex);
    add(result, statistics, counts);
  }

  GpuDevice device;
  OnGpu on_gpu;
  std::mutex mutex;
  GpuCounts counts;
};

template <typename Asked>
GpuBatchesOf<Asked>::GpuBatchesOf(const Asked& asked, const std::string& name)
    : state_(std::make_unique<State>(asked, name)) {}
template <typename Asked>
GpuBatchesOf<Asked>::~GpuBatchesOf() = default;

template <typename Asked>
void GpuBatchesOf<Asked>::first_hits(const PathSpanf& paths, std::span<Hit> hits, const Options& options) const {
  state_->ask([&](const GpuBatchOptions& gpu) { return state_->on_gpu.first_hits(paths, hits, options, gpu); });
}

template <typename Asked>
void GpuBatchesOf<Asked>::any_hits(const PathSpanf& paths, std::span<std::uint8_t> blocked,
                                   const Options& options) const {
  state_->ask([&](const GpuBatchOptions& gpu) { return state_->on_gpu.any_hits(paths, blocked, options, gpu); });
}

template <typename Asked>
std::string GpuBatchesOf<Asked>::name() const {
  return state_->device.name();
}

template <typename Asked>
GpuCounts GpuBatchesOf<Asked>::counts() const {
  return state_->counts;
}

template class GpuBatchesOf<Colliderf>;
template class GpuBatchesOf<Scenef>;

}  // namespace surehit::example
