#pragma once

#include <functional>

#include "visibility_bake/bake.hpp"

namespace surehit::example {

/// The processes that share the work. `mpirun` starts several of them, with ranks from 0 on, on one machine or on many.
/// Without it, or in a build without MPI, there is one process, whose rank is 0.
class Ranks {
 public:
  Ranks();
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  [[nodiscard]] int rank() const { return rank_; }
  [[nodiscard]] int size() const { return size_; }

  /// Prepares all ranks, and returns true if they are ready. `prepare` returns the fingerprint of the plan. If it
  /// throws in some ranks, the first of these throws it on, and the others return false. If a rank has another
  /// fingerprint than rank 0, it throws an InputError.
  [[nodiscard]] bool are_ready(const std::function<std::uint64_t()>& prepare) const;

  /// Adds all missing rows to the visibility of rank 0, as `bake` does. All ranks call it. Rank 0 hands out units of
  /// some rows to whoever has nothing to do, and works too. Only rank 0 looks at the checkpoint.
  void bake(const Colliderf& collider, const PairPlan& plan, const Checkpoint& checkpoint, const BakeOptions& options,
            Visibility& visibility) const;

 private:
  int rank_ = 0;
  int size_ = 1;
};

}  // namespace surehit::example
