#include "visibility_bake/row_queue.hpp"

#include <algorithm>
#include <cstdio>

namespace surehit::example {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

RowQueue::RowQueue(const PairPlan& plan, const Checkpoint& checkpoint, double checkpoint_seconds,
                   Visibility& visibility)
    : samples_(plan.options().samples),
      checkpoint_(checkpoint),
      checkpoint_seconds_(checkpoint_seconds),
      visibility_(visibility) {
  for (std::uint32_t cell = 0; cell < plan.cell_count(); ++cell) {
    if (!visibility.has_row(cell)) missing_.push_back(cell);
  }
}

std::span<const std::uint32_t> RowQueue::take() {
  const std::lock_guard lock(mutex_);
  const std::size_t begin = taken_;
  taken_ = std::min(taken_ + rows_of_a_unit, missing_.size());
  return std::span(missing_).subspan(begin, taken_ - begin);
}

void RowQueue::add(const RowOfPairs& row) {
  const std::lock_guard lock(mutex_);
  visibility_.add(row);
  ++added_;
  segments_ += row.partners.size() * samples_;
  if (seconds_since(last_checkpoint_) < checkpoint_seconds_) return;
  checkpoint_.save(visibility_);
  last_checkpoint_ = Clock::now();
}

void RowQueue::close() {
  const std::lock_guard lock(mutex_);
  taken_ = missing_.size();
}

void RowQueue::save() {
  const std::lock_guard lock(mutex_);
  checkpoint_.save(visibility_);
}

std::size_t RowQueue::added() {
  const std::lock_guard lock(mutex_);
  return added_;
}

std::string RowQueue::rate() {
  const std::lock_guard lock(mutex_);
  char text[48];
  std::snprintf(text, sizeof text, "%.2f M segments/s", static_cast<double>(segments_) / seconds_since(start_) / 1e6);
  return text;
}

}  // namespace surehit::example
