#include "gpu/scene_check.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>

#include "surehit/pose.hpp"

namespace surehit::detail {

SceneCheck::SceneCheck() {
  struct Placed {
    Posef pose;
    Vector3f motion;
  };
  const std::array<float, 4> turn = {0.125F, 0.25F, -0.5F, 0.8125F};  // Its length is not exactly 1, as in games.
  const std::array<Placed, 4> placed = {{{Posef::translated({4, 0, 0.125F}), {0, 0, 0}},
                                         {Posef::translated({0, 4, 0}), {0.25F, 0, -0.5F}},
                                         {Posef::rigid(turn, {4, 4, 0}).scaled(0.75F), {0, 0, 0}},
                                         {Posef::rigid(turn, {0, 0, 0}).scaled({-1, 0.5F, 1.25F}), {0, 0.5F, 0}}}};
  const auto collider = std::make_shared<const Colliderf>(mesh.collider);
  for (const auto& [pose, motion] : placed) scene.set_motion(scene.add(collider, pose), motion);
  scene.commit();
  for (std::size_t i = 0; i < mesh.paths.size(); ++i) {
    const auto& [pose, motion] = placed[i % placed.size()];
    const Segmentf& path = mesh.paths[i];
    paths.push_back({pose.linear * path.start + pose.translation, pose.linear * path.end + pose.translation + motion});
  }
  expected.resize(paths.size());
  scene.first_hits(paths, expected);
  const SceneSnapshotf committed = scene.snapshot();
  tree = SceneTree(CommittedScene<float>::of(committed), {{versions_of(ColliderState<float>::of(*collider)), 0}});
}

PathLimits SceneCheck::limits() const {
  return path_limits(PathKind::segment, SceneQueryOptionsf(), CommittedScene<float>::of(scene.snapshot()));
}

std::optional<std::string> SceneCheck::fault(std::span<const DeviceSceneHit> hits,
                                             std::span<const DeviceAny> blocked) const {
  if (hits.size() != paths.size() || blocked.size() != paths.size()) return "it answers too few paths in a scene";
  char text[280];
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const SceneHitf& right = expected[i];
    const auto& [hit, instance] = hits[i];
    const bool names_another = leftover_of(hit, mesh.collider.triangle_count()) != Leftover::all &&
                               hit.triangle != no_triangle && instance != right.instance.index;
    if (names_another || !is_right(hit, right, mesh.collider.triangle_count())) {
      std::snprintf(text, sizeof text,
                    "it answers path %zu of a check of scenes by triangle %u of instance %u with %a, %a and %a, not by "
                    "%u of %u with %a, %a and %a",
                    i, hit.triangle, instance, double{hit.t}, double{hit.u}, double{hit.v}, right.triangle,
                    right.instance.index, double{right.t}, double{right.u}, double{right.v});
      return text;
    }
    if (!is_right(blocked[i], right.triangle != no_triangle)) {
      std::snprintf(text, sizeof text, "it answers %u whether path %zu of a check of scenes hits anything, not %d",
                    blocked[i], i, right.triangle != no_triangle ? 1 : 0);
      return text;
    }
  }
  return std::nullopt;
}

}  // namespace surehit::detail
