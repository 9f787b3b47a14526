#pragma once

#include "path_range.hpp"
#include "surehit/path.hpp"
#include "surehit/triangle.hpp"
#include "verdict.hpp"

namespace surehit::detail {

/// The kernel: Möller-Trumbore in the working precision, as its own filter. A path is prepared once and then classified
/// against triangle after triangle. A verdict of miss or hit is certain; the bound stands in moller_trumbore.cpp.
template <typename Scalar>
class MollerTrumbore {
 public:
  MollerTrumbore(const Path<Scalar>& path, const PathRange<Scalar>& range);

  [[nodiscard]] Verdict classify(const Triangle<Scalar>& triangle) const;

 private:
  Vector3<Scalar> start_;
  Vector3<Scalar> d_;
  Scalar d_size_;
  Scalar first_;       ///< lower end of the range, where it takes part
  Scalar last_;        ///< upper end, where it takes part
  bool bounds_first_;  ///< whether T - first det decides
  bool bounds_last_;   ///< whether last det - T decides
  bool can_hit_;       ///< whether nothing else is left to decide
};

}  // namespace surehit::detail
