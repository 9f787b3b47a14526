#pragma once

#include <cmath>
#include <limits>

#include "surehit/path.hpp"
#include "surehit/query_options.hpp"

#if defined(__FAST_MATH__)
#error "surehit's bounds do not hold under -ffast-math, nor does is_finite: compile the library without it"
#endif

namespace surehit::detail {

/// The parameters that a query admits: [first, last], either end possibly infinite. Empty unless first <= last.
template <typename Scalar>
struct PathRange {
  static constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();

  /// What the path's kind and the options' limits have in common. A NaN limit makes the range empty.
  PathRange(const Path<Scalar>& path, const QueryOptions<Scalar>& options) : PathRange(path.kind, options) {}
  PathRange(PathKind kind, const QueryOptions<Scalar>& options)
      : first(kind != PathKind::line ? Scalar{0} : -infinity), last(kind == PathKind::segment ? Scalar{1} : infinity) {
    if (!(options.min_t <= first)) first = options.min_t;
    if (!(options.max_t >= last)) last = options.max_t;
  }

  /// An exact t is finite, so limits that only an infinity would meet admit nothing.
  [[nodiscard]] bool is_empty() const { return !(first <= last && first < infinity && last > -infinity); }

  Scalar first;
  Scalar last;
};

template <typename Scalar>
[[nodiscard]] bool is_finite(const Vector3<Scalar>& vector) {
  return std::isfinite(vector[0]) && std::isfinite(vector[1]) && std::isfinite(vector[2]);
}

template <typename Scalar>
[[nodiscard]] bool is_finite(const Path<Scalar>& path) {
  return is_finite(path.start) && is_finite(path.toward);
}

template <typename Scalar>
[[nodiscard]] bool is_finite(const Triangle<Scalar>& triangle) {
  return is_finite(triangle.a) && is_finite(triangle.b) && is_finite(triangle.c);
}

}  // namespace surehit::detail
