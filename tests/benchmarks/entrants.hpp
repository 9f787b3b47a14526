#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "contender.hpp"

namespace surehit::benchmark {

/// How to make a contender.
struct Entrant {
  std::string library;  ///< with what its build depends on: "Embree fast medium"
  std::string way;      ///< in which it is asked: "x1"; entrants with the same of both compete, and the better counts
  std::string variant = "";  ///< what such entrants differ in
  std::function<std::unique_ptr<Contender>()> make;

  [[nodiscard]] std::string name() const { return way.empty() ? library : library + ' ' + way; }
  [[nodiscard]] bool is_ours() const { return library == our_library; }

  static constexpr const char* our_library = "surehit";
};

[[nodiscard]] std::vector<Entrant> surehit_entrants();
/// Counts as a peer, so that all tables have its ratio to floats.
[[nodiscard]] std::vector<Entrant> surehit_double_entrants();
/// The paths of a call to those that ask in small batches.
inline constexpr std::size_t small_batch_sizes[] = {1, 4, 8, 12, 16, 24, 32, 48, 64};
/// They count as peers too, and take part only if they are asked for.
[[nodiscard]] std::vector<Entrant> surehit_small_batch_entrants();
[[nodiscard]] std::vector<Entrant> embree_entrants();
[[nodiscard]] std::vector<Entrant> cgal_entrants();
[[nodiscard]] std::vector<Entrant> bullet_entrants();

/// surehit's batches without what makes them exact, in table exactness alone: one without the exact stage, whose kernel
/// misses what it leaves undecided, and one whose float determinants are taken at their word.
[[nodiscard]] std::vector<Entrant> inexact_entrants();

/// Ours first, then those of the peers that were found when this program was configured.
[[nodiscard]] std::vector<Entrant> all_entrants();

}  // namespace surehit::benchmark
