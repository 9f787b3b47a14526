#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "filter/bounded.hpp"
#include "surehit/path.hpp"
#include "surehit/triangle.hpp"

namespace surehit::test {

/// The coordinates of the start and the direction of a path, and of the corners a, b and c.
using PairCoordinates = std::array<double, 15>;

template <typename Scalar>
PairCoordinates coordinates_of(const Path<Scalar>& path, const Triangle<Scalar>& triangle) {
  PairCoordinates coordinates;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<Eigen::Index>(axis);
    const double start = path.start[k];
    const double toward = path.toward[k];
    coordinates[axis] = start;
    coordinates[3 + axis] = path.has_end() ? toward - start : toward;
    coordinates[6 + axis] = triangle.a[k];
    coordinates[9 + axis] = triangle.b[k];
    coordinates[12 + axis] = triangle.c[k];
  }
  return coordinates;
}

struct LaneDeterminants {
  detail::Bounded det, height, u, v;
};

/// `detail::DoubleDeterminants` on the instruction set that is chosen at the moment, as many pairs at a time as it has
/// lanes.
void double_determinants(std::span<const PairCoordinates> pairs, std::span<LaneDeterminants> results);

/// `detail::Quotients` there: [lower, upper] of each numerator by the denominator of the same index.
void quotients(std::span<const detail::Bounded> numerators, std::span<const detail::Bounded> denominators,
               std::span<std::array<double, 2>> results);

/// What `detail::HitIntervals` goes by besides the pair.
struct HitSizes {
  float t, edge;
};
struct LaneIntervals {
  std::array<double, 2> t, u, v;
};
/// `detail::HitIntervals` there.
void hit_intervals(std::span<const PairCoordinates> pairs, std::span<const HitSizes> sizes,
                   std::span<LaneIntervals> results);

/// What `detail::intervals_from_hits` makes of them there, for segments with these ends. Where it knows nothing, or
/// where there are no fused operations, all ends are infinite.
void hit_intervals_from_hits(std::span<const PairCoordinates> pairs, std::span<const std::array<double, 3>> ends,
                             std::span<const HitSizes> sizes, std::span<LaneIntervals> results);

/// A `detail::DoubleHitIntervals::Interval` of a pair.
struct WordInterval {
  double high, low, bound;
};
/// What `detail::RoundedDoubleHits` and `detail::DoubleHitIntervals` say of a pair.
struct LaneHit {
  double t, u, v;
  bool is_rounded, is_front, is_known;
  WordInterval t_interval, u_interval, v_interval;
};
/// `detail::RoundedDoubleHits` there. All paths must be of one kind.
void round_hits(std::span<const Path<double>> paths, std::span<const Triangle<double>> triangles,
                std::span<LaneHit> results);

[[nodiscard]] std::size_t double_lanes();

}  // namespace surehit::test
