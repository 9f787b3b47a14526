// What a device is certain of beside a triangle, in floats, with roundings that Vulkan allows it. No device is asked.

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "collision/filter/coordinate_changes.hpp"
#include "collision/rational_determinants.hpp"
#include "device_path.hpp"
#include "support/case_count.hpp"
#include "support/exact_oracle.hpp"
#include "support/neighbour.hpp"
#include "support/pair_families.hpp"
#include "support/pair_text.hpp"

namespace surehit::test::gpu_path_kernel_test {
namespace {

using Arithmetic = DeviceArithmetic;
using detail::PathRange;

constexpr float infinity = PathRange<float>::infinity;
constexpr double h = 0x1p-23;

struct Found {
  std::uint32_t verdict;
  mpq_class lower;
  mpq_class upper;
  bool is_front;
};

std::optional<Found> classified(const Path<float>& path, const Triangle<float>& triangle,
                                const PathRange<float>& range) {
  Arithmetic device;
  if (!take(device, path, range)) return std::nullopt;
  DeviceFloat lower;
  DeviceFloat upper;
  bool is_front = false;
  const std::uint32_t verdict = device.classify(device_vector(triangle.a), device_vector(triangle.b),
                                                device_vector(triangle.c), lower, upper, is_front);
  return Found{verdict, rational(lower), rational(upper), is_front};
}

/// Expects that what is certain is so. Returns true if something is.
bool is_certain(const Path<float>& path, const Triangle<float>& triangle, const QueryOptions<float>& options) {
  Arithmetic device;
  const auto found = classified(path, triangle, PathRange<float>(path.kind, options));
  if (!found || found->verdict == device.is_open) return false;
  SCOPED_TRACE(hex_text(path) + hex_text(triangle));
  const auto contact = exact_contact(path, triangle, options);
  EXPECT_EQ(contact.has_value(), found->verdict == device.is_hit);
  if (!contact || found->verdict == device.is_missed) return true;
  EXPECT_LE(found->lower, contact->t);
  EXPECT_GE(found->upper, contact->t);
  EXPECT_EQ(found->is_front, contact->side == Side::front);
  return true;
}

/// G4, G5.
TEST(GpuPathKernel, is_never_wrong_on_any_family) {
  on_every_device([] {
    std::size_t certain = 0;
    for (const PairFamily family : all_pair_families) {
      SCOPED_TRACE(name_of(family));
      Random random(61);
      for (std::size_t i = case_count(60); i > 0; --i) {
        const auto [segment, triangle] = draw_pair<float>(family, random);
        const Path<float> path = path_along(segment, static_cast<PathKind>(i % 3));
        const auto largest = std::max({path.start.cwiseAbs().maxCoeff(), path.toward.cwiseAbs().maxCoeff(),
                                       triangle.a.cwiseAbs().maxCoeff(), triangle.b.cwiseAbs().maxCoeff(),
                                       triangle.c.cwiseAbs().maxCoeff()});
        if (!(largest <= 0x1p33F)) continue;  // It never comes so far (G2).
        certain += is_certain(path, triangle, {}) ? 1 : 0;
        const RationalDeterminants of = rational_determinants(path, triangle);
        if (of.det == 0) continue;
        const auto t = static_cast<float>(mpq_class(of.height / of.det).get_d());
        if (!(std::fabs(t) >= 0x1p-126F)) continue;  // The host answers for limits that may be flushed.
        for (const int steps : {-40, -2, 0, 2, 40}) {
          QueryOptions<float> options;
          (steps % 3 == 0 ? options.min_t : options.max_t) = neighbour(t, steps);
          certain += is_certain(path, triangle, options) ? 1 : 0;
        }
      }
    }
    if (runs_all_cases()) {
      EXPECT_GT(certain, 250U);
    }
  });
}

/// A path and a triangle, and how a device rounds.
struct Case {
  [[nodiscard]] Path<float> path() const { return Segment<float>{{x[0], x[1], x[2]}, {x[3], x[4], x[5]}}; }
  [[nodiscard]] Triangle<float> triangle() const {
    return {{x[6], x[7], x[8]}, {x[9], x[10], x[11]}, {x[12], x[13], x[14]}};
  }

