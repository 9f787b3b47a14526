#include "visibility_bake/bake.hpp"

#include <chrono>
#include <cstdio>
#include <mutex>
#include <string>
#include <vector>

#include "command_line/chunked_run.hpp"
#include "command_line/interruption.hpp"

namespace surehit::example {
namespace {

constexpr std::size_t segments_of_a_batch = 1 << 14;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

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

void bake(const Colliderf& collider, const PairPlan& plan, const Checkpoint& checkpoint, const BakeOptions& options,
          Visibility& visibility) {
  std::vector<std::uint32_t> missing;
  for (std::uint32_t cell = 0; cell < plan.cell_count(); ++cell) {
    if (!visibility.has_row(cell)) missing.push_back(cell);
  }
  std::mutex mutex;
  std::size_t segments = 0;
  const auto start = Clock::now();
  auto last_checkpoint = start;
  const auto bake_rows = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      stop_if_interrupted();
      const RowOfPairs row = bake_row(collider, plan, missing[i]);
      const std::lock_guard lock(mutex);
      visibility.add(row);
      segments += row.partners.size() * plan.options().samples;
      if (seconds_since(last_checkpoint) < options.checkpoint_seconds) continue;
      checkpoint.save(visibility);
      last_checkpoint = Clock::now();
    }
  };
  const auto rate = [&] {
    const std::lock_guard lock(mutex);
    char text[48];
    std::snprintf(text, sizeof text, "%.2f M segments/s", static_cast<double>(segments) / seconds_since(start) / 1e6);
    return std::string(text);
  };
  try {
    run_in_chunks("visibility", missing.size(), 4, options.threads, bake_rows, rate);
  } catch (const Interrupted&) {
    checkpoint.save(visibility);
    throw;
  }
}

}  // namespace surehit::example
