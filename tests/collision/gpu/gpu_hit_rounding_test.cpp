// What a device computes in pairs of floats, with roundings that Vulkan allows it. No device is asked.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include "collision/filter/coordinate_changes.hpp"
#include "collision/rational_determinants.hpp"
#include "device_arithmetic.hpp"
#include "support/case_count.hpp"
#include "support/exact_oracle.hpp"
#include "support/pair_families.hpp"
#include "support/pair_text.hpp"

namespace surehit::test::gpu_hit_rounding_test {
namespace {

using Arithmetic = DeviceArithmetic;

mpq_class exact(DeviceFloat x) { return mpq_class(double{x.value()}); }
mpq_class exact(const Arithmetic::FloatPair& x) { return exact(x.high) + exact(x.low); }
Arithmetic::vec3 vector(const Vector3f& x) { return {x[0], x[1], x[2]}; }

TEST(GpuFloatPairs, sums_are_nearly_exact_and_products_are_exact) {
  Arithmetic device;
  on_every_device([&] {
    Random random(31);
    for (std::size_t i = case_count(2'000); i > 0; --i) {
      const auto draw = [&](int exponents) {
        return std::ldexp(random.symmetric<float>(), static_cast<int>(random.between(-exponents, exponents)));
      };
      const float x = draw(30);
      const float y = random.one_in(3) ? neighbour(-x, static_cast<int>(random.between(-40, 40))) : draw(30);
      const mpq_class sum = exact(DeviceFloat(x)) + exact(DeviceFloat(y));
      const auto pair = device.sum_of(x, y);
      EXPECT_LE(mpq_class(abs(exact(pair) - sum)), mpq_class(0x1p-46) * abs(sum)) << x << " + " << y;  // G10
      EXPECT_LE(mpq_class(abs(exact(pair.low))), mpq_class(0x1p-23) * abs(sum)) << x << " + " << y;
      EXPECT_EQ(exact(device.product_of(x, y)), exact(DeviceFloat(x)) * exact(DeviceFloat(y)))  // G11
          << x << " * " << y;
    }
  });
}

/// Returns the largest share of the bounds of G12 that the errors of the four determinants take up.
double worst_share(const Path<float>& path, const Triangle<float>& triangle) {
  Arithmetic device;
  const RationalDeterminants of = rational_determinants(path, triangle);
  auto d = device.difference_of(vector(path.toward), vector(path.start));
  if (path.kind != PathKind::segment) d = device.pairs_of(vector(path.toward));
  const auto e = device.difference_of(vector(triangle.b), vector(triangle.a));
  const auto f = device.difference_of(vector(triangle.c), vector(triangle.a));
  const auto s = device.difference_of(vector(path.start), vector(triangle.a));
  const auto p = device.cross_of_pairs(d, f);
  const auto q = device.cross_of_pairs(s, e);
  const auto share = [&](const auto& v, const auto& cross, const auto& w, const auto& x, const mpq_class& truth) {
    const mpq_class error = abs(exact(device.dot_of_pairs(v, cross)) - truth);
    return mpq_class(error / exact(device.bound_of(v, w, x))).get_d();
  };
  return std::max(
      {share(e, p, d, f, of.det), share(f, q, s, e, of.height), share(s, p, d, f, of.u), share(d, q, s, e, of.v)});
}

TEST(GpuFloatPairs, determinants_stay_within_their_bound_where_hill_climbing_makes_the_error_worst) {
  double worst = 0;
  on_every_device([&] {
    Random random(32);
    for (std::size_t start = 0; start < 4; ++start) {
      std::array<float, 15> best = {};
      double best_share = -1;
      for (std::size_t step = case_count(800); step > 0; --step) {
        std::array<float, 15> x = best;
        if (best_share < 0) {
          for (float& coordinate : x) coordinate = draw_coordinate<float>(random);
        } else {
          float& coordinate = x[random.below(x.size())];
          coordinate = changed_coordinate(random, coordinate);
        }
        const Path<float> path = Segment<float>{{x[0], x[1], x[2]}, {x[3], x[4], x[5]}};
        const Triangle<float> triangle{{x[6], x[7], x[8]}, {x[9], x[10], x[11]}, {x[12], x[13], x[14]}};
        if (const double share = worst_share(path, triangle); share > best_share) {
          best = x;
          best_share = share;
        }
      }
      worst = std::max(worst, best_share);
    }
  });
  testing::Test::RecordProperty("worst_share", std::to_string(worst));
  EXPECT_LT(worst, 1);
  if (runs_all_cases()) {
    EXPECT_GT(worst, 0.05) << "room to waste";
  }
}

/// Rounds a pair that meets, and expects the exact values, each rounded once. Returns whether the device has rounded
/// it.
bool rounds_rightly(const Path<float>& path, const Triangle<float>& triangle, const RationalDeterminants& of) {
  const auto hit = Arithmetic().round_hit(vector(path.start), vector(path.toward), path.kind == PathKind::segment,
                                          vector(triangle.a), vector(triangle.b), vector(triangle.c));
  if (!hit.is_rounded) return false;
  SCOPED_TRACE(hex_text(path) + hex_text(triangle));
  EXPECT_EQ(hit.t.value(), nearest<float>(of.height / of.det));
  EXPECT_EQ(hit.u.value(), nearest<float>(of.u / of.det));
  EXPECT_EQ(hit.v.value(), nearest<float>(of.v / of.det));
  EXPECT_EQ(hit.is_front, of.det > 0);
  return true;
}

TEST(GpuHitRounding, is_never_wrong_on_any_family) {
  on_every_device([] {
    for (const PairFamily family : all_pair_families) {
      SCOPED_TRACE(name_of(family));
      Random random(33);
      for (std::size_t i = case_count(100); i > 0; --i) {
        const auto [segment, triangle] = draw_pair<float>(family, random);
        const auto kind = static_cast<PathKind>(i % 3);
        const Path<float> path = path_along(segment, kind);
        const auto largest = std::max({path.start.cwiseAbs().maxCoeff(), path.toward.cwiseAbs().maxCoeff(),
                                       triangle.a.cwiseAbs().maxCoeff(), triangle.b.cwiseAbs().maxCoeff(),
                                       triangle.c.cwiseAbs().maxCoeff()});
        if (!(largest <= 0x1p33F)) continue;  // It never comes so far (G2).
        const RationalDeterminants of = rational_determinants(path, triangle);
        if (of.det == 0 || of.u / of.det <= 0 || of.v / of.det <= 0 || of.w / of.det <= 0) continue;
        rounds_rightly(path, triangle, of);
      }
    }
  });
}

TEST(GpuHitRounding, rounds_nearly_all_hits_in_general_position) {
  on_every_device([] {
    Random random(34);
    std::size_t count = 0;
    std::size_t rounded = 0;
    for (std::size_t i = case_count(600); i > 0; --i) {
      const auto exponent = static_cast<int>(random.between(-6, 20));
      const auto draw = [&]() -> Vector3f {
        return Vector3f::NullaryExpr([&] { return std::ldexp(random.symmetric<float>(), exponent); });
      };
      const Path<float> path = Segment<float>{draw(), draw()};
      const Triangle<float> triangle{draw(), draw(), draw()};
      const RationalDeterminants of = rational_determinants(path, triangle);
      if (of.u / of.det < 0 || of.v / of.det < 0 || of.w / of.det < 0) continue;
      ++count;
      rounded += rounds_rightly(path, triangle, of) ? 1 : 0;
    }
    EXPECT_GE(rounded, count * 95 / 100);
    if (runs_all_cases()) {
      EXPECT_GT(count, 50U);
    }
  });
}

/// The values 1 and 1 - 2^-24 are next to each other, and so are 1 and 1 + 2^-23.
TEST(GpuHitRounding, leaves_what_its_bound_does_not_decide) {
  Arithmetic device;
  constexpr double gap = 0x1p-23;
  const Arithmetic::FloatPair one = device.pair_of(1.0, 0.0);
  const auto quotient = [&](double low, double bound) {
    return device.quotient_of(device.pair_of(1.0, low), bound, one, 0.0);
  };
  on_every_device([&] {
    const auto expect = [&](double low, double bound, float number) {
      const auto found = quotient(low, bound);
      EXPECT_TRUE(found.is_rounded) << low;
      EXPECT_EQ(found.number.value(), number) << low;
    };
    expect(0, 0.1 * gap, 1);
    expect(0.4 * gap, 0.05 * gap, 1);
    expect(0.6 * gap, 0.05 * gap, 1 + 0x1p-23F);
    expect(-0.2 * gap, 0.02 * gap, 1);
    expect(-0.3 * gap, 0.02 * gap, 1 - 0x1p-24F);
    EXPECT_FALSE(quotient(0.5 * gap, 0).is_rounded);
    EXPECT_FALSE(quotient(0.45 * gap, 0.1 * gap).is_rounded);
    EXPECT_FALSE(quotient(0.55 * gap, 0.1 * gap).is_rounded);
    // What is left is above 0. The quotient may still be below 1, and there it may be nearer to the float below.
    EXPECT_FALSE(quotient(0.01 * gap, 0.3 * gap).is_rounded);
    // A bound of the divisor counts as one of the quotient.
    EXPECT_FALSE(device.quotient_of(device.pair_of(1.0, 0.4 * gap), 0.0, one, 0.2 * gap).is_rounded);
    // Quotients may be of any sign, but not of any size.
    EXPECT_EQ(device.quotient_of(device.pair_of(-1.0, -0.6 * gap), 0.0, one, 0.0).number.value(), -1 - 0x1p-23F);
    EXPECT_FALSE(device.quotient_of(device.pair_of(0.0, 0.0), 0.0, one, 0.0).is_rounded);
    EXPECT_FALSE(device.quotient_of(device.pair_of(0x1p-61, 0.0), 0.0, one, 0.0).is_rounded);
    EXPECT_FALSE(device.quotient_of(device.pair_of(0x1p61, 0.0), 0.0, one, 0.0).is_rounded);
  });
}

}  // namespace
}  // namespace surehit::test::gpu_hit_rounding_test
