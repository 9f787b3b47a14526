#pragma once

#include <cmath>
#include <cstring>
#include <limits>

#include "exact/exact_contact.hpp"
#include "path_range.hpp"
#include "support/floating_point_environment.hpp"
#include "support/inlining.hpp"
#include "surehit/path.hpp"

namespace surehit::detail {

/// Returns true if two points are the same, with the signs of their zeros.
template <typename Scalar>
[[nodiscard]] bool have_same_bits(const Vector3<Scalar>& x, const Vector3<Scalar>& y) {
  return std::memcmp(x.data(), y.data(), sizeof x) == 0;
}

/// Tries points before the hit at t. Each is twice as far back, in t, as the one before it. Returns the first one that
/// the segment reaches without a hit, or the start of the segment if there is none. Each s is below 1, as the integers
/// for moving instances demand.
///
/// `Options` are those of a collider or of a scene. `is_blocked(path, options, s)` returns true if the segment to the
/// point at s has a hit. If `sees_s` is false, this depends on the point alone.
template <typename Scalar, typename Options, typename IsBlocked>
[[nodiscard]] SUREHIT_NOINLINE Vector3<Scalar> find_free_point(const Segment<Scalar>& segment, Scalar t,
                                                               const Options& options, const IsBlocked& is_blocked,
                                                               bool sees_s) noexcept {
  const FloatingPointEnvironment environment;
  const Path<Scalar> path = segment;
  if (!is_finite(path) || !std::isfinite(t) || t > 1) return segment.start;
  Vector3<Scalar> blocked = segment.start;  // The last point that was not free.
  // Below, s is exact, because it is t minus a multiple of ulp(t).
  const Scalar ulp = std::nextafter(t, std::numeric_limits<Scalar>::infinity()) - t;
  for (Scalar back = ulp; t - back > 0; back *= 2) {
    const Scalar s = t - back;
    const Segment<Scalar> free{segment.start, exact_point(path, s)};
    // All later candidates lie between this one and the start, and rounding keeps the order. So they are the start too.
    if (!sees_s && have_same_bits(free.end, segment.start)) break;
    // Near a surface, many candidates are rounded to the same point.
    if (!sees_s && have_same_bits(free.end, blocked)) continue;
    blocked = free.end;
    Options shortened = options;
    shortened.max_t = std::isnan(options.max_t) ? options.max_t : std::numeric_limits<Scalar>::infinity();
    if constexpr (requires { options.min_t; }) {
      if (options.min_t > 0) shortened.min_t = std::nextafter(options.min_t / s, Scalar{0});
    }
    if (!is_blocked(Path<Scalar>(free), shortened, s)) return free.end;
  }
  return segment.start;
}

}  // namespace surehit::detail
