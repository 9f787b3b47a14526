#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "gpu/vulkan_functions.hpp"
#include "surehit/hit.hpp"

namespace surehit::detail {

/// What a device says of a path in `first_hits`, as `tree_walk.comp` writes it.
struct DeviceHit {
  float t, u, v;
  std::uint32_t triangle;
  /// The number of a `Side`, which may have `is_not_rounded` added to it, or `undecided`. `Side::edge_on` has its own
  /// number here, so that memory which was never written is no answer. In buffers of the caller's it is 0.
  std::uint32_t side;

  static constexpr std::uint32_t edge_on = 3;
  static constexpr std::uint32_t is_not_rounded = 4;
  static constexpr std::uint32_t undecided = 8;
};
static_assert(sizeof(DeviceHit) == 20);

/// What a device says of a path in `first_hits` of a scene.
struct DeviceSceneHit {
  DeviceHit hit;
  std::uint32_t instance;  ///< The index of the instance.
};
static_assert(sizeof(DeviceSceneHit) == 24);

/// What a device says of a path in `any_hits`: 0 for a miss, 1 for a hit, 2 for neither.
using DeviceAny = std::uint32_t;

/// What a device lists of a path that it leaves to the host, as `tree_walk.comp` writes it.
struct ListedPath {
  std::uint32_t path;            ///< The number of the path in its dispatch.
  std::uint32_t triangle;        ///< The triangle that is hit and not rounded, or `no_triangle` if none is known.
  std::array<float, 6> numbers;  ///< The numbers of the path.
  std::uint32_t again;           ///< Apart from the others: a path that the second dispatch looks at.
};
static_assert(sizeof(ListedPath) == 36);

/// What stands before the list.
struct ListedCounts {
  std::uint32_t leftovers = 0, misses = 0;
  std::uint32_t again = 0;                       ///< The paths that the second dispatch looks at.
  VkDispatchIndirectCommand groups = {0, 1, 1};  ///< Its size.
  std::uint32_t unused_1 = 0, unused_2 = 0;
};
static_assert(sizeof(ListedCounts) == 32);

/// What is left to the host of a path.
enum class Leftover : std::uint8_t {
  nothing_of_miss,  ///< The path misses.
  nothing_of_hit,   ///< The answer is complete.
  rounding,         ///< The triangle is known. The host rounds t, u and v.
  all,              ///< The path is undecided, or the answer is none of a sound device.
};

[[nodiscard]] inline Leftover leftover_of(const DeviceHit& answer, std::size_t triangle_count) {
  static_assert(static_cast<int>(Leftover::nothing_of_hit) == 1 && static_cast<int>(Leftover::rounding) == 2 &&
                static_cast<int>(Leftover::all) == 3);
  static_assert(static_cast<int>(Side::front) == 1 && static_cast<int>(Side::back) == 2 && DeviceHit::edge_on == 3);
  // There are no branches, because no processor foresees which paths hit.
  const std::uint32_t is_known = answer.triangle < triangle_count ? 1 : 0;
  const std::uint32_t is_rounded = answer.side - 1 < 3 ? 1 : 0;
  const std::uint32_t is_unrounded = answer.side - DeviceHit::is_not_rounded - 1 < 2 ? 1 : 0;
  const std::uint32_t misses = answer.triangle == no_triangle ? 1 : 0;
  const std::uint32_t has_no_side = answer.side == 0 ? 1 : 0;
  return static_cast<Leftover>(3 - is_known * (2 * is_rounded + is_unrounded) - 3 * (misses & has_no_side));
}

[[nodiscard]] inline Leftover leftover_of(DeviceAny answer) { return static_cast<Leftover>(answer < 2 ? answer : 3); }

/// Returns an answer that has left nothing to the host.
[[nodiscard]] inline Hitf answer_of(const DeviceHit& answer) {
  const Side side = static_cast<Side>(answer.side % DeviceHit::edge_on);
  return {answer.t, answer.u, answer.v, answer.triangle, side};
}
[[nodiscard]] inline std::uint8_t answer_of(DeviceAny answer) { return static_cast<std::uint8_t>(answer); }

}  // namespace surehit::detail
