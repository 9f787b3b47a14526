#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <span>
#include <string>
#include <vector>

#include "gpu/walk_check.hpp"
#include "support/pair_text.hpp"
#include "support/same_bits.hpp"
#include "surehit/gpu.hpp"
#include "surehit/gpu_scene.hpp"

namespace surehit::test {

/// Returns true if the environment asks for Khronos's layer.
inline bool wants_validation_layer() {
  const char* const layers = std::getenv("VK_INSTANCE_LAYERS");
  return layers != nullptr && std::strstr(layers, "VK_LAYER_KHRONOS_validation") != nullptr;
}

/// Returns false if that layer is not in this process. A loader of Vulkan says nothing of a layer that it cannot load,
/// and goes on without it.
inline bool may_have_validation_layer() {
  std::ifstream maps("/proc/self/maps");
  if (!maps) return true;  // Only Linux lists what is loaded.
  const std::string loaded((std::istreambuf_iterator<char>(maps)), std::istreambuf_iterator<char>());
  return loaded.find("VkLayer_khronos_validation") != std::string::npos;
}

/// Opens the best device that there is, software included. Returns a closed one where there is none. The environment's
/// `SUREHIT_TEST_GPU` is a part of the name that the device must have. Where it is set, no test is skipped.
/// A device is opened without a check of its answers, unless the test wants it. So tests see by themselves what is
/// wrong.
inline GpuDevice any_gpu(bool checks_answers = false) {
  detail::WalkCheck::is_on = checks_answers;
  GpuDevice device;
  const char* const name = std::getenv("SUREHIT_TEST_GPU");
  if (const GpuResult opened = device.try_open({.name = name == nullptr ? "" : name, .takes_software = true});
      !opened) {
    EXPECT_EQ(name, nullptr) << opened.error().what();
    EXPECT_NE(opened.error().reason, GpuError::Reason::missing_feature) << opened.error().what();
    EXPECT_FALSE(wants_validation_layer() && opened.error().reason == GpuError::Reason::failed)
        << opened.error().what();
  }
  if (device.is_open() && wants_validation_layer()) {
    EXPECT_TRUE(may_have_validation_layer()) << "the validation layer was not loaded";
  }
  return device;
}

#define SUREHIT_SKIP_WITHOUT(device) \
  if (!(device).is_open()) GTEST_SKIP() << "no Vulkan device here"

/// What batches of a collider or of a scene have.
template <typename Host>
struct BatchesOf {
  using Hit = SceneHitf;
  using Options = SceneBatchOptionsf;
};
template <>
struct BatchesOf<Colliderf> {
  using Hit = Hitf;
  using Options = BatchOptionsf;
};

/// Asks the device and the host in batches, and expects the same bits. Returns the number of hits.
template <typename OnGpu, typename Host>
std::size_t expect_same_as_host(const OnGpu& on_gpu, const Host& host, const PathSpanf& paths,
                                const typename BatchesOf<Host>::Options& options = {},
                                GpuStatistics* statistics = nullptr) {
  using HitOfHost = typename BatchesOf<Host>::Hit;
  HitOfHost unset;
  unset.t = 7;
  unset.triangle = 7;
  std::vector<HitOfHost> hits(paths.size(), unset);
  std::vector<HitOfHost> expected(paths.size(), unset);
  std::vector<std::uint8_t> blocked(paths.size(), 7);
  std::vector<std::uint8_t> expected_blocked(paths.size(), 7);
  const GpuBatchOptions gpu = {.statistics = statistics};
  EXPECT_TRUE(on_gpu.first_hits(paths, hits, options, gpu));
  EXPECT_TRUE(on_gpu.any_hits(paths, blocked, options, gpu));
  host.first_hits(paths, expected, options);
  host.any_hits(paths, expected_blocked, options);
  std::size_t hit_count = 0;
  std::size_t different = 0;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (expected_blocked[i] != 0) ++hit_count;
    if (same_bits(hits[i], expected[i]) && blocked[i] == expected_blocked[i]) continue;
    if (++different > 3) continue;
    ADD_FAILURE() << hex_text(paths[i]) << ": " << hex_text(hits[i]) << ", not " << hex_text(expected[i])
                  << ", and any hit is " << int{blocked[i]};
  }
  EXPECT_EQ(different, 0U);
  return hit_count;
}

/// Paths of each kind, and options of their own for them.
template <typename Options = QueryOptionsf>
struct PathsOfKinds {
  void add(const Pathf& path, const Options& its_options = {}) {
    if (path.kind == PathKind::segment) segments.push_back({path.start, path.toward});
    if (path.kind == PathKind::ray) rays.push_back({path.start, path.toward});
    if (path.kind == PathKind::line) lines.push_back({path.start, path.toward});
    options[static_cast<std::size_t>(path.kind)].push_back(its_options);
  }
  [[nodiscard]] PathSpanf of(PathKind kind) const {
    if (kind == PathKind::segment) return segments;
    if (kind == PathKind::ray) return rays;
    return lines;
  }
  /// Asks about all of them with their own options. Returns the number of hits.
  template <typename OnGpu, typename Host>
  std::size_t expect_same_as_host(const OnGpu& on_gpu, const Host& host, GpuStatistics* statistics = nullptr) const {
    std::size_t hits = 0;
    for (const PathKind kind : {PathKind::segment, PathKind::ray, PathKind::line}) {
      const std::vector<Options>& its_options = options[static_cast<std::size_t>(kind)];
      hits += test::expect_same_as_host(on_gpu, host, of(kind), {.path_options = its_options}, statistics);
    }
    return hits;
  }

  std::vector<Segmentf> segments;
  std::vector<Rayf> rays;
  std::vector<Linef> lines;
  std::vector<Options> options[3];
};

}  // namespace surehit::test
