#pragma once

#include <surehit/gpu.hpp>

#include "command_line/gpu_counts.hpp"

namespace surehit::example {

/// Adds what a batch did.
inline void add(const GpuBatchResult& result, const GpuStatistics& statistics, GpuCounts& counts) {
  counts.paths += statistics.paths;
  counts.by_host += statistics.undecided + statistics.rounded_by_host;
  if (result.error && counts.failure.empty()) counts.failure = result.error->what();
}

}  // namespace surehit::example
