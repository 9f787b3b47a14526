#pragma once

#include <optional>
#include <span>

#include "surehit/executor.hpp"
#include "surehit/hit_filter.hpp"
#include "surehit/query_options.hpp"
#include "surehit/query_statistics.hpp"

namespace surehit {

/// How a batch of paths is answered. The defaults keep all hits, and use the calling thread alone.
template <FloatOrDouble Scalar>
struct BatchOptions {
  /// The options of all paths.
  QueryOptions<Scalar> options = {};
  /// The options of each path, in place of `options`. Element i is for path i. If it is empty, `options` are for all.
  std::span<const QueryOptions<Scalar>> path_options = {};
  /// Decides which hits count. None accepts all. The executor's threads may call it at the same time.
  std::optional<HitFilter<Scalar>> filter = {};
  /// Spreads the batch over threads, in tasks of some thousand paths each. A smaller batch runs on the calling thread.
  std::optional<Executor> executor = {};
  /// The batch adds its work to these, unless this is null. Nothing else may use them while the batch runs.
  QueryStatistics* statistics = nullptr;
};

using BatchOptionsf = BatchOptions<float>;   ///< Options of a batch in float.
using BatchOptionsd = BatchOptions<double>;  ///< Options of a batch in double.

}  // namespace surehit
