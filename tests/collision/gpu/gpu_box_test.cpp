// Which boxes a device passes over, with roundings that Vulkan allows it. No device is asked.

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "collision/filter/coordinate_changes.hpp"
#include "collision/rational_determinants.hpp"
#include "device_box.hpp"
#include "device_path.hpp"
#include "support/case_count.hpp"
#include "support/pair_text.hpp"

namespace surehit::test::gpu_box_test {
namespace {

using Arithmetic = DeviceArithmetic;
using detail::PathRange;

constexpr float infinity = PathRange<float>::infinity;
constexpr double h = 0x1p-23;

/// Returns how much earlier or later than t a device may come to a plane (G6).
mpq_class slack_at(const mpq_class& t) { return 16 * h * abs(t) + mpq_class(0x1p-58); }

struct Case {
  [[nodiscard]] Path<float> path() const {
    const Vector3f start(x[0], x[1], x[2]);
    const Vector3f toward(x[3], x[4], x[5]);
    return is_segment ? Path<float>(Segment<float>{start, toward}) : Path<float>(PathKind::line, start, toward);
  }
  [[nodiscard]] RationalVector way() const {
    const RationalVector toward = rational(path().toward);
    return is_segment ? difference(toward, rational(path().start)) : toward;
  }
  [[nodiscard]] DeviceBox box() const {
    const Vector3f one(x[6], x[7], x[8]);
    const Vector3f other(x[9], x[10], x[11]);
    return {one.cwiseMin(other), one.cwiseMax(other)};
  }
  [[nodiscard]] PathRange<float> range() const { return is_segment ? PathRange<float>(0, 1) : any_range; }

