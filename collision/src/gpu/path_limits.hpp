#pragma once

#include <cstdint>

#include "scene/committed_scene.hpp"
#include "surehit/path.hpp"
#include "surehit/query_options.hpp"
#include "surehit/scene_query_options.hpp"

namespace surehit::detail {

/// What narrows a path on the device, as `path_kernel.glsl` declares it.
struct PathLimits {
  float t_first, det_first, t_last, det_last;  ///< The weights of the ends of the range, as in `RangeWeights`.
  float first, last;                           ///< The range. 2^100 stands for infinity.
  std::uint32_t mask;
  std::uint32_t ignored;  ///< The triangle that is left out. In a scene it is one of `ignored_instance`.
  std::uint32_t flags;
  std::uint32_t instance_mask;
  std::uint32_t ignored_instance;  ///< The index of an instance, or `no_instance`.

  static constexpr std::uint32_t keeps_front = 1;     ///< Leaves out hits that are not `front`.
  static constexpr std::uint32_t keeps_back = 2;      ///< Leaves out hits that are not `back`.
  static constexpr std::uint32_t is_whole = 4;        ///< The range is [0, 1].
  static constexpr std::uint32_t hits_nothing = 8;    ///< The range is empty.
  static constexpr std::uint32_t is_for_host = 16;    ///< The kernel cannot weigh the range.
  static constexpr std::uint32_t ignores_start = 32;  ///< Leaves out triangles that contain the start.
  static constexpr std::uint32_t ignores_end = 64;    ///< Leaves out triangles that contain the end.
};

/// Returns what the options of a path are for a device, for a mesh or for a scene.
[[nodiscard]] PathLimits path_limits(PathKind kind, const QueryOptionsf& options);
[[nodiscard]] PathLimits path_limits(PathKind kind, const SceneQueryOptionsf& options,
                                     const CommittedScene<float>& scene);

}  // namespace surehit::detail
