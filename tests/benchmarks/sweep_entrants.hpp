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

namespace surehit::benchmark {

/// A library that is asked where shapes first touch a mesh.
class SweepContender {
 public:
  SweepContender() = default;
  virtual ~SweepContender() = default;
  SweepContender(const SweepContender&) = delete;
  SweepContender& operator=(const SweepContender&) = delete;

  /// Builds from nothing, and copies what it needs of the mesh.
  virtual void build(const TriangleMeshViewf& mesh) = 0;
  /// Sets t and triangle of the hits of the first sweeps. The triangle of a hit is any number but `no_triangle`.
  virtual void first(const SweepBatch& sweeps, std::span<ShapeHitf> hits) = 0;
};

/// How to make such a contender.
struct SweepEntrant {
  std::string library;
  std::string way;  ///< in which it is asked
  std::function<std::unique_ptr<SweepContender>()> make;
  /// The number of sweeps that it is asked. A slow one is asked few.
  std::size_t max_sweeps = std::numeric_limits<std::size_t>::max();

  [[nodiscard]] std::string name() const { return way.empty() ? library : library + ' ' + way; }
  [[nodiscard]] bool is_ours() const { return library == Entrant::our_library; }
};

/// The segments of the same paths in batches, then shapes in batches, and then single calls.
[[nodiscard]] std::vector<SweepEntrant> surehit_sweep_entrants();
/// `btCollisionWorld::convexSweepTest` in a world that has the mesh alone.
[[nodiscard]] std::vector<SweepEntrant> bullet_sweep_entrants();
/// `fcl::continuousCollide` with its defaults, in double, as the library has it in no other type.
[[nodiscard]] std::vector<SweepEntrant> fcl_sweep_entrants();

/// Ours first, then those of the peers that were found when this program was configured.
[[nodiscard]] std::vector<SweepEntrant> all_sweep_entrants();

}  // namespace surehit::benchmark
