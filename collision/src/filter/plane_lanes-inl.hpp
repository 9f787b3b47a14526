// The triangles of a list, against where a path starts and against a plane that it does not leave. Highway compiles
// this for each instruction set.

#if defined(SUREHIT_PLANE_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SUREHIT_PLANE_LANES_INL
#undef SUREHIT_PLANE_LANES_INL
#else
#define SUREHIT_PLANE_LANES_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "filter/block_kernel-inl.hpp"
#include "support/lane_bits-inl.hpp"
#include "surehit/path.hpp"

HWY_BEFORE_NAMESPACE();
namespace surehit::detail::HWY_NAMESPACE {

/// The lanes whose corners share coordinates with the start of a path.
struct SharingLanes {
  std::uint64_t corner;                ///< A corner is at the start.
  std::array<std::uint64_t, 3> plane;  ///< All corners have the start's coordinate on this axis.
};

/// Returns the lanes that share coordinates with the start. Lane 0 has triangle `from`. All comparisons are exact.
/// Lanes after the last triangle have no meaning.
template <typename Scalar>
HWY_INLINE SharingLanes lanes_that_share(const Path<Scalar>& path, const TriangleList<Scalar>& list, std::size_t from) {
  const hn::ScalableTag<Scalar> d;
  SharingLanes result;
  std::array<hn::Mask<decltype(d)>, 3> corners;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto start = hn::Set(d, path.start[static_cast<Eigen::Index>(axis)]);
    const auto is_there = [&](std::size_t corner) {
      return hn::Eq(hn::LoadU(d, list.corners + ((3 * corner + axis) * list.count + from)), start);
    };
    const auto a = is_there(0), b = is_there(1), c = is_there(2);
    corners[0] = axis == 0 ? a : hn::And(corners[0], a);
    corners[1] = axis == 0 ? b : hn::And(corners[1], b);
    corners[2] = axis == 0 ? c : hn::And(corners[2], c);
    result.plane[axis] = bits_of(d, hn::And(hn::And(a, b), c));
  }
  result.corner = bits_of(d, hn::Or(hn::Or(corners[0], corners[1]), corners[2]));
  return result;
}

/// What is certain of a segment and some lanes.
struct SeenLanes {
  std::uint64_t misses;  ///< The segment misses these.
  std::uint64_t around;  ///< Seen along the axis, the start is inside these.
};

