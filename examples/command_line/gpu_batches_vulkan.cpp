#include <mutex>
#include <surehit/gpu.hpp>

#include "command_line/gpu_batches.hpp"

namespace surehit::example {

struct GpuBatches::State {
  State(const Colliderf& mesh, const std::string& name)
      : device(GpuDevice::open({.name = name})), collider(device, mesh) {}

  template <typename Answer>
  void ask(GpuBatchResult (GpuCollider::*question)(const PathSpanf&, std::span<Answer>, const BatchOptionsf&,
                                                   const GpuBatchOptions&) const,
           const PathSpanf& paths, std::span<Answer> answers, const BatchOptionsf& options) {
    GpuStatistics statistics;
    const GpuBatchResult result =
        (collider.*question)(paths, answers, options, {.goes_on_without_device = true, .statistics = &statistics});
    if (!result) throw GpuError(*result.error);
    const std::lock_guard lock(mutex);
    counts.paths += statistics.paths;
    counts.by_host += statistics.undecided;
  }

  GpuDevice device;
  GpuCollider collider;
  std::mutex mutex;
  GpuCounts counts;
};

GpuBatches::GpuBatches(const Colliderf& collider, const std::string& name)
    : state_(std::make_unique<State>(collider, name)) {}
GpuBatches::~GpuBatches() = default;

void GpuBatches::first_hits(const PathSpanf& paths, std::span<Hitf> hits, const BatchOptionsf& options) const {
  state_->ask(&GpuCollider::first_hits, paths, hits, options);
}

void GpuBatches::any_hits(const PathSpanf& paths, std::span<std::uint8_t> blocked, const BatchOptionsf& options) const {
  state_->ask(&GpuCollider::any_hits, paths, blocked, options);
}

std::string GpuBatches::name() const { return state_->device.name(); }

GpuCounts GpuBatches::counts() const { return state_->counts; }

}  // namespace surehit::example
