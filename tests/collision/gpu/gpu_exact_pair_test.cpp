// What a device decides in whole numbers, and how it rounds it, with roundings that Vulkan allows. No device is asked.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "device_arithmetic.hpp"
#include "support/case_count.hpp"
#include "support/exact_oracle.hpp"
#include "support/neighbour.hpp"
#include "support/pair_families.hpp"
#include "support/pair_text.hpp"

namespace surehit::test::gpu_exact_pair_test {
namespace {

using Arithmetic = DeviceArithmetic;

Arithmetic::uvec3 bits_of(const Vector3f& x) {
  return {std::bit_cast<std::uint32_t>(x[0]), std::bit_cast<std::uint32_t>(x[1]), std::bit_cast<std::uint32_t>(x[2])};
}

/// Decides a pair in the range of its path, which 2^100 leaves open.
Arithmetic::ExactContact contact_of(Arithmetic& device, const Path<float>& path, const Triangle<float>& triangle) {
  const bool is_segment = path.kind == PathKind::segment;
  return device.exact_contact_of(
      {bits_of(path.start), bits_of(path.toward), bits_of(triangle.a), bits_of(triangle.b), bits_of(triangle.c)},
      is_segment, path.kind == PathKind::line ? -0x1p100 : 0, is_segment ? 1 : 0x1p100);
}

/// How many pairs there were.
struct Counts {
  std::size_t all = 0, open = 0, hits = 0, edge_on = 0, rounded = 0;
};

/// Expects that what a device decides is what the host does, and that a rounded hit has its bits.
void expect_right(const Path<float>& path, const Triangle<float>& triangle, Counts& counts) {
  Arithmetic device;
  ++counts.all;
  const auto contact = contact_of(device, path, triangle);
  if (contact.verdict == device.is_open) {
    ++counts.open;
    return;
  }
  SCOPED_TRACE(hex_text(path) + hex_text(triangle));
  const auto truth = exact_contact<float>(path, triangle);
  ASSERT_EQ(contact.verdict == device.is_hit, truth.has_value());
  if (!truth) return;
  const Hitf expected = rounded_hit<float>(*truth);
  ++counts.hits;
  EXPECT_EQ(contact.side, static_cast<std::uint32_t>(expected.side));
  if (expected.side == Side::edge_on) ++counts.edge_on;
  if (path.kind != PathKind::line) {
    EXPECT_EQ(contact.has_start, !exact_contact<float>(path, triangle, {.ignore_start_contact = true}));
  }
  if (path.kind == PathKind::segment) {
    EXPECT_EQ(contact.has_end, !exact_contact<float>(path, triangle, {.ignore_end_contact = true}));
  }
  const auto hit = device.round_contact(contact);
  if (!hit.is_rounded) return;
  ++counts.rounded;
  EXPECT_EQ(hit.t.value(), expected.t);
  EXPECT_EQ(hit.u.value(), expected.u);
  EXPECT_EQ(hit.v.value(), expected.v);
}

TEST(GpuExactPair, is_never_wrong_on_any_family) {
  Counts counts;
  on_every_device([&] {
    for (const PairFamily family : all_pair_families) {
      SCOPED_TRACE(name_of(family));
      Random random(61);
      for (std::size_t i = case_count(100); i > 0; --i) {
        const auto [segment, triangle] = draw_pair<float>(family, random);
        expect_right(path_along(segment, static_cast<PathKind>(i % 3)), triangle, counts);
      }
    }
  });
  EXPECT_LT(counts.open, counts.all / 2);
}

/// All coordinates are small whole numbers, so that most pairs have a determinant that is 0. The unit goes from the
/// least denormal up to the largest coordinates of a device. One number may be an ulp off.
TEST(GpuExactPair, decides_what_is_exactly_zero_and_what_is_an_ulp_off) {
  Counts counts;
  on_every_device([&] {
    Random random(62);
    for (std::size_t i = case_count(3'000); i > 0; --i) {
      const auto exponent = std::array{-149, -140, -126, -20, 0, 7, 31}[random.below(7)];
      const auto draw = [&]() -> Vector3f {
        return Vector3f::NullaryExpr([&] { return std::ldexp(static_cast<float>(random.between(-2, 2)), exponent); });
      };
      Triangle<float> triangle{draw(), draw(), draw()};
      Segment<float> segment{draw(), draw()};
      if (random.one_in(2)) {  // All in one plane.
        const auto axis = static_cast<Eigen::Index>(random.below(3));
        for (Vector3f* const x : {&triangle.a, &triangle.b, &triangle.c, &segment.start, &segment.end}) {
          (*x)[axis] = triangle.a[axis];
        }
      }
      if (random.one_in(3)) {
        float& x = segment.end[static_cast<Eigen::Index>(random.below(3))];
        if (x != 0) x = neighbour(x, random.one_in(2) ? 1 : -1);
      }
      const bool has_area =
          (triangle.b - triangle.a).cast<double>().cross((triangle.c - triangle.a).cast<double>()).norm() > 0;
      if (!has_area || segment.start == segment.end) continue;
      const std::size_t open = counts.open;
      expect_right(segment, triangle, counts);
      EXPECT_EQ(counts.open, open) << hex_text(Path<float>(segment)) << hex_text(triangle);
      for (const PathKind kind : {PathKind::ray, PathKind::line})
        expect_right(path_along(segment, kind), triangle, counts);
    }
  });
  if (runs_all_cases()) {
    EXPECT_GT(counts.edge_on, counts.hits / 10);
    EXPECT_GT(counts.rounded, counts.hits * 9 / 10);
  }
}

/// The sizes are as far apart as they may be, and all bits of the significands are 1. So the numbers are as long as G23
/// takes them to be. One octave more stays open.
TEST(GpuExactPair, numbers_of_all_sizes_fit) {
  for (const int octaves : {21, 22}) {
    Counts counts;
    Random random(63);
    for (std::size_t i = case_count(20'000); i > 0; --i) {
      const auto draw = [&]() -> Vector3f {
        return Vector3f::NullaryExpr([&] {
          const float size = random.one_in(4) ? 0x1.fffffep0F : 1 + 0.999F * random.unit<float>();
          return std::ldexp(random.one_in(2) ? size : -size, random.one_in(8) ? 0 : octaves);
        });
      };
      Triangle<float> triangle{draw(), draw(), draw()};
      const Path<float> path(static_cast<PathKind>(i % 3), draw(), draw());
      triangle.a[0] = 0x1.fffffep0F;
      triangle.b[1] = std::ldexp(-1.0F, octaves);
      expect_right(path, triangle, counts);
    }
    if (octaves == 22) {
      EXPECT_EQ(counts.open, counts.all);
    } else {
      EXPECT_LE(counts.open, counts.all / 50);
    }
  }
}

Arithmetic::WideInt draw_number(std::size_t bits, bool may_be_negative, Random& random) {
  Arithmetic device;
  std::array<std::uint32_t, 5> words = {};
  for (std::size_t i = 0; i < bits; ++i) {
    if (!random.one_in(3)) words[i / 32] |= std::uint32_t{1} << (i % 32);  // Long carries are more likely.
  }
  words[0] |= 1;
  const auto size = device.int_of(words[0], words[1], words[2], words[3], words[4]);
  return may_be_negative && random.one_in(2) ? device.negated(size) : size;
}

/// Returns a number times 2^-32, as pairs have it.
mpq_class value_of(const Arithmetic::WideInt& x) {
  Arithmetic device;
  const auto size = device.size_of(x);
  mpz_class sum = 0;
  for (const std::uint32_t word : {size.e, size.d, size.c, size.b, size.a}) sum = (sum << 32) + word;
  mpq_class value(device.is_negative(x) ? mpz_class(-sum) : sum, mpz_class(1) << 32);
  value.canonicalize();
  return value;
}

mpq_class exact(const Arithmetic::FloatPair& x) {
  return mpq_class(double{x.high.value()}) + mpq_class(double{x.low.value()});
}

/// The shares are those of the largest errors in the bounds of G25.
TEST(GpuExactPair, numbers_in_pairs_stay_within_their_bounds) {
  double worst_number = 0;
  double worst_weight = 0;
  on_every_device([&] {
    Arithmetic device;
    Random random(65);
    for (std::size_t i = case_count(2'000); i > 0; --i) {
      const auto x = draw_number(1 + random.below(142), true, random);
      const mpq_class number_error = abs(exact(device.pair_from(x)) - value_of(x));
      worst_number =
          std::max(worst_number,
                   mpq_class(number_error / (mpq_class(double{device.pair_error.value()}) * abs(value_of(x)))).get_d());
      // Weights in a plane have at most 95 bits.
      const std::size_t bits = 60 + random.below(35);
      const auto start = draw_number(bits, true, random);
      const auto way = draw_number(bits, true, random);
      const auto num = draw_number(bits, false, random);
      const auto den = draw_number(bits, false, random);
      const auto of = device.weight_of(start, way, device.pair_from(num), device.pair_from(den));
      const mpq_class of_start = value_of(start) * value_of(den);
      const mpq_class of_way = value_of(way) * value_of(num);
      const mpq_class weight_error = abs(exact(of.sum) - of_start - of_way);
      worst_weight = std::max(worst_weight, mpq_class(weight_error / mpq_class(double{of.bound.value()})).get_d());
    }
  });
  testing::Test::RecordProperty("worst_number", std::to_string(worst_number));
  testing::Test::RecordProperty("worst_weight", std::to_string(worst_weight));
  EXPECT_LT(worst_number, 1);
  EXPECT_LT(worst_weight, 1);
  if (runs_all_cases()) {
    EXPECT_GT(worst_number, 0.05) << "room to waste";
    EXPECT_GT(worst_weight, 0.05) << "room to waste";
  }
}

/// The numbers are of all sizes that those of a contact may have. Half of the quotients are near 1.
TEST(GpuExactPair, intervals_hold_the_exact_t) {
  double worst = 0;
  std::size_t open = 0;
  const mpq_class max_t(mpz_class(1) << 99);
  on_every_device([&] {
    Arithmetic device;
    Random random(66);
    for (std::size_t i = case_count(2'000); i > 0; --i) {
      const std::size_t bits = 1 + random.below(142);
      const auto height = draw_number(bits, true, random);
      const auto det = draw_number(random.one_in(2) ? bits : 1 + random.below(142), false, random);
      const mpq_class t = value_of(height) / value_of(det);
      Arithmetic::real lower;
      Arithmetic::real upper;
      if (!device.has_interval(height, det, lower, upper)) {
        ++open;
        EXPECT_GT(abs(t), max_t / 16) << t.get_d();
        continue;
      }
      ASSERT_TRUE(std::fabs(lower.value()) < 0x1p99 && std::fabs(upper.value()) < 0x1p99) << t.get_d();
      const mpq_class low(double{lower.value()});
      const mpq_class high(double{upper.value()});
      ASSERT_TRUE(low <= t && t <= high && low < high) << t.get_d();
      worst = std::max(worst, mpq_class(abs(2 * t - low - high) / (high - low)).get_d());
    }
  });
  testing::Test::RecordProperty("worst", std::to_string(worst));
  EXPECT_LT(worst, 1);
  if (runs_all_cases()) {
    EXPECT_GT(worst, 0.1) << "room to waste";
    EXPECT_GT(open, 100U);
  }
}

/// t of two triangles is compared exactly. They share corners, so it is often the same.
TEST(GpuExactPair, orders_of_two_triangles_are_exact) {
  Arithmetic device;
  Random random(64);
  std::size_t equal = 0;
  for (std::size_t i = case_count(20'000); i > 0; --i) {
    const int exponent = random.one_in(2) ? 0 : -20;
    const auto draw = [&]() -> Vector3f {
      return Vector3f::NullaryExpr([&] { return std::ldexp(static_cast<float>(random.between(-3, 3)), exponent); });
    };
    const Vector3f shared = draw();
    const Triangle<float> x{shared, draw(), draw()};
    const Triangle<float> y{draw(), random.one_in(2) ? x.b : draw(), shared};
    const Segment<float> segment{draw(), random.one_in(2) ? draw() : Vector3f(shared * 2)};
    const auto of_x = contact_of(device, segment, x);
    const auto of_y = contact_of(device, segment, y);
    if (of_x.verdict != device.is_hit || of_y.verdict != device.is_hit) continue;
    const auto t_of = [&](const Triangle<float>& triangle) {
      const auto truth = exact_contact<float>(segment, triangle);
      EXPECT_TRUE(truth);
      return truth ? truth->t : mpq_class();
    };
    const int expected = cmp(t_of(x), t_of(y));
    equal += expected == 0 ? 1 : 0;
    const int order = device.order_of_products(of_x.height, of_y.det, of_y.height, of_x.det);
    EXPECT_EQ(order, (expected > 0) - (expected < 0)) << hex_text(Path<float>(segment)) << hex_text(x) << hex_text(y);
  }
  if (runs_all_cases()) {
    EXPECT_GT(equal, 100U);
  }
}

}  // namespace
}  // namespace surehit::test::gpu_exact_pair_test
