#pragma once

#include <array>
#include <cstdint>

#include "support/random.hpp"
#include "surehit/path.hpp"

namespace surehit::test {

/// Drawn in whole numbers, and so the same on every platform.
using LatticePoint = std::array<std::int64_t, 3>;
using LatticeTriangle = std::array<LatticePoint, 3>;
/// Drawn in braces, which are evaluated from left to right; arguments are in any order.
struct LatticeSegment {
  LatticePoint start, end;
};

[[nodiscard]] inline LatticePoint sum(const LatticePoint& left, const LatticePoint& right) {
  return {left[0] + right[0], left[1] + right[1], left[2] + right[2]};
}
[[nodiscard]] inline LatticePoint difference(const LatticePoint& left, const LatticePoint& right) {
  return {left[0] - right[0], left[1] - right[1], left[2] - right[2]};
}
[[nodiscard]] inline LatticePoint reflected(const LatticePoint& point, const LatticePoint& centre) {
  return difference(centre, difference(point, centre));
}

/// Returns a point that is up to `reach` away from 0 on each axis.
[[nodiscard]] inline LatticePoint draw_lattice_point(Random& random, std::int64_t reach) {
  const auto draw = [&] { return random.between(-reach, reach); };
  return {draw(), draw(), draw()};
}

/// Exact if `spacing` is a power of two and no product overflows, underflows or has more digits than a Scalar.
template <typename Scalar>
[[nodiscard]] Vector3<Scalar> scalars(const LatticePoint& point, Scalar spacing) {
  const auto scalar = [&](std::int64_t x) { return static_cast<Scalar>(x) * spacing; };
  return {scalar(point[0]), scalar(point[1]), scalar(point[2])};
}

/// Returns a segment to `end`, or else a ray or a line that goes in `direction`.
template <typename Scalar>
[[nodiscard]] Path<Scalar> path_of_any_kind(Random& random, const Vector3<Scalar>& start, const Vector3<Scalar>& end,
                                            const Vector3<Scalar>& direction) {
  switch (random.below(5)) {
    case 0:
      return Ray<Scalar>{start, direction};
    case 1:
      return Line<Scalar>{start, direction};
    default:
      return Segment<Scalar>{start, end};
  }
}

}  // namespace surehit::test
