#pragma once

#include <optional>
#include <span>

#include "surehit/executor.hpp"
#include "surehit/hit_filter.hpp"
#include "surehit/query_options.hpp"
#include "surehit/query_statistics.hpp"

namespace surehit {

/// How a batch of paths is answered. The defaults leave nothing out, and run on the calling thread.
template <FloatOrDouble Scalar>
struct BatchOptions {
  /// Narrows every path of the batch.
  QueryOptions<Scalar> options = {};
  /// Narrows path i by element i, in place of `options`. Empty: `options` holds for all.
  std::span<const QueryOptions<Scalar>> path_options = {};
  /// Says which hits count. It may be called from the executor's threads.
  std::optional<HitFilter<Scalar>> filter = {};
  /// Spreads the batch over threads, in tasks of some thousand paths.
  std::optional<Executor> executor = {};
  /// Work is added here. Not read while the batch runs.
  QueryStatistics* statistics = nullptr;
};

using BatchOptionsf = BatchOptions<float>;
using BatchOptionsd = BatchOptions<double>;

}  // namespace surehit
