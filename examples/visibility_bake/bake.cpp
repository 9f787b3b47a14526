#include "visibility_bake/bake.hpp"

#include <vector>

#include "command_line/chunked_run.hpp"
#include "command_line/interruption.hpp"
#include "visibility_bake/row_queue.hpp"

namespace surehit::example {
namespace {

constexpr std::size_t segments_of_a_batch = 1 << 14;
constexpr std::size_t segments_of_a_gpu_batch = 1 << 18;

/// Gathers the segments of rows, and asks about them when there are enough for a batch.
template <typename Ask>
class SegmentBatch {
 public:
  SegmentBatch(const PairPlan& plan, std::size_t size, Ask ask) : plan_(plan), size_(size), ask_(ask) {}

  /// Adds all segments of a row, which must stay where it is until `ask` returns.
  void add(RowOfPairs& row) {
    row.clear.resize(row.partners.size());
    for (std::size_t pair = 0; pair < row.partners.size(); ++pair) {
      for (std::uint32_t sample = 0; sample < plan_.options().samples; ++sample) {
        segments_.push_back(plan_.segment(row.cell, row.partners[pair], sample));
        clear_.push_back(&row.clear[pair]);
      }
      if (segments_.size() >= size_) ask();
    }
  }

  void ask() {
    blocked_.resize(segments_.size());
    ask_(segments_, blocked_);
    for (std::size_t i = 0; i < segments_.size(); ++i) *clear_[i] += blocked_[i] == 0 ? 1 : 0;
    segments_.clear();
    clear_.clear();
  }

 private:
  using Count = decltype(RowOfPairs::clear)::value_type;

  const PairPlan& plan_;
  std::size_t size_;
  Ask ask_;
  std::vector<Segmentf> segments_;
  std::vector<Count*> clear_;  ///< where each segment counts if it is free
  std::vector<std::uint8_t> blocked_;
};

}  // namespace

RowOfPairs bake_row(const Colliderf& collider, const PairPlan& plan, std::uint32_t cell) {
  RowOfPairs row{cell, plan.partners(cell), {}};
  SegmentBatch batch(plan, segments_of_a_batch, [&](const std::vector<Segmentf>& segments, auto& blocked) {
    collider.any_hits(segments, blocked);
  });
  batch.add(row);
  batch.ask();
  return row;
}

void bake_rows(const Colliderf& collider, const PairPlan& plan, std::span<const std::uint32_t> cells, RowQueue& queue) {
  for (const std::uint32_t cell : cells) {
    stop_if_interrupted();
    queue.add(bake_row(collider, plan, cell));
  }
}

void bake_rows(const GpuBatches& gpu, const PairPlan& plan, std::span<const std::uint32_t> cells, RowQueue& queue) {
  stop_if_interrupted();
  std::vector<RowOfPairs> rows;
  for (const std::uint32_t cell : cells) rows.push_back({cell, plan.partners(cell), {}});
  SegmentBatch batch(plan, segments_of_a_gpu_batch, [&](const std::vector<Segmentf>& segments, auto& blocked) {
    gpu.any_hits(segments, blocked, {});
  });
  for (RowOfPairs& row : rows) batch.add(row);
  batch.ask();
  for (const RowOfPairs& row : rows) queue.add(row);
}

void bake(const Colliderf& collider, const PairPlan& plan, const Checkpoint& checkpoint, const BakeOptions& options,
          Visibility& visibility) {
  RowQueue queue(plan, checkpoint, options.checkpoint_seconds, visibility);
  // Each unit is one chunk.
  const auto bake_unit = [&](std::size_t, std::size_t) {
    if (options.gpu != nullptr) {
      bake_rows(*options.gpu, plan, queue.take(), queue);
    } else {
      bake_rows(collider, plan, queue.take(), queue);
    }
  };
  try {
    run_in_chunks("visibility", queue.row_count(), RowQueue::rows_of_a_unit, options.threads, bake_unit,
                  [&] { return queue.rate(); });
  } catch (const Interrupted&) {
    queue.save();
    throw;
  }
}

}  // namespace surehit::example
