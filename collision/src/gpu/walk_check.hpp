#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gpu/device_answers.hpp"
#include "gpu/path_limits.hpp"
#include "gpu/triangle_tree.hpp"
#include "surehit/collider.hpp"

namespace surehit::detail {

/// Returns true if a device may answer so about a path that has this first hit in a mesh.
[[nodiscard]] bool is_right(const DeviceHit& hit, const Hitf& expected, std::size_t triangle_count);
/// Returns true if a device may answer so whether a path hits anything.
[[nodiscard]] bool is_right(DeviceAny blocked, bool expected);

/// A small mesh and paths through it, about which a device is asked when it is opened. They are always the same. Paths
/// pass needles as closely as floats can, and they meet edges, corners and planes of a box exactly.
struct WalkCheck {
  using DeviceFirst = DeviceHit;

  /// Draws all, and asks the host. May throw std::bad_alloc.
  WalkCheck();

  /// Returns the usual options of the paths.
  [[nodiscard]] static PathLimits limits() { return path_limits(PathKind::segment, QueryOptionsf()); }
  /// Returns the first answer of a device that is wrong, or nothing. There is one of each kind for each path. To be
  /// undecided is never wrong.
  [[nodiscard]] std::optional<std::string> fault(std::span<const DeviceHit> hits,
                                                 std::span<const DeviceAny> blocked) const;

  /// False if devices are opened without this check, and get scenes without theirs. Tests do so, to see by themselves
  /// that a shader is wrong.
  static inline bool is_on = true;

  Colliderf collider;
  TriangleTree tree;
  std::vector<Segmentf> paths;
  std::vector<Hitf> expected;  ///< The first hits of the paths, by the host.
};

}  // namespace surehit::detail
