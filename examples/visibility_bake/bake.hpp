#pragma once

#include <cstdint>
#include <span>

#include "command_line/gpu_batches.hpp"
#include "visibility_bake/checkpoint.hpp"
#include "visibility_bake/pair_plan.hpp"
#include "visibility_bake/visibility.hpp"

namespace surehit::example {

class RowQueue;

struct BakeOptions {
  unsigned threads = 1;
  double checkpoint_seconds = 5;    ///< between two checkpoints
  const GpuBatches* gpu = nullptr;  ///< answers instead of the collider, if there is one
};

/// Asks about all segments of the row of a cell.
[[nodiscard]] RowOfPairs bake_row(const Colliderf& collider, const PairPlan& plan, std::uint32_t cell);

/// Asks about the rows of some cells, and adds them to what is known. Throws Interrupted between two rows.
void bake_rows(const Colliderf& collider, const PairPlan& plan, std::span<const std::uint32_t> cells, RowQueue& queue);

/// Does the same on a GPU. It asks about all rows at once, because a device answers many segments at a time.
void bake_rows(const GpuBatches& gpu, const PairPlan& plan, std::span<const std::uint32_t> cells, RowQueue& queue);

/// Adds all rows that are missing. The result does not depend on the number of threads, or on which rows were missing.
/// If it is interrupted, it saves a last checkpoint.
void bake(const Colliderf& collider, const PairPlan& plan, const Checkpoint& checkpoint, const BakeOptions& options,
          Visibility& visibility);

}  // namespace surehit::example
