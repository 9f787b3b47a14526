#pragma once

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>

#include "collision/rational_determinants.hpp"
#include "device_arithmetic.hpp"
#include "filter/kernel_bound.hpp"
#include "path_range.hpp"
#include "support/hill_climb.hpp"
#include "support/random.hpp"
#include "surehit/path.hpp"

namespace surehit::test {

// How tests give paths to the text of a shader, and search for the roundings that do the most harm to them.

inline mpq_class rational(DeviceFloat x) { return mpq_class(double{x.value()}); }
inline RationalVector rational(const DeviceArithmetic::vec3& x) {
  return {rational(x.x), rational(x.y), rational(x.z)};
}
inline DeviceArithmetic::vec3 device_vector(const Vector3f& x) { return {x[0], x[1], x[2]}; }

/// Lets a device take a path and its range, as `path_limits` makes them for it. Returns false if they are left to the
/// host.
inline bool take(DeviceArithmetic& device, const Path<float>& path, const detail::PathRange<float>& range) {
  using uvec3 = DeviceArithmetic::uvec3;
  const detail::RangeWeights<float> weights(range);
  device.range = {};
  device.range.t_first = weights.t_first;
  device.range.det_first = weights.det_first;
  device.range.t_last = weights.t_last;
  device.range.det_last = weights.det_last;
  device.range.first = std::max(range.first, -0x1p100F);
  device.range.last = std::min(range.last, 0x1p100F);
  device.range.flags = weights.is_whole ? device.is_whole : 0;
  const auto bits = [](const Vector3f& x) {
    return uvec3(std::bit_cast<std::uint32_t>(x[0]), std::bit_cast<std::uint32_t>(x[1]),
                 std::bit_cast<std::uint32_t>(x[2]));
  };
  return weights.decides && device.take_path(bits(path.start), bits(path.toward), path.kind == PathKind::segment);
}

/// How a device rounds one operation after another.
struct Roundings {
  RoundingList list = {};
  bool flushes = false;

  [[nodiscard]] static Roundings drawn(Random& random) {
    Roundings result;
    result.flushes = random.one_in(2);
    for (std::int8_t& choice : result.list) choice = static_cast<std::int8_t>(random.between(-2, 2));
    return result;
  }
  [[nodiscard]] Roundings changed(Random& random) const {
    Roundings result = *this;
    for (std::uint64_t i = 1 + random.below(6); i > 0; --i) {
      result.list[random.below(list.size())] = static_cast<std::int8_t>(random.between(-2, 2));
    }
    return result;
  }
  /// The next operation is the first of the list.
  void begin() const {
    DeviceFloat::rounding = DeviceRounding::listed;
    DeviceFloat::flushes = flushes;
    DeviceFloat::list = list;
    DeviceFloat::place = 0;
  }
};

/// Climbs to the worst share of a bound, and expects that it is below 1. A case has its `roundings`.
template <typename Draw, typename Changed, typename ShareOf>
void expect_below_bound(const std::string& name, std::size_t starts, std::size_t steps, const Draw& draw,
                        const Changed& changed, const ShareOf& share_of) {
  const double worst = climb_to_worst(starts, steps, draw, changed, [&](const auto& at) {
    at.roundings.begin();
    const double share = share_of(at);
    DeviceFloat::rounding = DeviceRounding::nearest;
    DeviceFloat::flushes = false;
    return share;
  });
  expect_within_bound(name, worst);
}

/// Returns a case of which something is hardly true: its number `moved` goes toward `end` as long as that stays true.
template <typename Case, typename IsSo>
Case at_the_edge(const Case& at, const IsSo& is_so) {
  Case next = at;
  next.x[at.moved] = at.end;
  if (!is_so(at) || is_so(next)) return at;
  float inside = at.x[at.moved];
  for (float outside = at.end;;) {
    const float middle = inside + (outside - inside) / 2;
    next.x[at.moved] = middle;
    if (middle == inside || middle == outside) break;
    (is_so(next) ? inside : outside) = middle;
  }
  next.x[at.moved] = inside;
  return next;
}

}  // namespace surehit::test
