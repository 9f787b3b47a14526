#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "visibility_bake/checkpoint.hpp"
#include "visibility_bake/pair_plan.hpp"
#include "visibility_bake/visibility.hpp"

namespace surehit::example {

/// The rows that are still to be baked, and what is known so far. Threads and ranks take units of some rows, and bring
/// back what they have found.
class RowQueue {
 public:
  static constexpr std::size_t rows_of_a_unit = 8;

  RowQueue(const PairPlan& plan, const Checkpoint& checkpoint, double checkpoint_seconds, Visibility& visibility);

  /// Takes the next rows. There are none if all were taken, or if the queue was closed.
  [[nodiscard]] std::span<const std::uint32_t> take();
  /// Adds a row that was taken. Writes a checkpoint if it is time for one.
  void add(const RowOfPairs& row);
  /// Hands out no more rows.
  void close();
  /// Writes a checkpoint.
  void save();

  [[nodiscard]] std::size_t row_count() const { return missing_.size(); }
  [[nodiscard]] std::size_t added();
  /// How fast rows come, such as "7.4 M segments/s".
  [[nodiscard]] std::string rate();

 private:
  using Clock = std::chrono::steady_clock;

  std::uint32_t samples_;
  const Checkpoint& checkpoint_;
  double checkpoint_seconds_;
  Visibility& visibility_;
  std::vector<std::uint32_t> missing_;
  std::mutex mutex_;
  std::size_t taken_ = 0;
  std::size_t added_ = 0;
  std::uint64_t segments_ = 0;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_checkpoint_ = start_;
};

}  // namespace surehit::example
