#include "visibility_bake/bake.hpp"

#include <vector>

#include "command_line/chunked_run.hpp"
#include "command_line/interruption.hpp"
#include "visibility_bake/row_queue.hpp"

namespace surehit::example {
namespace {

constexpr std::size_t segments_of_a_batch = 1 << 14;

}  // namespace

RowOfPairs bake_row(const Colliderf& collider, const PairPlan& plan, std::uint32_t cell) {
  RowOfPairs row{cell, plan.partners(cell), {}};
  row.clear.resize(row.partners.size());
  const std::uint32_t samples = plan.options().samples;
  std::vector<Segmentf> segments;
  std::vector<std::size_t> pairs;
  std::vector<std::uint8_t> blocked;
  const auto ask = [&] {
    blocked.resize(segments.size());
    collider.any_hits(segments, blocked);
    for (std::size_t i = 0; i < segments.size(); ++i) row.clear[pairs[i]] += blocked[i] == 0 ? 1 : 0;
    segments.clear();
    pairs.clear();
  };
  for (std::size_t pair = 0; pair < row.partners.size(); ++pair) {
    for (std::uint32_t sample = 0; sample < samples; ++sample) {
      segments.push_back(plan.segment(cell, row.partners[pair], sample));
      pairs.push_back(pair);
    }
    if (segments.size() >= segments_of_a_batch) ask();
  }
  ask();
  return row;
}

void bake_rows(const Colliderf& collider, const PairPlan& plan, std::span<const std::uint32_t> cells, RowQueue& queue) {
  for (const std::uint32_t cell : cells) {
    stop_if_interrupted();
    queue.add(bake_row(collider, plan, cell));
  }
}

void bake(const Colliderf& collider, const PairPlan& plan, const Checkpoint& checkpoint, const BakeOptions& options,
          Visibility& visibility) {
  RowQueue queue(plan, checkpoint, options.checkpoint_seconds, visibility);
  // Each unit is one chunk.
  const auto bake_unit = [&](std::size_t, std::size_t) { bake_rows(collider, plan, queue.take(), queue); };
  try {
    run_in_chunks("visibility", queue.row_count(), RowQueue::rows_of_a_unit, options.threads, bake_unit,
                  [&] { return queue.rate(); });
  } catch (const Interrupted&) {
    queue.save();
    throw;
  }
}

}  // namespace surehit::example
