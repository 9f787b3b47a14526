// Which boxes a device passes over in the frame of an instance, with roundings that Vulkan allows it. No device is
// asked.

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "collision/filter/coordinate_changes.hpp"
#include "collision/rational_determinants.hpp"
#include "device_box.hpp"
#include "device_path.hpp"

namespace surehit::test::gpu_placed_box_test {
namespace {

using Arithmetic = DeviceArithmetic;
using detail::PathRange;

constexpr float infinity = PathRange<float>::infinity;

/// A path in the frame of an instance that has the identity as its pose, and an error. A box has a point that the exact
/// path comes to at `t`.
struct Placed {
  std::array<float, 3> point = {};
  std::array<float, 3> way = {};
  std::array<float, 3> size = {};  ///< Where the other corner of the box is.
  float t = 0;
  float first = -infinity;
  float last = infinity;
  float share = 0;                 ///< That of the instance. It makes the errors as large as they are.
  std::array<double, 6> off = {};  ///< Where the exact path is within the errors of the placed one, from -1 to 1.
  Roundings roundings;
};

/// Returns the share of the padding that the box needs, or 2 if it needs more than it has (G17). It is 0 if the path
/// is left to the host.
double share_of_padding(const Placed& at) {
  Arithmetic device;
  const Vector3f w(at.way[0], at.way[1], at.way[2]);
  const Vector3f p(at.point[0], at.point[1], at.point[2]);
  const Vector3f q = p + Vector3f(at.size[0], at.size[1], at.size[2]);
  const PathRange<float> range(at.first, at.last);
  const double of_way = 6 * double{at.share} * double{w.cwiseAbs().maxCoeff()};
  // The start that the device has is one whose errors lead to the exact one.
  Vector3f start = Vector3f::Zero();
  for (int step = 0; step < 20; ++step) {
    const double of_start = 5 * double{at.share} * double{start.cwiseAbs().maxCoeff()};
    for (Eigen::Index i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const double exact = double{p[i]} - double{at.t} * (double{w[i]} + at.off[3 + k] * of_way);
      start[i] = static_cast<float>(exact - 0.999 * at.off[k] * of_start);
    }
  }
  if (!take(device, Path<float>(PathKind::line, start, w), range)) return 0;
  Arithmetic::Instance instance = {};
  for (const std::size_t i : {0U, 4U, 8U}) instance.inverse[i] = 1;
  instance.share = at.share;
  instance.reach = std::max(p.cwiseAbs().maxCoeff(), q.cwiseAbs().maxCoeff());
  const DeviceFloat max_t = Arithmetic::max(Arithmetic::abs(device.range.first), Arithmetic::abs(device.range.last));
  const Arithmetic::PlacedPath placed = device.place(instance, device.start, device.way, false, max_t);
  if (!device.enter_frame(instance, false, max_t)) return 0;

  RationalVector exact_way;
  RationalVector exact_start;
  const mpq_class t(double{at.t});
  for (std::size_t i = 0; i < 3; ++i) {
    exact_way[i] = rational(device.way)[i] + at.off[3 + i] * rational(placed.way_error);
    exact_start[i] = rational(p)[i] - t * exact_way[i];
    if (abs(exact_start[i] - rational(device.start)[i]) > rational(placed.start_error)) return 0;
  }
  const DeviceBox box{p.cwiseMin(q), p.cwiseMax(q)};
  const Stay exact = stay_of(exact_start, exact_way, box, range);
  if (!is_met(exact)) return 0;  // t is not in the range.
  const DeviceFloat padding = device.padding;
  const auto is_enough = [&](double share) {
    at.roundings.begin();
    device.padding = padding.value() * share;
    const auto enters = entered(device, box);
    return enters && *enters <= exact.in;
  };
  if (!is_enough(1)) return 2;
  double least = 0;
  double most = 1;
  for (int step = 0; step < 14; ++step) {
    const double middle = (least + most) / 2;
    (is_enough(middle) ? most : least) = middle;
  }
  return least;
}

float number(Random& random, int exponent) { return std::ldexp(random.symmetric<float>(), exponent); }
double draw_off(Random& random) { return random.one_in(2) ? (random.one_in(2) ? 1 : -1) : random.symmetric<double>(); }

Placed draw(Random& random) {
  Placed drawn;
  drawn.roundings = Roundings::drawn(random);
  const auto between = [&](int low, int high) { return static_cast<int>(random.between(low, high)); };
  const int speed = between(-58, 10);
  for (std::size_t i = 0; i < 3; ++i) {
    drawn.point[i] = number(random, 0);
    const int slow = random.one_in(2) ? -60 : between(-70, 0);
    drawn.way[i] = random.one_in(6) ? 0 : number(random, random.one_in(3) ? slow : speed);
    drawn.size[i] = random.one_in(2) ? 0 : number(random, 0);
  }
  drawn.t = number(random, between(-4, 24) - speed);
  drawn.share = std::ldexp(1 + random.unit<float>(), between(-40, -1));
  for (double& off : drawn.off) off = draw_off(random);
  if (random.one_in(4)) {
    // The path begins near the origin, and its direction is nearly too uncertain to bound t.
    drawn.share = (1 + random.unit<float>()) / 18;
    drawn.way = {drawn.way[0], 0, 0};
    drawn.point = {drawn.point[0], 0, 0};
    const double way = double{drawn.way[0]} + drawn.off[3] * 6 * double{drawn.share * std::fabs(drawn.way[0])};
    drawn.t = static_cast<float>(double{drawn.point[0]} / way);
  }
  if (random.one_in(2)) drawn.first = random.one_in(2) ? drawn.t : 0;
  if (random.one_in(2)) drawn.last = random.one_in(2) ? drawn.t : 1;
  return drawn;
}

Placed changed(Random& random, const Placed& from) {
  Placed next = from;
  const std::size_t i = random.below(3);
  switch (random.below(8)) {
    case 0:
      next.point[i] = changed_coordinate(random, next.point[i]);
      break;
    case 1:
      next.way[i] *= 1 + random.symmetric<float>() / 4;
      break;
    case 2:
      next.size[i] = random.one_in(2) ? 0 : changed_coordinate(random, next.size[i]);
      break;
    case 3:
      next.t *= 1 + random.symmetric<float>() / 4;
      break;
    case 4:
      next.share *= 1 + random.symmetric<float>() / 4;
      break;
    case 5:
      next.roundings = from.roundings.changed(random);
      break;
    default:
      next.off[random.below(6)] = draw_off(random);
  }
  return next;
}

TEST(GpuPlacedBox, padding_is_not_used_up_where_hill_climbing_needs_most_of_it) {
  Random random(73);
  expect_below_bound(
      "G17", 20, 2000, [&] { return draw(random); }, [&](const Placed& from) { return changed(random, from); },
      share_of_padding);
}

}  // namespace
}  // namespace surehit::test::gpu_placed_box_test
