#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#if !defined(_LIBCPP_HAS_NO_THREADS)
#include <mutex>
#endif

#include "support/in_parts.hpp"
#include "surehit/query_statistics.hpp"

namespace surehit::detail {

#if defined(_LIBCPP_HAS_NO_THREADS)
/// Locks nothing, because all tasks run on one thread where there are no others.
struct StatisticsMutex {
  void lock() {}
  void unlock() {}
};
#else
using StatisticsMutex = std::mutex;
#endif

/// Answers a batch of so many paths in parts of `paths_in_a_task` paths, in tasks of the executor. Without an executor,
/// there is one part. `ask(first, last, own_options, statistics)` answers the paths [first, last), and counts its work.
///
/// `Options` are those of a batch of a collider or of a scene. The batch ends with the shorter of the paths and the
/// options of each path.
template <typename Options, typename Ask>
void answer_batch(std::size_t paths, const Options& options, std::size_t paths_in_a_task, const Ask& ask) noexcept {
  const auto all_options = options.path_options;
  const std::size_t count = all_options.empty() ? paths : std::min(paths, all_options.size());
  if (count == 0) return;
  StatisticsMutex mutex;
  in_parts(address_of(options.executor), count, paths_in_a_task, [&](std::size_t first, std::size_t last) {
    QueryStatistics statistics;
    ask(first, last, all_options.empty() ? all_options : all_options.subspan(first, last - first), statistics);
    if (options.statistics == nullptr) return;
    mutex.lock();
    *options.statistics += statistics;
    mutex.unlock();
  });
}

}  // namespace surehit::detail
