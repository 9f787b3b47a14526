#pragma once

#include "report.hpp"
#include "request.hpp"

namespace surehit::benchmark {

/// Time per path and its ratios, and wrong decisions, on every mesh and path set.
void measure_queries(const Request& request, Report& report);
/// Time and memory of a build on every mesh.
void measure_builds(const Request& request, Report& report);
/// Loads of saved colliders beside builds, on every mesh.
void measure_loads(const Request& request, Report& report);
/// Cost against the number of triangles.
void measure_sizes(const Request& request, Report& report);
/// A physics step: a rebuild, and short paths.
void measure_ticks(const Request& request, Report& report);
/// One thread and two.
void measure_threads(const Request& request, Report& report);
/// What exactness costs: the same layout, walk and batch without the filter and all that comes after it.
void measure_exactness(const Request& request, Report& report);
/// How often the filter is undecided and exact arithmetic is needed, and what that takes.
void measure_statistics(const Request& request, Report& report);

/// Worlds of many instances: queries, wrong decisions, an instance beside its collider, and commits of moved instances.
void measure_worlds(const Request& request, Report& report);

/// Moving shapes beside peers, beside segments of the same paths, and close decisions beside general ones.
void measure_shapes(const Request& request, Report& report);
/// Moving shapes in worlds, beside segments of the same paths, beside a collider, and beside peers.
void measure_world_shapes(const Request& request, Report& report);

/// Batches on a GPU beside those of the host. Without a device, it says so and measures nothing.
void measure_gpu(const Request& request, Report& report);
/// The same in worlds.
void measure_gpu_scenes(const Request& request, Report& report);

}  // namespace surehit::benchmark
