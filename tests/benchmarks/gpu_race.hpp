#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <surehit/gpu.hpp>
#include <surehit/gpu_scene.hpp>
#include <surehit/scene.hpp>
#include <vector>

#include "gpu/device_answers.hpp"
#include "question.hpp"

namespace surehit::benchmark {

/// What asks a device in place of a collider or of a scene.
template <typename Host>
struct OnDevice;
template <>
struct OnDevice<Colliderf> {
  using Type = GpuCollider;
  using Hit = Hitf;
  using HitInBuffer = detail::DeviceHit;
  using Options = BatchOptionsf;
};
template <>
struct OnDevice<Scenef> {
  using Type = GpuScene;
  using Hit = SceneHitf;
  using HitInBuffer = detail::DeviceSceneHit;
  using Options = SceneBatchOptionsf;
};

/// A collider or a scene, and the same on a device.
template <typename Host>
struct BothSides {
  const Host& on_host;
  const typename OnDevice<Host>::Type& on_gpu;
};

inline void require(const GpuBatchResult& result) {
  if (!result) throw GpuError(*result.error);
}

/// Batches of the host and of the device, with room for their answers.
template <typename Host>
class GpuRace {
 public:
  using Options = typename OnDevice<Host>::Options;

  GpuRace(const BothSides<Host>& sides, Question question, std::span<const Segmentf> paths)
      : sides_(sides), wants_first_(question == Question::closest_hit), paths_(paths) {
    if (wants_first_) hits_.resize(paths.size());
    if (!wants_first_) blocked_.resize(paths.size());
  }

  /// Returns the nanoseconds of a batch of the host, for each path.
  double time_on_host(const std::optional<Executor>& executor = {}) {
    Options options;
    options.executor = executor;
    return per_path([&] {
      if (wants_first_) sides_.on_host.first_hits(paths_, hits_, options);
      if (!wants_first_) sides_.on_host.any_hits(paths_, blocked_, options);
    });
  }
  /// Returns those of a batch of the device, whose paths and answers are on the host.
  double time_with_transfers(const std::optional<Executor>& executor = {}) {
    Options options;
    options.executor = executor;
    return per_path([&] {
      if (wants_first_) require(sides_.on_gpu.first_hits(paths_, hits_, options));
      if (!wants_first_) require(sides_.on_gpu.any_hits(paths_, blocked_, options));
    });
  }
  /// Returns those of a batch whose paths and answers are on the device.
  double time_in_buffers(const GpuBufferPart& paths, const GpuBufferPart& answers, GpuStatistics& statistics) {
    const GpuPaths given = {PathKind::segment, paths_.size(), paths};
    return per_path([&] {
      if (wants_first_) require(sides_.on_gpu.first_hits(given, answers, {}, {.statistics = &statistics}));
      if (!wants_first_) require(sides_.on_gpu.any_hits(given, answers, {}, {.statistics = &statistics}));
    });
  }

 private:
  template <typename Work>
  double per_path(const Work& work) const {
    return nanoseconds_of(work) / static_cast<double>(paths_.size());
  }

  BothSides<Host> sides_;
  bool wants_first_;
  std::span<const Segmentf> paths_;
  std::vector<typename OnDevice<Host>::Hit> hits_;
  std::vector<std::uint8_t> blocked_;
};

}  // namespace surehit::benchmark
