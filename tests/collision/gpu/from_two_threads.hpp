#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <thread>
#include <vector>

#include "gpu_answers.hpp"
#include "support/threads.hpp"

namespace surehit::test {

/// Asks the device from two threads at once, each with an executor of its own, and expects the bits of the host.
template <typename OnGpu, typename Host>
void expect_same_from_two_threads(const OnGpu& on_gpu, const Host& host, const std::vector<Segmentf>& segments,
                                  std::size_t dispatches) {
  using HitOfHost = typename BatchesOf<Host>::Hit;
  std::vector<HitOfHost> expected(segments.size());
  host.first_hits(segments, expected);
  const auto ask = [&] {
    GpuStatistics statistics;
    std::vector<HitOfHost> hits(segments.size());
    const Threads threads(2);
    const Executor executor = threads;
    EXPECT_TRUE(on_gpu.first_hits(segments, hits, {.executor = executor}, {.statistics = &statistics}));
    EXPECT_EQ(hits, expected);
    EXPECT_EQ(statistics.dispatches, dispatches);
  };
  std::thread other(ask);
  ask();
  other.join();
}

}  // namespace surehit::test
