#pragma once

#include <cmath>
#include <limits>

#include "surehit/path.hpp"
#include "surehit/query_options.hpp"

#if defined(__FAST_MATH__)
#error "surehit's bounds do not hold under -ffast-math, nor does is_finite: compile the library without it"
#endif

namespace surehit::detail {

/// The range of parameters that a query admits: [first, last]. Either end may be infinite.
template <typename Scalar>
struct PathRange {
  static constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();

  /// Makes the range that the kind of the path and the limits of the options both admit. If a limit is NaN, the range
  /// is empty.
  PathRange(const Path<Scalar>& path, const QueryOptions<Scalar>& options) : PathRange(path.kind, options) {}
  /// Does the same for a kind of path. `Options` are those of a collider or of a scene.
  template <typename Options>
  PathRange(PathKind kind, const Options& options)
      : first(kind != PathKind::line ? Scalar{0} : -infinity), last(kind == PathKind::segment ? Scalar{1} : infinity) {
    if (!(options.min_t <= first)) first = options.min_t;
    if (!(options.max_t >= last)) last = options.max_t;
  }

  /// Makes the range of these parameters.
  PathRange(Scalar any_first, Scalar any_last) : first(any_first), last(any_last) {}

  /// Returns true if the range has no finite t. An exact t is always finite.
  [[nodiscard]] bool is_empty() const { return !(first <= last && first < infinity && last > -infinity); }

  Scalar first;  ///< The minimum t.
  Scalar last;   ///< The maximum t.
};

/// Returns true if all coordinates are finite.
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