  std::array<float, 12> x = {};
  bool is_segment = false;
  PathRange<float> any_range = {-infinity, infinity};
  Roundings roundings;
  std::size_t moved = 0;  ///< The number that is moved until the box is hardly passed over.
  float end = 0;          ///< Where it is moved to.
};

float number(Random& random, int exponent) { return std::ldexp(random.symmetric<float>(), exponent); }

/// Draws a path of any speed on each axis, and a box that it comes to. Some paths touch it with a corner: a segment
/// with its end, and a line at a power of two.
Case draw(Random& random) {
  Case drawn;
  drawn.roundings = Roundings::drawn(random);
  drawn.is_segment = random.one_in(2);
  if (random.one_in(2)) drawn.any_range = {0, infinity};
  const bool touches = random.one_in(2);
  const float t = drawn.is_segment ? (touches ? 1 : random.unit<float>())
                                   : std::ldexp(touches ? 1.0F : random.symmetric<float>(),
                                                static_cast<int>(random.one_in(2) ? 0 : random.between(-100, 60)));
  for (std::size_t i = 0; i < 3; ++i) {
    constexpr std::array<int, 8> exponents = {0, 0, 0, -20, -59, -60, -62, -130};
    const int exponent = exponents[random.below(exponents.size())];
    float& start = drawn.x[i];
    float& toward = drawn.x[3 + i];
    start = random.one_in(8) ? 0 : number(random, random.one_in(2) ? exponent : 2);
    toward = random.one_in(8) ? 0 : number(random, exponent);
    const float place = start + t * toward;
    if (drawn.is_segment) toward = touches ? place : start + toward;
    const float size = random.one_in(3) ? 0 : number(random, exponent);
    drawn.x[6 + i] = place;
    drawn.x[9 + i] = place + size;
  }
  drawn.moved = random.below(drawn.x.size());
  drawn.end = number(random, 2);
  return drawn;
}

/// Draws a path that hardly moves, and a box beside it that can be moved to it.
Case draw_slow(Random& random) {
  Case drawn;
  drawn.roundings = Roundings::drawn(random);
  drawn.is_segment = random.one_in(2);
  for (std::size_t i = 0; i < 3; ++i) {
    drawn.x[i] = number(random, -60);
    drawn.x[3 + i] = drawn.is_segment ? drawn.x[i] + number(random, -60) : 0;
    drawn.x[6 + i] = drawn.x[i];
    drawn.x[9 + i] = drawn.x[i];
  }
  drawn.moved = 6 + random.below(3);
  drawn.end = drawn.x[drawn.moved];
  drawn.x[drawn.moved] = drawn.x[drawn.moved + 3] = number(random, -50);
  return drawn;
}

/// Draws a line that is nearly too slow to be cut. The differences of a box from its start are flushed.
Case draw_flushed(Random& random) {
  Case drawn;
  drawn.roundings = Roundings::drawn(random);
  for (std::size_t i = 0; i < 3; ++i) {
    drawn.x[i] = number(random, -125);
    drawn.x[3 + i] = number(random, -59);
    drawn.x[6 + i] = drawn.x[i] + number(random, -125);
    drawn.x[9 + i] = drawn.x[i] + number(random, -125);
  }
  return drawn;
}

Case changed(Random& random, const Case& from) {
  Case next = from;
  if (random.one_in(2)) {
    next.roundings = from.roundings.changed(random);
    return next;
  }
  if (random.one_in(4)) {
    next.moved = random.below(next.x.size());
    next.end = next.x[next.moved] + number(random, static_cast<int>(random.between(-30, 2)));
    return next;
  }
  float& x = next.x[random.below(next.x.size())];
  x = changed_coordinate(random, x);
  return next;
}

struct Verdict {
  Stay stay;
  std::optional<mpq_class> enters;
};

std::optional<Verdict> verdict_of(const Case& at) {
  Arithmetic device;
  // A mesh has no larger box, and a path no larger coordinate (G2).
  if (!(at.box().low.cwiseAbs().cwiseMax(at.box().high.cwiseAbs()).maxCoeff() <= 0x1p33F)) return std::nullopt;
  if (!take(device, at.path(), at.range())) return std::nullopt;
  return Verdict{stay_of(rational(at.path().start), at.way(), at.box(), at.range()), entered(device, at.box())};
}

TEST(GpuBox, is_never_passed_over_where_a_path_meets_it) {
  std::size_t touched = 0;
  std::size_t passed_over = 0;
  on_every_device([&] {
    Random random(71);
    for (std::size_t i = case_count(3000); i > 0; --i) {
      const Case drawn = draw(random);
      const auto verdict = verdict_of(drawn);
      if (!verdict) continue;
      const Stay& stay = verdict->stay;
      passed_over += verdict->enters ? 0 : 1;
      if (!is_met(stay)) continue;
      touched += stay.in == stay.out ? 1 : 0;
      ASSERT_TRUE(verdict->enters) << hex_text(drawn.path());
      EXPECT_LE(*verdict->enters, std::max(stay.in, mpq_class(-0x1p100))) << hex_text(drawn.path());
    }
  });
  if (runs_all_cases()) {
    EXPECT_GT(touched, 1000U);
    EXPECT_GT(passed_over, 1000U);
  }
}

/// G6. Returns how much of the slack the errors of an entry take up. At 1, the computed entry is the exact one.
double share_of_entry(const Case& at) {
  const auto verdict = verdict_of(at);
  if (!verdict || !verdict->enters || !is_met(verdict->stay)) return 0;
  const mpq_class in = std::max(verdict->stay.fast_in, mpq_class(-0x1p100));
  return 1 - mpq_class((in - *verdict->enters) / slack_at(in)).get_d();
}

/// Returns the same of a box that is passed over, because the path is in it on no axis at once, or because it stays
/// outside on an axis. At 1, the path touches it.
double share_of_miss(const Case& at, bool stays_outside) {
  const Case edge = at_the_edge(at, [](const Case& any) {
    any.roundings.begin();
    const auto verdict = verdict_of(any);
    return verdict && !verdict->enters;
  });
  edge.roundings.begin();
  const auto verdict = verdict_of(edge);
  if (!verdict || verdict->enters) return 0;
  const Stay& stay = verdict->stay;
  if (is_met(stay)) return 2;
  const mpq_class of_fast = (stay.fast_in - stay.fast_out) / (slack_at(stay.fast_in) + slack_at(stay.fast_out));
  const mpq_class of_slow = stay.outside / mpq_class(0x1p-59);
  if ((of_slow > of_fast) != stays_outside) return 0;
  return 1 - std::max(of_fast, of_slow).get_d();
}

TEST(GpuBox, slack_is_not_used_up_where_hill_climbing_makes_the_error_worst) {
  const auto climb = [](const std::string& name, std::size_t steps, const auto& draw_case, const auto& share_of) {
    Random random(72);
    expect_below_bound(
        name, 8, steps, [&] { return draw_case(random); }, [&](const Case& from) { return changed(random, from); },
        share_of);
  };
  climb("G6_of_entries", 5000, draw, share_of_entry);
  climb("G6_of_misses", 1500, draw, [](const Case& at) { return share_of_miss(at, false); });
  climb("G6_of_slow_paths", 200, draw_slow, [](const Case& at) { return share_of_miss(at, true); });
  Random random(74);
  const auto draw_next = [&] { return draw_flushed(random); };
  expect_below_bound(
      "G6_of_flushed_numbers", 1, 10'000, draw_next, [&](const Case&) { return draw_next(); }, share_of_entry);
}

}  // namespace
}  // namespace surehit::test::gpu_box_test
