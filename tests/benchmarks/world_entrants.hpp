#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <surehit/hit.hpp>
#include <vector>

#include "entrants.hpp"
#include "path_batch.hpp"
#include "world.hpp"

namespace surehit::benchmark {

/// A library with a world, asked in one way.
class WorldContender {
 public:
  WorldContender() = default;
  virtual ~WorldContender() = default;
  WorldContender(const WorldContender&) = delete;
  WorldContender& operator=(const WorldContender&) = delete;

  /// From nothing. The world must outlive the contender.
  virtual void build(const World& world) = 0;
  /// Gives the first instances other poses, and makes the world ready to be asked.
  virtual void move(std::span<const Posef> poses) = 0;
  /// Takes one instance out of the world, puts the like of it in, and makes the world ready to be asked.
  virtual void exchange_one() = 0;

  /// Sets t and the triangle of each hit. The triangle is `no_triangle` for a miss.
  virtual void first(const PathBatch& paths, std::span<Hitf> hits) = 0;
  virtual void any(const PathBatch& paths, std::span<std::uint8_t> blocked) = 0;
};

/// How to make such a contender.
struct WorldEntrant {
  std::string library;  ///< with what its build depends on
  std::string way;      ///< in which it is asked
  std::function<std::unique_ptr<WorldContender>()> make;

  [[nodiscard]] std::string name() const { return library + ' ' + way; }
  [[nodiscard]] bool is_ours() const { return library == Entrant::our_library; }
};

/// Batches, and then single calls.
[[nodiscard]] std::vector<WorldEntrant> surehit_world_entrants();
/// They count as peers, and take part only if they are asked for.
[[nodiscard]] std::vector<WorldEntrant> surehit_small_batch_world_entrants();
/// Single rays. Meshes are of medium quality, and the names have the quality of what is above them.
[[nodiscard]] std::vector<WorldEntrant> embree_world_entrants();

/// Ours first, then those of the peers that were found when this program was configured.
[[nodiscard]] std::vector<WorldEntrant> all_world_entrants();

}  // namespace surehit::benchmark
