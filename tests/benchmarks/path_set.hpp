#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <surehit/triangle.hpp>
#include <vector>

#include "named_mesh.hpp"
#include "path_batch.hpp"
#include "support/random.hpp"

namespace surehit::benchmark {

/// Where paths begin and end. "The box" is that of the mesh, and lengths are shares of its diagonal.
enum class PathSet {
  long_paths,      ///< Both ends are anywhere in the box, inflated by 1.2 about its centre.
  short_paths,     ///< They are 1% long, and begin anywhere in the box.
  near_paths,      ///< They are as long, and begin within 0.5% of the surface.
  sight_paths,     ///< They go from the eye to points a bit above the floor.
  edge_paths,      ///< They are aimed at a vertex or a point of an edge, and go as far beyond.
  detail_paths,    ///< They are like near ones, but all triangles count alike, however small.
  edge_end_paths,  ///< They end exactly at a vertex or the middle of an edge.
  in_plane_paths,  ///< They lie in a triangle's plane, along an edge, or almost in the plane.
  cell_paths,      ///< They go from centre to centre of cubes, at most 12 cubes apart on each axis.
  far_paths,       ///< They begin 10 to 1,000 diagonals away, and are aimed at the mesh or past it.
  far_rays,        ///< They are like far paths, but are rays.
};

inline constexpr std::array all_path_sets = {PathSet::long_paths,     PathSet::short_paths,    PathSet::near_paths,
                                             PathSet::sight_paths,    PathSet::edge_paths,     PathSet::detail_paths,
                                             PathSet::edge_end_paths, PathSet::in_plane_paths, PathSet::cell_paths,
                                             PathSet::far_paths,      PathSet::far_rays};

[[nodiscard]] std::string name_of(PathSet set);

/// Draws one of the triangles at which paths may be drawn, all alike.
[[nodiscard]] Trianglef draw_triangle(const NamedMesh& named, test::Random& random);

/// Returns those of the sets that have segments.
[[nodiscard]] std::vector<PathSet> sets_of_segments(std::vector<PathSet> sets);

/// In random order, the same every time for the same seed; `count` is rounded up to whole octets.
[[nodiscard]] PathBatch draw_paths(PathSet set, const NamedMesh& named, std::size_t count, std::uint64_t seed = 1);

/// Paths to measure with, and others of the same set to warm up with: so many that they have met most of what the
/// measured ones meet, in large meshes too.
struct PathSample {
  static constexpr std::size_t warm_up_batches = 8;

  PathSample(PathSet set, const NamedMesh& named, std::size_t count)
      : paths(draw_paths(set, named, count, 1)), warm_up(draw_paths(set, named, warm_up_batches * count, 2)) {}

  PathBatch paths;
  PathBatch warm_up;
};

}  // namespace surehit::benchmark
