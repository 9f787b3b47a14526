#pragma once

#include <gmpxx.h>

#include <cmath>
#include <cstddef>
#include <optional>

#include "exact_matrix.hpp"
#include "path_range.hpp"
#include "scene/instance_tree.hpp"

namespace surehit::test {

template <typename Scalar>
[[nodiscard]] ExactVector exact_direction(const Path<Scalar>& path) {
  return path.has_end() ? exact(path.toward) - exact(path.start) : exact(path.toward);
}

/// Where on a path something holds. It has no bound on a side without a number.
struct ExactRange {
  std::optional<mpq_class> first, last;
};

/// Returns the part of a range in which start + t direction is in a box, or nothing where it misses the box.
template <typename Scalar>
[[nodiscard]] std::optional<ExactRange> exact_range_in(const detail::InstanceBox& box, const ExactVector& start,
                                                       const ExactVector& direction,
                                                       const detail::PathRange<Scalar>& range) {
  auto [first, last] = ExactRange();
  if (std::isfinite(range.first)) first = double{range.first};
  if (std::isfinite(range.last)) last = double{range.last};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const bool is_low : {true, false}) {
      const double side = is_low ? box.low[axis] : box.high[axis];
      if (!std::isfinite(side)) continue;
      if (direction[axis] == 0) {
        if (is_low ? start[axis] < side : start[axis] > side) return std::nullopt;
        continue;
      }
      const mpq_class t = (mpq_class(side) - start[axis]) / direction[axis];
      const bool enters = is_low == (direction[axis] > 0);
      if (enters && (!first || *first < t)) first = t;
      if (!enters && (!last || *last > t)) last = t;
    }
  }
  if (first && last && *first > *last) return std::nullopt;
  return ExactRange{first, last};
}

}  // namespace surehit::test
