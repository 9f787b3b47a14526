#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

#include "entrants.hpp"
#include "named_mesh.hpp"
#include "path_set.hpp"
#include "sweep_entrants.hpp"
#include "world_entrants.hpp"

namespace surehit::benchmark {

/// What the command line asks for.
struct Request {
  std::size_t rounds = 5;
  std::size_t paths = 20'000;
  std::size_t largest = 10'000'000;  ///< triangles
  std::vector<std::size_t> tick_paths = {10'000, 100'000};
  std::vector<std::size_t> gpu_paths = {100'000, 1'000'000, 10'000'000};
  std::chrono::milliseconds gpu_warm_up{300};  ///< Works so long on a GPU before it is timed.
  std::size_t largest_break_even = 1 << 20;    ///< of the batches that are tried for it on a GPU
  std::string gpu_name;  ///< A part of the device's name, or nothing for the first that is no software.
  int core = 0;
  std::vector<NamedMesh> meshes;
  std::vector<PathSet> sets;
  std::vector<Entrant> entrants;
  std::vector<std::string> worlds;
  std::vector<WorldEntrant> world_entrants;
  std::vector<SweepEntrant> sweep_entrants;
  std::vector<WorldSweepEntrant> world_sweep_entrants;
  std::vector<ShapeKind> shapes;
  float detail = 1;  ///< of the worlds
};

}  // namespace surehit::benchmark
