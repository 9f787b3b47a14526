#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

#include "caller_buffer.hpp"
#include "faulty_vulkan.hpp"
#include "gpu/device_answers.hpp"
#include "gpu_answers.hpp"
#include "small_dispatches.hpp"

namespace surehit::test {

/// What stands in a buffer where nothing was written.
inline constexpr std::uint32_t unset_word = 0x07070707;

/// Returns the hit of a path without the instance, as it is in a buffer.
inline const detail::DeviceHit& without_instance(const detail::DeviceHit& hit) { return hit; }
inline const detail::DeviceHit& without_instance(const detail::DeviceSceneHit& hit) { return hit.hit; }

inline bool is_same(const detail::DeviceHit& found, const Hitf& expected) {
  return found.side <= 2 && same_bits(detail::answer_of(found), expected);
}
inline bool is_same(const detail::DeviceSceneHit& found, const SceneHitf& expected) {
  return is_same(found.hit, expected) && found.instance == expected.instance.index;
}

/// Puts paths into a buffer of the caller's.
inline void fill(const CallerBuffer& buffer, std::size_t offset, const PathSpanf& paths) {
  for (std::size_t i = 0; i < paths.size(); ++i) {
    float numbers[6];
    paths.copy(i, numbers);
    std::memcpy(buffer.data() + offset + i * sizeof numbers, numbers, sizeof numbers);
  }
}

/// Segments in a buffer of the caller's, and another one with room for their hits.
template <typename HitInBuffer>
struct SegmentsInBuffers {
  SegmentsInBuffers(const GpuDevice& device, const std::vector<Segmentf>& segments)
      : vulkan(device.handles()),
        given(vulkan, segments.size() * sizeof(float[6])),
        hits(vulkan, segments.size() * sizeof(HitInBuffer)),
        paths{PathKind::segment, segments.size(), given.part()} {
    fill(given, 0, segments);
  }

  const CallerVulkan vulkan;
  const CallerBuffer given;
  const CallerBuffer hits;
  const GpuPaths paths;
};

/// Lets each work of two dispatches fail in turn, and expects that batches tell how many answers there are. The works
/// are the dispatches, what fetches a long list, and what writes the host's answers.
template <typename HitInBuffer, typename OnGpu>
void expect_failures_of_works_are_told(const GpuDevice& device, const OnGpu& on_gpu,
                                       const std::vector<Segmentf>& segments) {
  const SegmentsInBuffers<HitInBuffer> in_buffers(device, segments);
  auto& submit_of_device = detail::GpuDeviceState::of(device)->vulkan.QueueSubmit;
  submit = std::exchange(submit_of_device, no_submit);
  submit_result = VK_ERROR_OUT_OF_DEVICE_MEMORY;
  for (int works = 0; works < 6; ++works) {
    calls_left = works;
    const GpuBatchResult result =
        on_gpu.first_hits(in_buffers.paths, in_buffers.hits.part(), {}, {.goes_on_without_device = true});
    EXPECT_FALSE(result);
    ASSERT_TRUE(result.error) << works;
    EXPECT_EQ(result.error->reason, GpuError::Reason::out_of_memory);
    EXPECT_EQ(result.finished, works < 4 ? 0U : paths_in_small_dispatch) << works;
  }
  calls_left = 6;
  EXPECT_TRUE(on_gpu.first_hits(in_buffers.paths, in_buffers.hits.part()));
  submit_of_device = submit;
}

/// Asks with paths and answers in buffers of the caller's, and expects the bits of the host. Both begin behind 256
/// bytes that nothing may touch, and so does something else behind them.
template <typename OnGpu, typename Host>
void expect_same_in_buffers(const GpuDevice& device, const OnGpu& on_gpu, const Host& host, const PathSpanf& paths,
                            const typename BatchesOf<Host>::Options& options = {},
                            GpuStatistics* statistics = nullptr) {
  using HitOfHost = typename BatchesOf<Host>::Hit;
  using HitInBuffer =
      std::conditional_t<std::is_same_v<HitOfHost, SceneHitf>, detail::DeviceSceneHit, detail::DeviceHit>;
  constexpr std::size_t before = 256;
  const CallerVulkan vulkan(device.handles());
  const CallerBuffer given(vulkan, before + paths.size() * sizeof(float[6]) + 16);
  fill(given, before, paths);
  const CallerBuffer hits(vulkan, before + paths.size() * sizeof(HitInBuffer) + 16);
  const CallerBuffer blocked(vulkan, before + paths.size() * sizeof(std::uint32_t) + 16);
  const GpuPaths gpu_paths = {paths.kind(), paths.size(), given.part(before)};
  const GpuBatchOptions gpu = {.statistics = statistics};
  const GpuBatchResult first = on_gpu.first_hits(gpu_paths, hits.part(before), options, gpu);
  ASSERT_TRUE(first) << first.error->what();
  ASSERT_TRUE(on_gpu.any_hits(gpu_paths, blocked.part(before), options, gpu));
  std::vector<HitOfHost> expected(paths.size());
  std::vector<std::uint8_t> expected_blocked(paths.size());
  host.first_hits(paths, expected, options);
  host.any_hits(paths, expected_blocked, options);
  const auto word = [](const CallerBuffer& buffer, std::size_t at) {
    std::uint32_t result;
    std::memcpy(&result, buffer.data() + at, sizeof result);
    return result;
  };
  std::size_t different = 0;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    HitInBuffer hit;
    std::memcpy(&hit, hits.data() + before + i * sizeof hit, sizeof hit);
    const std::uint32_t is_blocked = word(blocked, before + i * sizeof is_blocked);
    if (is_same(hit, expected[i]) && is_blocked == expected_blocked[i]) continue;
    if (++different > 3) continue;
    ADD_FAILURE() << hex_text(paths[i]) << ": " << hex_text(detail::answer_of(without_instance(hit))) << ", not "
                  << hex_text(expected[i]) << ", and any hit is " << is_blocked;
  }
  EXPECT_EQ(different, 0U);
  for (const CallerBuffer* buffer : {&hits, &blocked}) {
    EXPECT_EQ(word(*buffer, before - 4), unset_word);
    EXPECT_EQ(word(*buffer, before + paths.size() * (buffer == &hits ? sizeof(HitInBuffer) : 4)), unset_word);
  }
}

}  // namespace surehit::test
