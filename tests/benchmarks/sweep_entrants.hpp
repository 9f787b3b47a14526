#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <surehit/shape_hit.hpp>
#include <surehit/triangle_mesh_view.hpp>
#include <vector>

#include "entrants.hpp"
#include "sweep_batch.hpp"
#include "world.hpp"

namespace surehit::benchmark {

/// A library that is asked where shapes first touch what it was built of.
class SweepAnswerer {
 public:
  SweepAnswerer() = default;
  virtual ~SweepAnswerer() = default;
  SweepAnswerer(const SweepAnswerer&) = delete;
  SweepAnswerer& operator=(const SweepAnswerer&) = delete;

  /// Sets t and triangle of the hits of the first sweeps. The triangle of a hit is any number but `no_triangle`.
  virtual void first(const SweepBatch& sweeps, std::span<ShapeHitf> hits) = 0;
};

/// The same before it is built. `Surroundings` are a view of a mesh, or a world.
template <typename Surroundings>
class SweepContenderIn : public SweepAnswerer {
 public:
  /// Builds from nothing, and copies what it needs.
  virtual void build(const Surroundings& surroundings) = 0;
};
using SweepContender = SweepContenderIn<TriangleMeshViewf>;
using WorldSweepContender = SweepContenderIn<World>;

/// How to make such a contender.
template <typename Surroundings>
struct SweepEntrantIn {
  std::string library;
  std::string way;  ///< in which it is asked
  std::function<std::unique_ptr<SweepContenderIn<Surroundings>>()> make;
  /// The number of sweeps that it is asked. A slow one is asked few.
  std::size_t max_sweeps = std::numeric_limits<std::size_t>::max();

  [[nodiscard]] std::string name() const { return way.empty() ? library : library + ' ' + way; }
  [[nodiscard]] bool is_ours() const { return library == Entrant::our_library; }
};
using SweepEntrant = SweepEntrantIn<TriangleMeshViewf>;
using WorldSweepEntrant = SweepEntrantIn<World>;

/// The segments of the same paths in batches, then shapes in batches, and then single calls.
[[nodiscard]] std::vector<SweepEntrant> surehit_sweep_entrants();
/// The same in worlds, and then single calls of segments.
[[nodiscard]] std::vector<WorldSweepEntrant> surehit_world_sweep_entrants();
/// `btCollisionWorld::convexSweepTest` in a world that has the mesh alone.
[[nodiscard]] std::vector<SweepEntrant> bullet_sweep_entrants();
/// The same with an object for each instance. Objects share meshes.
[[nodiscard]] std::vector<WorldSweepEntrant> bullet_world_sweep_entrants();
/// `fcl::continuousCollide` with its defaults, in double, as the library has it in no other type.
[[nodiscard]] std::vector<SweepEntrant> fcl_sweep_entrants();

/// Ours first, then those of the peers that were found when this program was configured.
[[nodiscard]] std::vector<SweepEntrant> all_sweep_entrants();
[[nodiscard]] std::vector<WorldSweepEntrant> all_world_sweep_entrants();

}  // namespace surehit::benchmark
