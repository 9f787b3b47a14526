#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <surehit/batch_options.hpp>
#include <surehit/collider.hpp>
#include <surehit/path_span.hpp>

namespace surehit::example {

/// What the batches on a GPU did.
struct GpuCounts {
  std::uint64_t paths = 0;
  std::uint64_t by_host = 0;  ///< the paths that the device left to the host
};

/// Batches of a collider on a GPU. If the device fails, the host goes on. Several threads may ask at once.
class GpuBatches {
 public:
  /// Opens the device with this in its name, or the first one that is no software if it is empty. Throws a
  /// std::runtime_error if there is none, or if the program was built without GPU. The collider stays where it is.
  GpuBatches(const Colliderf& collider, const std::string& name);
  ~GpuBatches();
  GpuBatches(const GpuBatches&) = delete;
  GpuBatches& operator=(const GpuBatches&) = delete;

  void first_hits(const PathSpanf& paths, std::span<Hitf> hits, const BatchOptionsf& options) const;
  void any_hits(const PathSpanf& paths, std::span<std::uint8_t> blocked, const BatchOptionsf& options) const;

  [[nodiscard]] std::string name() const;
  /// No batch may be under way.
  [[nodiscard]] GpuCounts counts() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace surehit::example
