#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gpu/device_answers.hpp"
#include "gpu/path_limits.hpp"
#include "gpu/scene_tree.hpp"
#include "gpu/walk_check.hpp"
#include "surehit/scene.hpp"

namespace surehit::detail {

/// A small scene and paths through it, about which a device is asked before it gets its first scene. They are always
/// the same. The mesh of `WalkCheck` is moved, moves, is turned, and is mirrored. The paths are those of that mesh,
/// placed likewise and rounded.
struct SceneCheck {
  using DeviceFirst = DeviceSceneHit;

  /// Draws all, and asks the host. May throw std::bad_alloc.
  SceneCheck();

  /// Returns the usual options of the paths.
  [[nodiscard]] PathLimits limits() const;
  /// Returns the first answer of a device that is wrong, or nothing. There is one of each kind for each path. To be
  /// undecided is never wrong.
  [[nodiscard]] std::optional<std::string> fault(std::span<const DeviceSceneHit> hits,
                                                 std::span<const DeviceAny> blocked) const;

  WalkCheck mesh;
  Scenef scene;
  SceneTree tree;
  std::vector<Segmentf> paths;
  std::vector<SceneHitf> expected;  ///< The first hits of the paths, by the host.
};

}  // namespace surehit::detail
