#pragma once

#include <limits>
#include <vector>

#include "narrowphase.hpp"
#include "path_range.hpp"
#include "query/query.hpp"
#include "surehit/explain.hpp"
#include "surehit/path.hpp"

namespace surehit::detail {

/// Tells which stage decides each candidate of a path, and keeps the hits among them.
template <typename Scalar>
class PairExplainer {
 public:
  PairExplainer(const Query<Scalar>& query, const Path<Scalar>& path, const PathRange<Scalar>& range)
      : query_(query), path_(path), range_(range) {}

  /// Sets what follows the filter in `candidate`. Its id and the filter's verdict must be set. Returns true if
  /// `limit()` is smaller now.
  bool decide(ExplainedCandidate& candidate);
  /// Returns an upper bound on the t of the first hit so far, or infinity.
  [[nodiscard]] double limit() const { return limit_; }
  /// Returns the hits in order. Each triangle has at most one.
  [[nodiscard]] std::vector<ExplainedHit<Scalar>> sorted_hits();

 private:
  /// Returns the stage that decides whether the path meets a triangle, without the filter.
  [[nodiscard]] DecidedBy stage_of(const Triangle<Scalar>& triangle, bool is_by_integers) const;
  /// Returns why `next` comes after `previous`.
  [[nodiscard]] static OrderedBy order_of(const Narrowphase<Scalar>& narrowphase, const Candidate<Scalar>& previous,
                                          const Candidate<Scalar>& next);

  const Query<Scalar>& query_;
  const Path<Scalar>& path_;
  const PathRange<Scalar>& range_;
  std::vector<Candidate<Scalar>> found_;  ///< A triangle may be there more than once.
  double limit_ = std::numeric_limits<double>::infinity();
};

}  // namespace surehit::detail
