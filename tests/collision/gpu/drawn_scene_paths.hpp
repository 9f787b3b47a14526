#pragma once

#include "gpu_answers.hpp"
#include "support/scene_drawer.hpp"
#include "support/scene_path_drawer.hpp"

namespace surehit::test {

/// Draws 60 paths of all kinds that are hard for a scene, and options that are hard for half of their hits.
inline PathsOfKinds<SceneQueryOptionsf> draw_scene_paths(const DrawnScene<float>& drawn,
                                                         const JudgedScene<float>& judged, Random& random) {
  ScenePathDrawer<float> drawer(drawn, judged.oracle, judged.ids, random);
  PathsOfKinds<SceneQueryOptionsf> paths;
  for (int i = 0; i < 60; ++i) {
    const Path<float> path = drawer.draw();
    const auto hit = judged.scene.first_hit(path);
    paths.add(path, hit && random.one_in(2) ? draw_scene_options(*hit, random) : SceneQueryOptionsf{});
  }
  return paths;
}

}  // namespace surehit::test