  [[nodiscard]] PathRange<float> range() const { return {x[15], x[16]}; }

  std::array<float, 17> x;  ///< The last two are the range.
  Roundings roundings;
  std::size_t moved = 0;           ///< The number that is moved until the verdict is hardly certain (G4).
  float end = 0;                   ///< Where it is moved to.
  std::array<double, 6> off = {};  ///< Where in its errors a placed path is, from -1 to 1 (G16).
  float share = 0;                 ///< That of an instance.
};

/// Coordinates are of any size, or such that all differences have about the same one. The range is that of a segment.
Case draw(Random& random, int exponent) {
  Case drawn{{}, Roundings::drawn(random)};
  const bool is_even = random.one_in(2);
  const auto one = [&] { return random.one_in(2) ? 1.0F : -1.0F; };
  for (std::size_t i = 0; i < 15; ++i) {
    const bool is_a = i >= 6 && i < 9;
    const bool is_end = i >= 3 && i < 6;
    const float middle = is_a ? 0 : is_end ? std::round(drawn.x[i - 3]) + one() : one();
    drawn.x[i] = is_even ? middle + random.symmetric<float>() / 16 : draw_coordinate<float>(random);
  }
  for (float& x : drawn.x) x = std::ldexp(x, exponent);
  drawn.x[15] = 0;
  drawn.x[16] = 1;
  for (double& off : drawn.off) off = random.one_in(2) ? (random.one_in(2) ? 1 : -1) : random.symmetric<double>();
  drawn.share = std::ldexp(1.0F, static_cast<int>(random.between(-24, -4)));
  return drawn;
}

Case changed(Random& random, const Case& from, int exponent) {
  Case next = from;
  if (random.one_in(16)) {
    // A point comes nearer to another one.
    const std::size_t one = 3 * random.below(5);
    const std::size_t other = 3 * random.below(5);
    const auto nearer = static_cast<int>(random.between(-12, 2));
    for (std::size_t i = 0; i < 3; ++i) {
      next.x[one + i] = next.x[other + i] + std::ldexp(next.x[one + i] - next.x[other + i], nearer);
    }
    return next;
  }
  if (random.one_in(2)) {
    next.roundings = from.roundings.changed(random);
    return next;
  }
  if (random.one_in(4)) {
    double& off = next.off[random.below(next.off.size())];
    off = random.one_in(2) ? -off : random.symmetric<double>();
    return next;
  }
  float& coordinate = next.x[random.below(15)];
  coordinate = std::ldexp(changed_coordinate(random, std::ldexp(coordinate, -exponent)), exponent);
  return next;
}

enum class Number : std::uint8_t { det, height, side };

/// Returns the share of its bound that the error of a number takes up.
double share_of_number(const Arithmetic::KernelNumbers& of, RationalDeterminants exact, Number number) {
  const mpq_class sigma = of.is_front ? 1 : -1;
  const auto share = [&](DeviceFloat computed, const mpq_class& truth, DeviceFloat bound) {
    const mpq_class error = abs(rational(computed) - sigma * truth);
    if (error == 0) return 0.0;
    return bound.value() > 0 ? mpq_class(error / rational(bound)).get_d() : double{infinity};
  };
  if (number == Number::det) return share(of.det, exact.det, of.det_bound);
  if (number == Number::height) return share(of.height, exact.height, of.height_bound);
  return std::max(
      {share(of.u, exact.u, of.side_bound), share(of.v, exact.v, of.side_bound), share(of.w, exact.w, of.side_bound)});
}

/// Climbs with the errors of a number. `share_of` has a case and the number.
template <typename ShareOf>
void climb(const std::string& name, std::uint64_t seed, int exponent, std::size_t steps, const ShareOf& share_of) {
  for (const Number number : {Number::det, Number::height, Number::side}) {
    Random random(seed + static_cast<std::uint64_t>(number));
    expect_below_bound(
        name + std::to_string(static_cast<int>(number)), 4, steps, [&] { return draw(random, exponent); },
        [&](const Case& from) { return changed(random, from, exponent); },
        [&](const Case& at) { return share_of(at, number); });
  }
}

double share_of_path(const Case& at, Number number) {
  Arithmetic device;
  if (!take(device, at.path(), at.range())) return 0;
  const Triangle<float> triangle = at.triangle();
  return share_of_number(
      device.numbers_of(device_vector(triangle.a), device_vector(triangle.b), device_vector(triangle.c)),
      rational_determinants(at.path(), triangle), number);
}

/// G3. The smallest sizes are those at which products are flushed (G2).
TEST(GpuPathKernel, determinants_stay_within_their_bounds_where_hill_climbing_makes_the_error_worst) {
  climb("G3_", 62, 0, 10'000, share_of_path);
  climb("G3_of_small_numbers_", 63, -31, 300, share_of_path);
  climb("G3_of_flushed_numbers_", 64, -41, 300, share_of_path);
}

std::optional<Found> classified(const Case& at) {
  at.roundings.begin();
  return classified(at.path(), at.triangle(), at.range());
}

/// Verdicts that a single number could make wrong, and those that all numbers together could.
enum class Verdict : std::uint8_t { hit_by_sides, hit_by_first, hit_by_last, miss };

bool has_verdict(const Case& at, Verdict verdict) {
  const auto found = classified(at);
  return found && found->verdict == (verdict == Verdict::miss ? Arithmetic().is_missed : Arithmetic().is_hit);
}

/// Returns how far a certain verdict is from being wrong: 0 if an exact number is as far from 0 as its bound in G4, and
/// 1 if it is 0.
double share_of_verdict(const Case& at, Verdict verdict) {
  const RationalDeterminants exact = rational_determinants(at.path(), at.triangle());
  if (!has_verdict(at, verdict) || exact.det == 0) return 0;
  const bool is_hit = verdict != Verdict::miss;
  const mpq_class sign = exact.det > 0 ? 1 : -1;
  const auto size_of = [](const RationalVector& x) {
    return std::max({mpq_class(abs(x[0])), mpq_class(abs(x[1])), mpq_class(abs(x[2])), mpq_class(0x1p-30)});
  };
  const RationalVector a = rational(at.triangle().a);
  const mpq_class d = size_of(difference(rational(at.path().toward), rational(at.path().start)));
  const mpq_class e = size_of(difference(rational(at.triangle().b), a));
  const mpq_class f = size_of(difference(rational(at.triangle().c), a));
  const mpq_class s = size_of(difference(rational(at.path().start), a));
  const mpq_class def = d * e * f;
  const mpq_class of_side = def + s * d * f + d * s * e + (is_hit ? mpq_class(0) : def);
  const bool is_whole = at.x[15] == 0 && at.x[16] == 1;
  const mpq_class limit(std::max(std::fabs(double{at.x[15]}), std::fabs(double{at.x[16]})));
  const mpq_class of_end = f * s * e + (is_whole ? mpq_class(is_hit ? 2 : 3) : mpq_class(1 + limit)) * def;
  const mpq_class side = sign > 0 ? std::min({exact.u, exact.v, exact.w}) : std::max({exact.u, exact.v, exact.w});
  const std::array<mpq_class, 3> numbers = {side / of_side, (exact.height - double{at.x[15]} * exact.det) / of_end,
                                            (double{at.x[16]} * exact.det - exact.height) / of_end};
  const mpq_class number =
      is_hit ? mpq_class(sign * numbers[static_cast<std::size_t>(verdict)])
             : std::min({mpq_class(sign * numbers[0]), mpq_class(sign * numbers[1]), mpq_class(sign * numbers[2])});
  return 1 - mpq_class((is_hit ? number : mpq_class(-number)) / (72 * h)).get_d();
}

/// G4. The two numbers of the range are moved too, unless it is that of a segment.
TEST(GpuPathKernel, verdicts_are_right_where_hill_climbing_makes_them_nearly_wrong) {
  for (const bool is_whole : {true, false}) {
    const auto move = [&](Random& random, Case at) {
      at.moved = random.below(is_whole ? 15 : 17);
      at.end = at.moved < 15 ? draw_coordinate<float>(random)
                             : std::ldexp(random.symmetric<float>(), at.moved == 15 ? 3 : 16);
      return at;
    };
    for (const Verdict verdict : {Verdict::hit_by_sides, Verdict::hit_by_first, Verdict::hit_by_last, Verdict::miss}) {
      Random random(65);
      expect_below_bound(
          "G4_" + std::to_string(static_cast<int>(verdict)) + (is_whole ? "_in_segments" : ""), 4, 1500,
          [&] {
            Case drawn = draw(random, 0);
            if (!is_whole) drawn.x[15] = -std::ldexp(1.0F, static_cast<int>(random.between(-2, 16)));
            if (!is_whole) drawn.x[16] = std::ldexp(1.0F, static_cast<int>(random.between(-2, 16)));
            return move(random, drawn);
          },
          [&](const Case& from) { return random.one_in(4) ? move(random, from) : changed(random, from, 0); },
          [&](const Case& at) {
            return share_of_verdict(at_the_edge(at, [&](const Case& any) { return has_verdict(any, verdict); }),
                                    verdict);
          });
    }
  }
}

/// G5. Returns how far from the middle of its interval the exact t of a hit is. An end of the interval is at 1.
double share_of_interval(const Case& at) {
  const auto found = classified(at);
  const RationalDeterminants exact = rational_determinants(at.path(), at.triangle());
  if (!found || found->verdict != Arithmetic().is_hit || exact.det == 0) return 0;
  const mpq_class t = exact.height / exact.det;
  return mpq_class(abs(2 * t - found->lower - found->upper) / (found->upper - found->lower)).get_d();
}

TEST(GpuPathKernel, intervals_of_hits_hold_t_where_hill_climbing_brings_it_to_their_ends) {
  for (const int exponent : {0, -31}) {
    Random random(66);
    expect_below_bound(
        exponent == 0 ? "G5" : "G5_of_small_numbers", 8, 5000,
        [&] {
          Case drawn = draw(random, exponent);
          if (random.one_in(2)) drawn.x[15] = -infinity;
          if (random.one_in(2)) drawn.x[16] = infinity;
          return drawn;
        },
        [&](const Case& from) { return changed(random, from, exponent); }, share_of_interval);
  }
}

/// G16. The pose is the identity, and its instance has an error besides. So the device has the path itself, and the
/// exact one may be anywhere within the error.
double share_of_placed(const Case& at, Number number) {
  Arithmetic device;
  if (!take(device, at.path(), at.range())) return 0;
  Arithmetic::Instance instance = {};
  for (const std::size_t i : {0U, 4U, 8U}) instance.inverse[i] = 1;
  instance.share = at.share;
  instance.reach = 0x1p10;
  const Arithmetic::PlacedPath placed = device.place(instance, device.start, device.way, true, 1);
  if (!device.enter_frame(instance, true, 1)) return 0;
  const mpq_class start_error = rational(placed.start_error);
  const mpq_class way_error = rational(placed.way_error);
  RationalVector start = rational(device.start);
  RationalVector way = rational(device.way);
  for (std::size_t i = 0; i < 3; ++i) {
    start[i] += at.off[i] * start_error;
    way[i] += at.off[3 + i] * way_error;
  }
  const Triangle<float> triangle = at.triangle();
  return share_of_number(
      device.numbers_of(device_vector(triangle.a), device_vector(triangle.b), device_vector(triangle.c)),
      rational_determinants(start, way, triangle), number);
}

TEST(GpuPathKernel, determinants_of_placed_paths_stay_within_their_bounds) {
  climb("G16_", 67, 0, 5000, share_of_placed);
}

}  // namespace
}  // namespace surehit::test::gpu_path_kernel_test
