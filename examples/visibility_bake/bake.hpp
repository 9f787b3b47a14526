#pragma once

#include <cstdint>

#include "visibility_bake/checkpoint.hpp"
#include "visibility_bake/pair_plan.hpp"
#include "visibility_bake/visibility.hpp"

namespace surehit::example {

struct BakeOptions {
  unsigned threads = 1;
  double checkpoint_seconds = 5;  ///< between two checkpoints
};

/// Asks about all segments of the row of a cell.
[[nodiscard]] RowOfPairs bake_row(const Colliderf& collider, const PairPlan& plan, std::uint32_t cell);

/// Adds all rows that are missing. The result does not depend on the number of threads, or on which rows were missing.
/// If it is interrupted, it saves a last checkpoint.
void bake(const Colliderf& collider, const PairPlan& plan, const Checkpoint& checkpoint, const BakeOptions& options,
          Visibility& visibility);

}  // namespace surehit::example
