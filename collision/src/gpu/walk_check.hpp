#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gpu/device_answers.hpp"
#include "gpu/triangle_tree.hpp"
#include "surehit/collider.hpp"

namespace surehit::detail {

/// A small mesh and paths through it, about which a device is asked when it is opened. They are always the same. Paths
/// pass needles as closely as floats can, and they meet edges, corners and planes of a box exactly.
struct WalkCheck {
  /// Draws all, and asks the host. May throw std::bad_alloc.
  WalkCheck();

  /// Returns the first answer of a device that is wrong, or nothing. There is one of each kind for each path. To be
  /// undecided is never wrong.
  [[nodiscard]] std::optional<std::string> fault(std::span<const DeviceHit> hits,
                                                 std::span<const DeviceAny> blocked) const;

  /// False if devices are opened without this check. Tests do so, to see by themselves that a shader is wrong.
  static inline bool is_on = true;

  Colliderf collider;
  TriangleTree tree;
  std::vector<Segmentf> paths;
  std::vector<Hitf> expected;  ///< The first hits of the paths, by the host.
};

}  // namespace surehit::detail
