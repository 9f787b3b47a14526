#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "path_batch.hpp"
#include "path_set.hpp"
#include "world.hpp"

namespace surehit::benchmark {

/// Returns the sets that are drawn in a world.
[[nodiscard]] std::vector<PathSet> path_sets_of(const World& world);

/// Draws paths as `draw_paths` does. The box is that of the world, and surfaces are those of all instances. Paths of
/// sight end a bit above random points of them. Paths about details are as long as an instance, and begin within half
/// of this from its surface. All instances count alike.
[[nodiscard]] PathBatch draw_world_paths(PathSet set, const World& world, std::size_t count, std::uint64_t seed);

/// Paths to measure with, and others to warm up with.
struct WorldSample {
  WorldSample(PathSet set_drawn, const World& world, std::size_t count)
      : set(set_drawn),
        paths(draw_world_paths(set, world, count, 1)),
        warm_up(draw_world_paths(set, world, PathSample::warm_up_batches * count, 2)) {}

  PathSet set;
  PathBatch paths;
  PathBatch warm_up;
};

/// Returns the paths as the mesh of an instance sees them, rounded.
[[nodiscard]] PathBatch in_frame_of(const Posef& pose, const PathBatch& paths);

}  // namespace surehit::benchmark