/// Looks along an axis at a segment and some lanes. The segment must have the same coordinate at both ends on this
/// axis.
///
/// Here x and y are the other two axes, P is the start and Q the end. The area of three points p, q and r is the sum
/// (p - r).x (q - r).y - (p - r).y (q - r).x, with (p - r) and (q - r) as computed in double.
///
/// PL1. Let no component of the differences exceed m. Then an area is off by at most 2^-49 m^2.
/// Proof. Each of the two products passes through four roundings: two differences, the product and the sum. So it is
///     off by 4 eps m^2, up to terms in eps^2, where eps = 2^-53. Both together are 2^-50 m^2. The other half is for
///     the roundings of m and of the bound, and the smallest normal number covers underflow. A fused product has fewer.
///     If a sum of six products might overflow, the bound is infinite, because 16 m^2 is. Then nothing is certain.
///
/// PL2. Let n be the sum of P's three areas with the edges. It is off by at most 4 bounds of PL1.
/// Proof. Each area is off by half a bound. Its size is at most 2 m^2, so the two roundings of the sum are below a
///     whole bound. What is left covers the roundings of five bounds, and of their sum with n.
///
/// PL3. The segment misses the triangle if they are apart as seen along the axis. They are apart there if P and Q are
///     beside an edge's line, and if no corner is as far on this side. They also are if all corners are on one side of
///     the segment's line.
/// Proof. A point that they share is seen in both. The area with an edge is a linear function of the point. It is zero
///     at two corners, and n at the third one. If it is below 0 and below n at P and Q, it is below the minimum of the
///     triangle on all of the segment. The same holds above 0 and n. The second condition is such a function too: that
///     of the segment's line. The bounds of PL1 and PL2 make each comparison certain.
///
/// PL4. If P's areas with all three edges are above their bounds, or all are below the opposite, P is inside as seen.
/// Proof. P is on the same side of each edge's line, which for a triangle is the inside.
template <typename Scalar>
HWY_NOINLINE SeenLanes lanes_seen_along(std::size_t axis, const Path<Scalar>& segment, const TriangleList<Scalar>& list,
                                        std::size_t from, std::uint64_t lanes) {
  const hn::ScalableTag<double> d;
  using V = hn::Vec<decltype(d)>;
  struct Seen {
    V x, y;
  };
  const std::size_t x = (axis + 1) % 3;
  const std::size_t y = (axis + 2) % 3;
  const auto number = [&](const Vector3<Scalar>& point, std::size_t on) {
    return double{point[static_cast<Eigen::Index>(on)]};
  };
  const double way_x = number(segment.toward, x) - number(segment.start, x);
  const double way_y = number(segment.toward, y) - number(segment.start, y);
  const V length = hn::Set(d, std::max(std::fabs(way_x), std::fabs(way_y)));
  const Seen start = {hn::Set(d, number(segment.start, x)), hn::Set(d, number(segment.start, y))};
  const Seen end = {hn::Set(d, number(segment.toward, x)), hn::Set(d, number(segment.toward, y))};
  const Seen way = {hn::Set(d, way_x), hn::Set(d, way_y)};
  const auto area = [](const Seen& p, const Seen& q) { return hn::MulSub(p.x, q.y, hn::Mul(p.y, q.x)); };
  const std::size_t part = hn::Lanes(d);
  const std::uint64_t all = (std::uint64_t{1} << part) - 1;
  SeenLanes result = {0, 0};
  for (std::size_t at = 0; lanes >> at != 0; at += part) {
    const std::uint64_t some = lanes >> at & all;
    if (some == 0) continue;
    const auto load = [&](std::size_t coordinate) {
      const Scalar* const first = list.corners + (coordinate * list.count + from + at);
      if constexpr (std::is_same_v<Scalar, double>) {
        return hn::LoadU(d, first);
      } else {
        return hn::PromoteTo(d, hn::LoadU(hn::Rebind<Scalar, decltype(d)>(), first));
      }
    };
    Seen from_start[3];
    Seen from_end[3];
    V size = hn::Zero(d);
    for (std::size_t i = 0; i < 3; ++i) {
      const Seen corner = {load(3 * i + x), load(3 * i + y)};
      from_start[i] = {hn::Sub(corner.x, start.x), hn::Sub(corner.y, start.y)};
      from_end[i] = {hn::Sub(corner.x, end.x), hn::Sub(corner.y, end.y)};
      size = hn::Max(size, hn::Max(hn::Abs(from_start[i].x), hn::Abs(from_start[i].y)));
    }
    size = hn::Add(size, length);
    // PL1
    const V sizes = hn::Mul(hn::Mul(size, size), hn::Set(d, 16));
    const V bound = hn::MulAdd(sizes, hn::Set(d, 0x1p-53), hn::Set(d, std::numeric_limits<double>::min()));
    const V of_start[3] = {area(from_start[0], from_start[1]), area(from_start[1], from_start[2]),
                           area(from_start[2], from_start[0])};
    const V sum = hn::Add(hn::Add(of_start[0], of_start[1]), of_start[2]);
    const V of_sum = hn::Mul(bound, hn::Set(d, 5));  // PL2, and the bound of the area that is compared with it.
    const V low = hn::Min(hn::Neg(bound), hn::Sub(sum, of_sum));
    const V high = hn::Max(bound, hn::Add(sum, of_sum));
    auto apart = hn::FirstN(d, 0);
    for (std::size_t i = 0; i < 3; ++i) {
      const V of_end = area(from_end[i], from_end[(i + 1) % 3]);
      apart =
          hn::Or(apart, hn::Or(hn::Lt(hn::Max(of_start[i], of_end), low), hn::Gt(hn::Min(of_start[i], of_end), high)));
    }
    const V beside[3] = {area(way, from_start[0]), area(way, from_start[1]), area(way, from_start[2])};
    const auto are_below = [&](const V(&areas)[3]) {
      return hn::Lt(hn::Max(hn::Max(areas[0], areas[1]), areas[2]), hn::Neg(bound));
    };
    const auto are_above = [&](const V(&areas)[3]) {
      return hn::Gt(hn::Min(hn::Min(areas[0], areas[1]), areas[2]), bound);
    };
    apart = hn::Or(apart, hn::Or(are_below(beside), are_above(beside)));  // PL3
    result.misses |= (bits_of(d, apart) & some) << at;
    result.around |= (bits_of(d, hn::Or(are_below(of_start), are_above(of_start))) & some) << at;  // PL4
  }
  return result;
}

}  // namespace surehit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
