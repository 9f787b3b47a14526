#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "path_batch.hpp"
#include "scene.hpp"

namespace surehit::benchmark {

enum class PathSet {
  long_paths,      ///< both ends anywhere in the box, inflated by 1.2 about its centre
  short_paths,     ///< 1% of the diagonal long, from anywhere in the box
  near_paths,      ///< as long, from within 0.5% of the diagonal of the surface
  sight_paths,     ///< from the eye to points a bit above the floor
  edge_paths,      ///< from anywhere in the inflated box at a vertex or a point of an edge, and as far beyond
  detail_paths,    ///< as near ones, but all triangles count alike, however small
  edge_end_paths,  ///< from anywhere in the inflated box to exactly a vertex or the middle of an edge
  in_plane_paths,  ///< between points of a triangle's plane, along an edge, to a vertex, or almost in the plane
  cell_paths,      ///< between centres of cubes, at most 12 cubes apart on each axis
  far_paths,       ///< from 10 to 1,000 diagonals away, at the mesh or past it
};

inline constexpr std::array all_path_sets = {
    PathSet::long_paths,   PathSet::short_paths,    PathSet::near_paths,     PathSet::sight_paths, PathSet::edge_paths,
    PathSet::detail_paths, PathSet::edge_end_paths, PathSet::in_plane_paths, PathSet::cell_paths,  PathSet::far_paths};

[[nodiscard]] std::string name_of(PathSet set);

/// In random order, the same every time for the same seed; `count` is rounded up to whole octets.
[[nodiscard]] PathBatch draw_paths(PathSet set, const Scene& scene, std::size_t count, std::uint64_t seed = 1);

/// Paths to measure with, and others of the same set to warm up with: so many that they have met most of what the
/// measured ones meet, in large meshes too.
struct PathSample {
  static constexpr std::size_t warm_up_batches = 8;

  PathSample(PathSet set, const Scene& scene, std::size_t count)
      : paths(draw_paths(set, scene, count, 1)), warm_up(draw_paths(set, scene, warm_up_batches * count, 2)) {}

  PathBatch paths;
  PathBatch warm_up;
};

}  // namespace surehit::benchmark
