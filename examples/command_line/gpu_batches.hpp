#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <surehit/batch_options.hpp>
#include <surehit/collider.hpp>
#include <surehit/path_span.hpp>
#include <surehit/scene.hpp>

#include "command_line/gpu_counts.hpp"

namespace surehit::example {

/// What the batches of a collider, or those of a scene, take and give.
template <typename Asked>
struct BatchTypes {
  using Hit = Hitf;
  using Options = BatchOptionsf;
};
template <>
struct BatchTypes<Scenef> {
  using Hit = SceneHitf;
  using Options = SceneBatchOptionsf;
};

/// Batches of a collider or of a scene on a GPU. If the device fails, the host goes on. Several threads may ask at
/// once.
template <typename Asked>
class GpuBatchesOf {
 public:
  using Hit = typename BatchTypes<Asked>::Hit;
  using Options = typename BatchTypes<Asked>::Options;

  /// Opens the device with this in its name, or the first one that is no software if it is empty. Throws a
  /// std::runtime_error if there is none, or if the program was built without GPU. The collider stays where it is. A
  /// scene is asked as it is committed now.
  GpuBatchesOf(const Asked& asked, const std::string& name);
  ~GpuBatchesOf();
  GpuBatchesOf(const GpuBatchesOf&) = delete;
  GpuBatchesOf& operator=(const GpuBatchesOf&) = delete;

  void first_hits(const PathSpanf& paths, std::span<Hit> hits, const Options& options) const;
  void any_hits(const PathSpanf& paths, std::span<std::uint8_t> blocked, const Options& options) const;

  [[nodiscard]] std::string name() const;
  /// No batch may be under way.
  [[nodiscard]] GpuCounts counts() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

extern template class GpuBatchesOf<Colliderf>;
extern template class GpuBatchesOf<Scenef>;

using GpuBatches = GpuBatchesOf<Colliderf>;

}  // namespace surehit::example
